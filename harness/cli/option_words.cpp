// SPDX-License-Identifier: MIT
#include "option_words.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "comma_list.hpp"
#include "effects.hpp"
#include "engines.hpp"

namespace shakedown {

namespace {

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const EffectRecord* effect : all_effects()) names.emplace_back(effect->name);
  return names;
}

bool is_any_of(const std::string& name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the choices of "KIND:{a,b}", which stand between the braces.
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return split_at_commas(type.substr(open + 1, close - open - 1));
}

std::vector<std::string> choices_of(const OptionWords& option, const std::string& command,
                                    const std::string& type) {
  if (std::vector<std::string> listed = choices_in(type); !listed.empty()) return listed;
  const std::string& name = option.names.front();
  if (is_any_of(name, {"--engine", "--engines"})) return engine_names();
  if (is_any_of(name, {"--effect", "--effects", "EFFECT"})) return effect_names();
  if (name == "NAME" && command == "effects") return effect_names();
  return {};
}

ValueKind kind_of(const OptionWords& option) {
  if (!option.choices.empty()) return ValueKind::words;
  if (option.type.find("DIR") != std::string::npos) return ValueKind::folder;
  for (const char* file : {"FILE", "EXPERIMENT", "TOML"})
    if (option.type.find(file) != std::string::npos) return ValueKind::file;
  if (option.positional && !is_any_of(option.names.front(), {"values", "NAME"})) return ValueKind::file;
  return ValueKind::any;
}

/// Returns the place where the parser has added what it checks to the type's own name, which may have colons
/// too; npos: nowhere.
std::size_t end_of_type(const std::string& type) {
  std::size_t end = std::string::npos;
  for (const char* check : {":{", ":POSITIVE", ":INT in [", ":UINT in [", ":FLOAT in ["})
    end = std::min(end, type.find(check));
  return end;
}

OptionWords words_of(const CLI::Option& option, const std::string& command) {
  OptionWords words;
  words.positional = option.get_positional();
  if (words.positional) {
    words.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
    for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  }
  words.required = option.get_required();
  words.repeated = option.get_expected_max() > 1;
  words.value_optional = option.get_expected_min() == 0 && option.get_expected_max() > 0;
  words.sentence = option.get_description();
  words.otherwise = option.get_default_str();
  const bool flag = option.get_expected_max() == 0 || option.get_type_size() == 0;
  const std::string type = flag ? "" : option.get_type_name();
  const std::size_t bounds = end_of_type(type);
  words.type = type.substr(0, bounds);
  if (bounds != std::string::npos) words.bounds = type.substr(bounds + 1);
  words.choices = flag ? std::vector<std::string>() : choices_of(words, command, type);
  words.kind = flag ? ValueKind::none : kind_of(words);
  return words;
}

}  // namespace

std::vector<OptionWords> options_of(const CLI::App& command) {
  std::vector<OptionWords> found;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty()) found.push_back(words_of(*option, command.get_name()));
  return found;
}

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

bool handed_on(const CLI::App& command) { return command.get_prefix_command(); }

std::string dashed_name(const std::string& program, const CLI::App& command) {
  std::string name = command.get_name();
  for (const CLI::App* above = command.get_parent(); above != nullptr && above->get_parent() != nullptr;
       above = above->get_parent())
    name = above->get_name() + "-" + name;
  return program + "-" + name;
}

}  // namespace shakedown
