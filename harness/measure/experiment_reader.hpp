// SPDX-License-Identifier: MIT
// Values of one table of an experiment file.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "toml_document.hpp"

namespace shakedown {

/// What is wrong goes to `violations`, what nobody asked for is reported as unknown.
class ExperimentReader {
 public:
  ExperimentReader(const TomlValue& table, std::string path, std::vector<Violation>& violations)
      : table_(&table), path_(std::move(path)), violations_(&violations) {}

  const TomlValue* find(std::string_view key);
  std::string text(std::string_view key);
  double number(std::string_view key, std::string_view unit, double otherwise);
  double positive(std::string_view key, std::string_view unit, double otherwise);
  /// The table of this name; nullptr when there is none or it is something else (reported).
  const TomlValue* table(std::string_view key, const std::string& remedy);
  bool boolean(std::string_view key);
  void report(const TomlValue& value, std::string_view key, const std::string& problem,
              const std::string& remedy);
  void report_unknown();

 private:
  const TomlValue* table_;
  std::string path_;
  std::vector<Violation>* violations_;
  std::vector<std::string_view> known_;
};

}  // namespace shakedown
