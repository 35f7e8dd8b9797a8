// SPDX-License-Identifier: MIT
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "setup.hpp"

namespace shakedown {

/// SETUP and the options that change it: --set key=value, --rate, --seed.
struct SetupArguments {
  std::string file;
  std::vector<std::string> overrides;
  std::string rate, seed;

  /// Throws InputError with everything that is wrong with file and options, FileError.
  Setup read() const;
};

/// The variable must outlive the parsing.
void add_setup_arguments(CLI::App& command, SetupArguments& arguments);

}  // namespace shakedown
