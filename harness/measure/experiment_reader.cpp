// SPDX-License-Identifier: MIT
#include "experiment_reader.hpp"

#include <algorithm>

#include "suggestion.hpp"
#include "value_reading.hpp"

namespace shakedown {

using TomlKind = TomlValue::Kind;

namespace {

std::string example_of(const ExperimentKey& key) {
  const bool whole_line = key.example.starts_with('[') && key.kind != ExperimentKind::texts;
  return "write " + (whole_line || key.example.find(" = ") != std::string_view::npos
                         ? std::string(key.example)
                         : std::string(key.name) + " = " + std::string(key.example));
}

}  // namespace

const TomlValue* ExperimentReader::find(std::string_view key) const { return table_->find(key_of(key).name); }

std::string ExperimentReader::text(std::string_view key) const {
  const TomlValue* value = find(key);
  if (!value || value->kind == TomlKind::text) return value ? value->text : "";
  report(*value, key, "is " + std::string(describe(value->kind)) + " where a text is due",
         example_of(key_of(key)));
  return {};
}

std::vector<std::string> ExperimentReader::texts(std::string_view key) const {
  const TomlValue* value = find(key);
  std::vector<std::string> texts;
  const auto add = [&](const TomlValue& item) {
    if (item.kind == TomlKind::integer)
      texts.push_back(std::to_string(item.integer));
    else if (item.kind == TomlKind::text)
      texts.push_back(item.text);
    else
      report(item, key, "is " + std::string(describe(item.kind)) + " where a text is due",
             example_of(key_of(key)));
  };
  if (value && value->kind == TomlKind::array)
    for (const TomlValue& item : value->items) add(item);
  else if (value)
    add(*value);
  return texts;
}

bool ExperimentReader::flag(std::string_view key) const {
  const TomlValue* value = find(key);
  if (!value) return false;
  if (value->kind != TomlKind::boolean)
    report(*value, key, "is neither true nor false", "write true or false");
  return value->boolean;
}

double ExperimentReader::number(std::string_view name, double otherwise) const {
  const TomlValue* value = find(name);
  if (!value) return otherwise;
  const ExperimentKey& key = key_of(name);
  const ValueOrProblem<double> result = number_in(*value, key.unit);
  if (const auto* problem = std::get_if<Problem>(&result)) {
    report(*value, name, problem->problem, problem->remedy);
    return otherwise;
  }
  const double number = std::get<double>(result);
  const std::string why = out_of_bounds(number, key.low, key.high, true, key.unit);
  if (why.empty()) return number;
  report(*value, name, why, "correct it, e.g. " + std::string(key.name) + " = " + std::string(key.example));
  return otherwise;
}

std::string ExperimentReader::choice(std::string_view name) const {
  const TomlValue* value = find(name);
  if (!value || value->kind == TomlKind::table) return {};
  const ValueOrProblem<std::string> word = choice_in(*value, key_of(name).choices);
  if (const std::string* found = std::get_if<std::string>(&word)) return *found;
  report(*value, name, std::get<Problem>(word).problem, std::get<Problem>(word).remedy);
  return {};
}

const TomlValue* ExperimentReader::table(std::string_view key) const {
  const TomlValue* value = find(key);
  if (!value || value->kind == TomlKind::table) return value;
  report(*value, key, "is " + std::string(describe(value->kind)) + " where a table is due",
         example_of(key_of(key)));
  return nullptr;
}

void ExperimentReader::report(const TomlValue& value, std::string_view key, const std::string& problem,
                              const std::string& remedy) const {
  violations_->push_back({value.place, path_ + std::string(key), problem, remedy});
}

void ExperimentReader::report_unknown() const {
  const std::vector<std::string_view> known = names_of_keys(which_);
  for (const TomlEntry& entry : table_->entries)
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      violations_->push_back({entry.place, path_ + entry.key, "is not a key of the experiment file",
                              remedy_for_word(entry.key, known)});
}

std::string remedy_for_word(std::string_view word, const std::vector<std::string_view>& known) {
  const std::string_view near = nearest(word, known);
  return (near.empty() ? "" : "did you mean '" + std::string(near) + "'? ") + "known here: " + listed(known);
}

}  // namespace shakedown
