// SPDX-License-Identifier: MIT
#include "experiment_reader.hpp"

#include <algorithm>
#include <limits>

#include "suggestion.hpp"
#include "value_reading.hpp"

namespace shakedown {

using Kind = TomlValue::Kind;

const TomlValue* ExperimentReader::find(std::string_view key) {
  known_.emplace_back(key);
  return table_->find(key);
}

std::string ExperimentReader::text(std::string_view key) {
  const TomlValue* value = find(key);
  if (!value) return {};
  if (value->kind == Kind::text) return value->text;
  report(*value, key, "is " + std::string(describe(value->kind)) + " where a text is due",
         "write it in quotes");
  return {};
}

double ExperimentReader::number(std::string_view key, std::string_view unit, double otherwise) {
  const TomlValue* value = find(key);
  if (!value) return otherwise;
  const ValueOrProblem<double> result = number_in(*value, unit);
  if (const double* number = std::get_if<double>(&result)) return *number;
  report(*value, key, std::get<Problem>(result).problem, std::get<Problem>(result).remedy);
  return otherwise;
}

double ExperimentReader::positive(std::string_view key, std::string_view unit, double otherwise) {
  constexpr double absent = -std::numeric_limits<double>::infinity();  // or wrong, and reported
  const double value = number(key, unit, absent);
  if (value > 0) return value;
  if (value != absent) report(*table_->find(key), key, "must be greater than 0", "");
  return otherwise;
}

const TomlValue* ExperimentReader::table(std::string_view key, const std::string& remedy) {
  const TomlValue* value = find(key);
  if (!value || value->kind == Kind::table) return value;
  report(*value, key, "is " + std::string(describe(value->kind)) + " where a table is due", remedy);
  return nullptr;
}

bool ExperimentReader::boolean(std::string_view key) {
  const TomlValue* value = find(key);
  if (!value) return false;
  if (value->kind != Kind::boolean) report(*value, key, "is neither true nor false", "write true or false");
  return value->boolean;
}

void ExperimentReader::report(const TomlValue& value, std::string_view key, const std::string& problem,
                              const std::string& remedy) {
  violations_->push_back({value.place, path_ + std::string(key), problem, remedy});
}

void ExperimentReader::report_unknown() {
  for (const TomlEntry& entry : table_->entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    const std::string_view near = nearest(entry.key, known_);
    violations_->push_back({entry.place, path_ + entry.key, "is not a key of the experiment file",
                            (near.empty() ? "" : "did you mean '" + std::string(near) + "'? ") +
                                "known here: " + listed(known_)});
  }
}

}  // namespace shakedown
