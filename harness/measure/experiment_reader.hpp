// SPDX-License-Identifier: MIT
// Reads values of one table of an experiment file as the table of its keys says.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "experiment_keys.hpp"
#include "toml_document.hpp"

namespace shakedown {

/// A table of an experiment file. What is wrong in it goes to `violations`. Every key that is asked for must
/// be one of the table's (EXPECT).
class ExperimentReader {
 public:
  ExperimentReader(const TomlValue& table, ExperimentTable which, std::string path,
                   std::vector<Violation>& violations)
      : table_(&table), which_(which), path_(std::move(path)), violations_(&violations) {}

  /// Returns the value as it stands there, or nullptr.
  const TomlValue* find(std::string_view key) const;

  /// Return the value of a key of this table; empty or false where it is not given.
  std::string text(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key) const;
  bool flag(std::string_view key) const;
  /// Returns a quantity in SI, within the bounds of its key; `otherwise` where it is not given or wrong
  /// (reported).
  double number(std::string_view key, double otherwise) const;
  /// Returns one of the key's words; empty when it is absent or a table.
  std::string choice(std::string_view key) const;
  /// Returns the table of this name; nullptr when there is none or it is something else (reported).
  const TomlValue* table(std::string_view key) const;

  /// Adds a violation about a value of this table, with its place and what to do.
  void report(const TomlValue& value, std::string_view key, const std::string& problem,
              const std::string& remedy) const;

  /// Reports every key that the table does not have.
  void report_unknown() const;

 private:
  /// Returns what is known of a key of this table.
  const ExperimentKey& key_of(std::string_view key) const { return experiment_key(which_, key); }

  const TomlValue* table_;
  ExperimentTable which_;
  std::string path_;
  std::vector<Violation>* violations_;
};

/// Returns "did you mean 'x'? known: a, b, c".
std::string remedy_for_word(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace shakedown
