// SPDX-License-Identifier: MIT
// What a source says of itself, read line by line: functions, parameters, names, comparisons.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

/// Headers and sources of a folder of the project, sorted; none where there is no such folder.
std::vector<std::filesystem::path> sources_of(const std::string& folder);

/// Lines of a test's source, from 1, with a comparison of numbers whose tolerance nobody has measured, and
/// no reason for it: "not WITHIN: ..." on that line or the one above.
std::vector<int> bare_comparisons(std::istream& source);

/// Lines from the brace that opens a function at the margin, or in a class at the margin, to the one that
/// closes it; tables are no functions.
struct LongFunction {
  int line = 0, lines = 0;
  std::string head;
};
std::vector<LongFunction> functions_of(const std::filesystem::path& file);

/// Of a function's definition or of a declaration in a header, the number of its parameters.
struct ParameterList {
  int line = 0, parameters = 0;
  std::string name;
};
std::vector<ParameterList> parameter_lists_of(const std::string& text);

using Names = std::map<std::string, std::string>;  ///< with the line that gives each

/// What the unnamed namespaces of a source name at the beginning of a line: types and aliases, functions,
/// values.
Names hidden_names_of(const std::filesystem::path& file);

/// Types that the headers of a folder name at the beginning of a line.
Names types_of_headers(const std::string& folder);
