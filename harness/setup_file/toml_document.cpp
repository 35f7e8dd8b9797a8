// SPDX-License-Identifier: MIT
#include "toml_document.hpp"

// toml++ 3.3 asserts on some damaged files, "[[[1]]]" for one (its pull request 301), instead of reporting
// them; without assertions the same places are undefined behaviour. So assertions stay on in every build, and
// throw.
namespace {
struct TomlAssertion {};
[[noreturn]] void toml_assertion_failed() { throw TomlAssertion{}; }
}  // namespace
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void(0) : toml_assertion_failed())
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace shakedown {

namespace {

SourcePlace place_of(const toml::source_region& source, const std::string& name) {
  return {name, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

TomlValue converted(const toml::node& node, const std::string& name);

void add_entries(const toml::table& table, const std::string& name, TomlValue& value) {
  for (const auto& [key, node] : table)
    value.entries.push_back({std::string(key.str()), place_of(key.source(), name), converted(node, name)});
  std::stable_sort(value.entries.begin(), value.entries.end(), [](const TomlEntry& a, const TomlEntry& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
}

TomlValue converted(const toml::node& node, const std::string& name) {
  using Kind = TomlValue::Kind;
  TomlValue value;
  value.place = place_of(node.source(), name);
  if (const auto* table = node.as_table()) {
    value.kind = Kind::table;
    add_entries(*table, name, value);
  } else if (const auto* array = node.as_array()) {
    value.kind = Kind::array;
    for (const toml::node& item : *array) value.items.push_back(converted(item, name));
  } else if (const auto* text = node.as_string()) {
    value.kind = Kind::text;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = Kind::integer;
    value.integer = integer->get();
    value.number = static_cast<double>(integer->get());
  } else if (const auto* number = node.as_floating_point()) {
    value.kind = Kind::number;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = Kind::boolean;
    value.boolean = boolean->get();
  } else {
    value.kind = Kind::date;
    std::ostringstream written;
    node.visit([&](const auto& concrete) { written << concrete; });
    value.text = written.str();
  }
  return value;
}

/// The first line with which the file cannot be read, found by reading ever more lines.
int line_of_assertion(std::string_view text) {
  int line = 1;
  for (std::size_t end = text.find('\n'); end != text.npos; end = text.find('\n', end + 1), ++line) {
    try {
      (void)toml::parse(text.substr(0, end));
    } catch (const toml::parse_error&) {
      continue;  // a value that goes on in the next line
    } catch (const TomlAssertion&) {
      break;
    }
  }
  return line;
}

constexpr const char* syntax_remedy =
    "correct the syntax: a text stands in quotation marks, every key once, one key = value a line";

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
  for (const TomlEntry& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

std::string_view describe(TomlValue::Kind kind) {
  switch (kind) {
    case TomlValue::Kind::text: return "a text";
    case TomlValue::Kind::integer: return "a whole number";
    case TomlValue::Kind::number: return "a number";
    case TomlValue::Kind::boolean: return "true or false";
    case TomlValue::Kind::date: return "a date or time";
    case TomlValue::Kind::array: return "an array";
    case TomlValue::Kind::table: return "a table";
  }
  return "";
}

TomlValue parse_toml(std::string_view text, const std::string& name) {
  try {
    return converted(toml::parse(text, name), name);
  } catch (const toml::parse_error& error) {
    throw InputError({{place_of(error.source(), name), "",
                       "is not TOML (" + std::string(error.description()) + ")", syntax_remedy}});
  } catch (const TomlAssertion&) {
    throw InputError(
        {{{name, line_of_assertion(text), 1}, "", "is not TOML (the line cannot be read)", syntax_remedy}});
  }
}

std::string read_text_file(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw FileError(file.string() + ": is a folder, not a file; name the file in it");
  std::ifstream input(file, std::ios::binary);
  std::ostringstream text;
  if (input) text << input.rdbuf();
  if (!input || input.bad())
    throw FileError(file.string() + ": cannot be read (" + std::strerror(errno) +
                    "); check the path and its permissions");
  return text.str();
}

}  // namespace shakedown
