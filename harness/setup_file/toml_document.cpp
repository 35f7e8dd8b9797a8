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
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sstream>

#include "kept_files.hpp"

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

/// Returns the first line with which the file cannot be read, found by reading ever more lines.
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

/// The parser, which recurses, is handed no more than this. Setups and experiments stay far below: they nest
/// 3 deep.
constexpr std::size_t most_bytes = 16'000'000;
constexpr int deepest = 64;

/// Walks over a TOML text, leaving out texts and comments, and counts brackets within brackets and parts of a
/// dotted key.
class Depth {
 public:
  explicit Depth(std::string_view text) : text_(text) {}

  /// Returns the first line that goes deeper than allowed; 0 when none does.
  int line_too_deep() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"' || c == '\'')
        skip_text(c);
      else if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      else
        count(c);
      if (brackets_ > deepest || dots_ > deepest) return line_;
    }
    return 0;
  }

 private:
  void count(char c) {
    if (c == '\n') ++line_;
    if (c == '[' || c == '{') ++brackets_;
    if ((c == ']' || c == '}') && brackets_ > 0) --brackets_;
    if (c == '.') ++dots_;
    if (c == '\n' || c == '=' || c == ',' || c == '{' || c == '[') dots_ = 0;
  }

  /// Goes to the last character of the text that begins here, or to the end of the line when it is not
  /// closed.
  void skip_text(char quote) {
    const std::string three(3, quote);
    const bool long_one = text_.substr(at_).starts_with(three);
    at_ += long_one ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] == '\n' && !long_one) return;
      if (text_[at_] == '\\' && quote == '"') {
        ++at_;
      } else if (long_one ? text_.substr(at_).starts_with(three) : text_[at_] == quote) {
        at_ += long_one ? 2 : 0;
        return;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, brackets_ = 0, dots_ = 0;
};

void refuse_what_no_parser_should_see(std::string_view text, const std::string& name) {
  if (text.size() > most_bytes)
    throw InputError({{{name, 0, 0},
                       "",
                       "is too large for a TOML file of this program (" + std::to_string(text.size()) +
                           " bytes; 16 MB are the most)",
                       "check that it is the file you mean"}});
  if (const int line = Depth(text).line_too_deep(); line > 0)
    throw InputError({{{name, line, 1},
                       "",
                       "nests deeper than " + std::to_string(deepest) + " brackets or parts of a key",
                       "write it flatter: a setup needs [section], key = value and [[effect]] alone"}});
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
  refuse_what_no_parser_should_see(text, name);
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
  if (file.empty()) throw FileError("the name of a file is empty; name the file to read");
  expect_no_pipe(file);
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw FileError(file.string() + ": is a folder, not a file; name the file in it");
  const auto refuse = [&] {
    throw FileError(file.string() + ": cannot be read (" + std::strerror(errno) +
                    "); check the path and its permissions");
  };
  // C's streams tell a read error from the end of the file; those of C++ do not.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!stream) refuse();
  std::string text;
  std::array<char, 65536> part;
  for (std::size_t n = 1; n > 0;) {
    n = std::fread(part.data(), 1, part.size(), stream.get());
    text.append(part.data(), n);
  }
  if (std::ferror(stream.get()) != 0) refuse();
  return text;
}

}  // namespace shakedown
