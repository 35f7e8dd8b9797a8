// SPDX-License-Identifier: MIT
#pragma once
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

namespace shakedown {

/// The option --json [FILE] of commands that have results to tell; no name or "-": to standard output.
struct JsonOutput {
  std::string file;
  bool wanted = false;

  /// Tells whether the document is wanted, and not in a file.
  bool to_standard_output() const { return wanted && (file.empty() || file == "-"); }
  /// Returns the stream for people: out of the way of the JSON.
  std::FILE* for_people() const { return to_standard_output() ? stderr : stdout; }
  /// Throws FileError when the file cannot be written; to be called before long work.
  void check() const;
  /// Writes the document if it was asked for. Throws FileError.
  void write(const std::string& document) const;
};

/// Adds the option. The variable must outlive the parsing.
void add_json_option(CLI::App& command, JsonOutput& output);

}  // namespace shakedown
