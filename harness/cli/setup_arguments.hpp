// SPDX-License-Identifier: MIT
#pragma once
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "setup.hpp"

namespace shakedown {

/// SETUP and the options that change it or say how it is taken: --set key=value, --rate, --seed, --strict.
struct SetupArguments {
  std::string file;
  std::vector<std::string> overrides;
  std::string rate, seed;
  bool strict = false;  ///< what the setup leaves out is an error, not the paper's value

  /// Reads the setup with its options. Throws InputError with everything that is wrong with file and options,
  /// FileError. Keys that come from `elsewhere` may be left out even when strict.
  Setup read(std::span<const std::string_view> elsewhere = {}) const;
};

/// These keys come from measurements: each measured run says how long its box is.
constexpr std::array<std::string_view, 1> given_by_measurements{"box.length"};

/// Tells the values that the setup left out: a line for people, and "taken_from_paper" in a command's JSON
/// document.
class PaperValues {
 public:
  explicit PaperValues(const Setup& setup, std::span<const std::string_view> elsewhere = {});
  /// Adds those of another setup, each once.
  void join(const PaperValues& other);
  /// Prints the line for people; nothing where no value was taken.
  void print(std::FILE* stream) const;
  /// Returns the document with "taken_from_paper" added.
  std::string added_to(const std::string& json_document) const;

 private:
  std::vector<std::string> taken_;
};

/// The variable must outlive the parsing.
void add_strict_option(CLI::App& command, bool& strict);
/// Adds SETUP and its options. The variable must outlive the parsing.
void add_setup_arguments(CLI::App& command, SetupArguments& arguments);

}  // namespace shakedown
