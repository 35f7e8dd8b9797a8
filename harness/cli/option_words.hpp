// SPDX-License-Identifier: MIT
// Tells what the parser knows of an option, in the words that manual pages and completions need.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace shakedown {

/// The kind of value that an option or a positional argument takes.
enum class ValueKind { none, any, words, file, folder };

struct OptionWords {
  std::vector<std::string> names;  ///< "--out", "-h"; of a positional argument its one name
  bool positional = false, required = false, repeated = false;
  bool value_optional = false;         ///< --json [FILE]
  ValueKind kind = ValueKind::any;     ///< none: a flag
  std::vector<std::string> choices{};  ///< of kind words
  std::string type;                    ///< "N", "FILE.html"; empty where there is none
  std::string bounds;                  ///< "INT in [1 - 1000000]"; empty where any value will do
  std::string sentence;
  std::string otherwise;  ///< the default as text; empty: none is told
};

/// Returns the options that the help shows, in its order.
std::vector<OptionWords> options_of(const CLI::App& command);

/// Returns the commands below this one, in the order of the help.
std::vector<const CLI::App*> commands_of(const CLI::App& program);

/// Tells whether the words go to another program, which has the options.
bool handed_on(const CLI::App& command);

/// Returns "shakedown-check-linear-decay" for the command linear-decay below check; `program`: "shakedown".
std::string dashed_name(const std::string& program, const CLI::App& command);

}  // namespace shakedown
