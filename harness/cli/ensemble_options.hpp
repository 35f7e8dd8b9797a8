// SPDX-License-Identifier: MIT
// Options of every command that simulates ensembles.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace shakedown {

/// --threads T: 0 to 1024. The variable must outlive the parsing.
void add_threads_option(CLI::App& command, int& threads,
                        const std::string& words = "0: one for each core; the answer does not depend on it");

/// --runs N of what is compared with measurements: `fewest` to 100000. The variable must outlive the parsing.
void add_simulations_option(CLI::App& command, int& count, int fewest = 16,
                            const std::string& words = "simulations of each different setup");

}  // namespace shakedown
