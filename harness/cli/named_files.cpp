// SPDX-License-Identifier: MIT
#include "named_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "errors.hpp"
#include "kept_files.hpp"

namespace shakedown {

namespace {

namespace fs = std::filesystem;

struct NamedOutput {
  std::string option;
  fs::path path;
  bool folder = false;
};

/// What a command is to read, and to write, has a name.
std::vector<Violation> empty_names(const CLI::App& command) {
  std::vector<Violation> found;
  for (const CLI::Option* option : command.get_options()) {
    const bool named =
        option->get_positional() || std::any_of(options_for_files.begin(), options_for_files.end(),
                                                [&](const char* name) { return option->check_lname(name); });
    if (!named || option->get_items_expected_max() == 0) continue;
    for (const std::string& value : option->results())
      if (value.empty())
        found.push_back({{}, option->get_name(), "has an empty name", "say what is meant, or leave it out"});
  }
  return found;
}

std::vector<NamedOutput> outputs_of(const CLI::App& command) {
  constexpr std::array names{"out", "json", "report", "table", "truth", "known", "baselines"};
  const CLI::Option* updates = command.get_option_no_throw("--update");
  std::vector<NamedOutput> outputs;
  for (const CLI::Option* option : command.get_options())
    for (const char* name : names) {
      if (!option->check_lname(name) || option->get_items_expected_max() == 0) continue;
      const std::string type = option->get_type_name(), option_name = "--" + std::string(name);
      // --known of some commands is no file, and baselines are written on request.
      if (option_name == "--known" && type != "FILE") continue;
      if (option_name == "--baselines" && (updates == nullptr || updates->count() == 0)) continue;
      const std::string value =
          option->results().empty() ? option->get_default_str() : option->results().front();
      if (value.empty() || value == "-") continue;  // of --json: to standard output
      outputs.push_back({option_name, one_name_of(value), type == "DIR"});
    }
  return outputs;
}

/// The command's own document, which --json writes with the same bytes.
bool is_same_document(const NamedOutput& output) {
  constexpr std::array documents{"summary.json", "diagnosis.json", "compare.json", "fit.json", "ladder.json"};
  return output.option == "--json" &&
         std::find(documents.begin(), documents.end(), output.path.filename()) != documents.end();
}

}  // namespace

bool is_result(const std::filesystem::path& file) {
  constexpr std::array endings{".toml", ".csv", ".log", ".npy", ".journal", ".svg", ".md", ".sqlite"};
  constexpr std::array names{"summary.json", "diagnosis.json", "compare.json", "fit.json",
                             "ladder.json",  "report.json",    "map.json",     "provenance.json",
                             "plan.json",    "score.json",     "paper.json",   "truth.json"};
  return std::find(endings.begin(), endings.end(), file.extension()) != endings.end() ||
         std::find(names.begin(), names.end(), file.filename()) != names.end();
}

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
      if (one.folder && other.path.parent_path() == one.path && is_result(other.path) &&
          !is_same_document(other))
        found.push_back({{},
                         other.option,
                         "names a file of the folder of " + one.option + " (" + other.path.string() +
                             "), where this command's results may go",
                         "choose another name or another folder"});
    }
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace shakedown
