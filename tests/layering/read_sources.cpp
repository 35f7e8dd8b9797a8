// SPDX-License-Identifier: MIT
#include "read_sources.hpp"

#include <algorithm>
#include <fstream>
#include <istream>
#include <regex>

namespace fs = std::filesystem;

std::vector<fs::path> sources_of(const std::string& folder) {
  std::vector<fs::path> files;
  const fs::path root = fs::path(PROJECT_ROOT) / folder;
  if (!fs::exists(root)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(root))
    if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<int> bare_comparisons(std::istream& source) {
  static const std::string bare = "_NEAR(", reason = "// not WITHIN: ";  // of EXPECT and of ASSERT
  std::vector<int> found;
  std::string line, above;
  for (int number = 1; std::getline(source, line); ++number, above = line)
    if (line.find(bare) != std::string::npos && line.find(reason) == std::string::npos &&
        above.find(reason) == std::string::npos)
      found.push_back(number);
  return found;
}

std::vector<LongFunction> functions_of(const fs::path& file) {
  static const std::regex head("(  )?[A-Za-z_~][^=;#]*\\)[^=;()]*\\{"),
      no_function("\\s*(if|for|while|switch|else|try|namespace|TEST\\w*)\\b.*"),
      table(".*\\b(table|force_shapes)\\(\\) \\{");
  std::vector<LongFunction> found;
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!std::regex_match(lines[i], head) || std::regex_match(lines[i], no_function) ||
        std::regex_match(lines[i], table))
      continue;
    const std::string end = lines[i].starts_with(' ') ? "  }" : "}";
    std::size_t last = i + 1;
    while (last < lines.size() && !lines[last].starts_with(end)) ++last;
    found.push_back({static_cast<int>(i) + 1, static_cast<int>(last - i) + 1, lines[i]});
  }
  return found;
}

std::vector<ParameterList> parameter_lists_of(const std::string& text) {
  // A name, parentheses with commas and without statements, and what may follow a list. What overrides has
  // the parameters of another's function.
  static const std::regex list(
      "\\b(\\w+)\\(((?:[^(){};]|\\([^(){};]*\\))*,(?:[^(){};]|\\([^(){};]*\\))*)\\)"
      "\\s*(?:const|noexcept|\\s)*[{;:]"),
      named("(?:\\w[&*]+|>|\\b(?:double|int|bool|float|size_t|Index|\\w+_t)) \\w+(?: = [^,]*)?(?:,|$)");
  std::vector<ParameterList> found;
  for (std::sregex_iterator one(text.begin(), text.end(), list), none; one != none; ++one) {
    const std::string inside = (*one)[2];
    if (!std::regex_search(inside, named)) continue;  // a call
    int depth = 0, parameters = 1;
    for (const char c : inside) {
      if (c == '<' || c == '(') ++depth;
      if (c == '>' || c == ')') --depth;
      if (c == ',' && depth == 0) ++parameters;
    }
    const auto line = std::count(text.begin(), text.begin() + one->position(), '\n') + 1;
    found.push_back({static_cast<int>(line), parameters, (*one)[1]});
  }
  return found;
}

namespace {

const std::regex type_named("(?:struct|class|enum class|enum|using|namespace) (\\w+).*");

}  // namespace

Names hidden_names_of(const fs::path& file) {
  static const std::regex value_or_function("(?:[^=({;]*[\\s*&])?(\\w+)\\s*[(={;\\[].*");
  static const std::regex further_value(", (\\w+) = ");
  Names names;
  std::ifstream stream(file);
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("namespace {")) {
      inside = true;
      continue;
    }
    if (line.starts_with("}  // namespace")) inside = false;
    if (!inside || line.empty() || std::string(" }#/").find(line[0]) != std::string::npos ||
        line.starts_with("template"))
      continue;
    std::smatch match;
    if (std::regex_match(line, match, type_named) || std::regex_match(line, match, value_or_function))
      names.emplace(match[1], line);
    if (line.starts_with("const"))
      for (std::sregex_iterator more(line.begin(), line.end(), further_value), none; more != none; ++more)
        names.emplace((*more)[1], line);
  }
  return names;
}

Names types_of_headers(const std::string& folder) {
  Names names;
  for (const fs::path& file : sources_of(folder)) {
    if (file.extension() != ".hpp") continue;
    std::ifstream stream(file);
    std::smatch match;
    for (std::string line; std::getline(stream, line);)
      if (!line.starts_with("namespace") && !line.ends_with(";") && std::regex_match(line, match, type_named))
        names.emplace(match[1], line);
  }
  return names;
}
