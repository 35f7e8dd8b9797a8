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

  /// Throws InputError with everything that is wrong with file and options, FileError. Keys that come from
  /// `elsewhere` may be left out even when strict.
  Setup read(std::span<const std::string_view> elsewhere = {}) const;
};

/// Each measured run says how long its box is.
constexpr std::array<std::string_view, 1> given_by_measurements{"box.length"};

/// What a command says of the values that the setup left out: a line for people, and "taken_from_paper" in
/// its JSON document.
class PaperValues {
 public:
  explicit PaperValues(const Setup& setup, std::span<const std::string_view> elsewhere = {});
  /// Those of several setups, each once.
  void join(const PaperValues& other);
  void print(std::FILE* stream) const;
  std::string added_to(const std::string& json_document) const;

 private:
  std::vector<std::string> taken_;
};

/// The variable must outlive the parsing.
void add_strict_option(CLI::App& command, bool& strict);
void add_setup_arguments(CLI::App& command, SetupArguments& arguments);

}  // namespace shakedown
