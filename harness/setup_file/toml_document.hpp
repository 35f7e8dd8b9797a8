// SPDX-License-Identifier: MIT
// A TOML file as a plain tree that knows where everything stands. The one place that opens the TOML library.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "errors.hpp"
#include "toml_string.hpp"

namespace shakedown {

struct TomlEntry;

struct TomlValue {
  enum class Kind { text, integer, number, boolean, date, array, table };
  Kind kind = Kind::table;
  std::string text;  ///< of a text, or of a date as written
  std::int64_t integer = 0;
  double number = 0;  ///< of an integer too
  bool boolean = false;
  std::vector<TomlValue> items;
  std::vector<TomlEntry> entries;  ///< in the order of the file
  SourcePlace place;

  /// Returns the value of a key, or nullptr.
  const TomlValue* find(std::string_view key) const;
};

struct TomlEntry {
  std::string key;
  SourcePlace place;  ///< of the key
  TomlValue value;
};

/// Returns words for messages: "a text", "a whole number" ...
std::string_view describe(TomlValue::Kind kind);

/// Reads a TOML text; `name` stands for the file in places. Throws InputError with the place of a syntax
/// error, and for a text of more than 16 MB or one that nests deeper than 64.
TomlValue parse_toml(std::string_view text, const std::string& name);

/// Returns the whole file; throws FileError, also when reading fails half way.
std::string read_text_file(const std::filesystem::path& file);

}  // namespace shakedown
