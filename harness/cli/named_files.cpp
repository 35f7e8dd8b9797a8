// SPDX-License-Identifier: MIT
#include "named_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "errors.hpp"

namespace shakedown {

namespace {

namespace fs = std::filesystem;

struct NamedOutput {
  std::string option;
  fs::path path;
  bool folder = false;
};

/// Returns one name for each place, whatever path leads to it.
fs::path place_of(const std::string& name) {
  std::error_code error;
  const fs::path absolute = fs::absolute(name, error), plain = fs::weakly_canonical(absolute, error);
  const fs::path place = error ? absolute.lexically_normal() : plain;
  return place.has_filename() ? place : place.parent_path();
}

/// What a command is to read, and to write, has a name.
std::vector<Violation> empty_names(const CLI::App& command) {
  constexpr std::array options{"data", "out", "report", "table", "truth", "keep", "known"};
  std::vector<Violation> found;
  for (const CLI::Option* option : command.get_options()) {
    const bool named =
        option->get_positional() || std::any_of(options.begin(), options.end(),
                                                [&](const char* name) { return option->check_lname(name); });
    if (!named || option->get_items_expected_max() == 0) continue;
    for (const std::string& value : option->results())
      if (value.empty())
        found.push_back(
            {{}, option->get_name(), "has an empty name", "name a file or folder, or leave the option out"});
  }
  return found;
}

std::vector<NamedOutput> outputs_of(const CLI::App& command) {
  constexpr std::array names{"out", "json", "report", "table", "truth"};
  std::vector<NamedOutput> outputs;
  for (const CLI::Option* option : command.get_options())
    for (const char* name : names) {
      if (!option->check_lname(name) || option->count() == 0 || option->get_items_expected_max() == 0)
        continue;
      const std::string value = option->results().empty() ? "" : option->results().front();
      if (value.empty() || value == "-") continue;  // of --json: to standard output
      outputs.push_back({"--" + std::string(name), place_of(value), option->get_type_name() == "DIR"});
    }
  return outputs;
}

/// Files that commands write into their folders: setups, tables, logs and arrays of any name, and these.
bool is_of_a_folder(const fs::path& file) {
  constexpr std::array endings{".toml", ".csv", ".log", ".npy", ".journal"};
  constexpr std::array names{"summary.json", "diagnosis.json", "compare.json", "fit.json",
                             "ladder.json",  "report.json",    "map.json"};
  return std::find(endings.begin(), endings.end(), file.extension()) != endings.end() ||
         std::find(names.begin(), names.end(), file.filename()) != names.end();
}

}  // namespace

void check_named_files(const CLI::App& command) {
  const std::vector<NamedOutput> outputs = outputs_of(command);
  std::vector<Violation> found = empty_names(command);
  for (const NamedOutput& one : outputs)
    for (const NamedOutput& other : outputs) {
      if (&one < &other && one.path == other.path)
        found.push_back({{},
                         other.option,
                         "names what " + one.option + " names (" + one.path.string() +
                             "), and one would replace the other",
                         "name two files"});
      if (one.folder && other.path.parent_path() == one.path && is_of_a_folder(other.path.filename()))
        found.push_back({{},
                         other.option,
                         "names a file of the folder of " + one.option + " (" + other.path.string() +
                             "), where this command's results may go",
                         "choose another name or another folder"});
    }
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace shakedown
