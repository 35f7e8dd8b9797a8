// SPDX-License-Identifier: MIT
// Options of every command that simulates ensembles.
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace shakedown {

/// Makes a check for positive and finite numbers: CLI11's own takes nan.
CLI::Validator positive_number();

/// Adds --seed, a whole number from 0 that a setup takes as a seed: CLI11 by itself makes 2^64 - 1 of -1. The
/// variable must outlive the parsing.
void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& words);

/// Adds --threads T: 0 to 1024. The variable must outlive the parsing.
void add_threads_option(CLI::App& command, int& threads,
                        const std::string& words = "0: one for each core; the answer does not depend on it");

/// Adds --runs N of what is compared with measurements: `fewest` to 100000. The variable must outlive the
/// parsing.
void add_simulations_option(CLI::App& command, int& count, int fewest = 16,
                            const std::string& words = "simulations of each different setup");

/// Adds --keep DIR, where what programs beside ours are given and answer stays; for commands that take
/// `--engine`.
void add_keep_option(CLI::App& command);

}  // namespace shakedown
