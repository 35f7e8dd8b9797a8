// SPDX-License-Identifier: MIT
#include "table.hpp"

#include <iconv.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include "kept_files.hpp"
#include "table_text.hpp"

namespace shakedown {

namespace {

using Row = std::vector<std::string>;

struct Line {
  std::string_view text;
  int number = 0;
};

bool is_comment(std::string_view text) {
  return (text.starts_with('#') || text.starts_with('%') || text.starts_with("//")) &&
         !is_blank_cell(text.substr(0, text.find_first_of(",;\t ")));  // a spreadsheet's #NV is no comment
}

std::vector<Line> lines_of(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<Line> lines;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    ++number;
    if (!trimmed(text.substr(0, end)).empty()) lines.push_back({text.substr(0, end), number});
    const bool two = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
    text.remove_prefix(std::min(text.size(), end + (two ? 2 : 1)));
  }
  return lines;
}

/// Returns lines from the second half, which is data in every format we know, whatever stands above it.
std::vector<std::string_view> sample_of(const std::vector<Line>& lines) {
  std::vector<std::string_view> sample;
  for (std::size_t i = lines.size() / 2; i < lines.size() && sample.size() < 200; ++i)
    if (!is_comment(trimmed(lines[i].text))) sample.push_back(lines[i].text);
  return sample;
}

bool has_decimal_comma(const std::vector<std::string_view>& sample, char delimiter) {
  if (delimiter == ',') return false;
  for (const std::string_view line : sample)
    for (const std::string& cell : split_cells(line, delimiter))
      if (!cell_number(cell, false) && cell.find(',') != std::string::npos && cell_number(cell, true))
        return true;
  return false;
}

/// Returns the text as UTF-8; nothing where it is not of this encoding (a name that iconv knows).
std::optional<std::string> utf8_from(const char* encoding, std::string_view text) {
  const iconv_t converter = iconv_open("UTF-8", encoding);
  EXPECT(converter != reinterpret_cast<iconv_t>(-1));
  std::string result(2 * text.size() + 4, '\0');
  char *in = const_cast<char*>(text.data()), *out = result.data();
  std::size_t in_left = text.size(), out_left = result.size();
  const bool whole = iconv(converter, &in, &in_left, &out, &out_left) != static_cast<std::size_t>(-1);
  iconv_close(converter);
  if (!whole) return std::nullopt;
  result.resize(result.size() - out_left);
  return result;
}

std::size_t filled(const Row& row) {
  return static_cast<std::size_t>(
      std::count_if(row.begin(), row.end(), [](const std::string& cell) { return !cell.empty(); }));
}

bool is_data(const Row& row, std::size_t width, bool decimal_comma) {
  std::size_t numbers = 0, words = 0;
  for (const std::string& cell : row)
    if (!is_blank_cell(cell)) ++(cell_number(cell, decimal_comma) ? numbers : words);
  return numbers >= 1 && numbers >= words && 2 * row.size() >= width;
}

/// Tells whether a row has names over every column and no number: what follows with a number in it is data,
/// if bad data.
bool is_row_of_names(const Row& row, std::size_t width, bool decimal_comma) {
  return filled(row) == width && std::none_of(row.begin(), row.end(), [&](const std::string& cell) {
           return cell_number(cell, decimal_comma).has_value();
         });
}

bool holds_number(const Row& row, bool decimal_comma) {
  return std::any_of(row.begin(), row.end(),
                     [&](const std::string& cell) { return cell_number(cell, decimal_comma).has_value(); });
}

/// Splits "x [mm]" and "x (mm)" into name and unit.
std::pair<std::string, std::string> name_and_unit(const std::string& header) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t begin = header.rfind(open);
    if (header.ends_with("(t)")) continue;  // x(t): a function of time, not tons
    if (header.empty() || header.back() != close || begin == std::string::npos) continue;
    return {std::string(trimmed(header.substr(0, begin))),
            std::string(trimmed(header.substr(begin + 1, header.size() - begin - 2)))};
  }
  return {header, ""};
}

bool is_row_of_units(const Row& row) {
  bool any = false;
  for (const std::string& cell : row) {
    if (cell.empty()) continue;
    if (!name_and_unit(cell).first.empty() || name_and_unit(cell).second.empty()) return false;
    any = true;
  }
  return any;
}

bool has_twins(const Row& row) {
  std::set<std::string> seen;
  for (const std::string& cell : row)
    if (!cell.empty() && !seen.insert(cell).second) return true;
  return false;
}

/// Puts the names of tracks before those of their columns: they stand over the first column of each track,
/// with blanks over the others.
void put_track_before_names(const Row& tracks, Row& names) {
  std::string track;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i < tracks.size() && !tracks[i].empty()) track = tracks[i];
    if (!track.empty() && !names[i].empty()) names[i] = track + "." + names[i];
  }
}

std::vector<TableColumn> columns_of(const std::vector<Row>& header, std::size_t width) {
  std::vector<TableColumn> columns(width);
  const auto names_row = std::max_element(header.begin(), header.end(), [](const Row& a, const Row& b) {
    return filled(a) < filled(b);  // the first of the fullest rows
  });
  Row names = names_row == header.end() ? Row{} : *names_row;
  if (names_row != header.end() && names_row != header.begin() && has_twins(names))
    put_track_before_names(*std::prev(names_row), names);
  for (std::size_t i = 0; i < width; ++i) {
    std::tie(columns[i].name, columns[i].unit) = name_and_unit(i < names.size() ? names[i] : "");
    if (columns[i].name.empty()) columns[i].name = "column " + std::to_string(i + 1);
  }
  if (names_row == header.end()) return columns;
  for (auto row = std::next(names_row); row != header.end(); ++row)
    for (std::size_t i = 0; is_row_of_units(*row) && i < std::min(width, row->size()); ++i)
      if (columns[i].unit.empty()) columns[i].unit = name_and_unit((*row)[i]).second;
  return columns;
}

void append_row(Table& table, Row cells, int line) {
  const std::size_t width = table.columns.size();
  while (cells.size() > width && cells.back().empty()) cells.pop_back();
  // One message for all lines that are cut off alike.
  const bool said =
      std::any_of(table.violations.begin(), table.violations.end(), [&](const Violation& other) {
        return other.problem.starts_with("has " + std::to_string(cells.size()) + " cells");
      });
  if (cells.size() != width && !said)
    table.violations.push_back({{table.file, line, 1},
                                "",
                                "has " + std::to_string(cells.size()) + " cells where the table has " +
                                    std::to_string(width) + " columns (cut off, or a delimiter too many?)",
                                "complete or delete the line, and others like it"});
  cells.resize(width);
  for (std::size_t i = 0; i < width; ++i) {
    const std::optional<double> number = cell_number(cells[i], table.decimal_comma);
    if (!number && !is_blank_cell(cells[i])) table.columns[i].not_numbers.push_back({table.rows(), cells[i]});
    table.columns[i].value.push_back(number.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  table.line.push_back(line);
}

std::size_t commonest_width(const std::vector<std::string_view>& sample, char delimiter) {
  std::map<std::size_t, int> of_width;
  for (const std::string_view line : sample) {
    ++of_width[split_cells(line, delimiter).size()];
  }
  return std::max_element(of_width.begin(), of_width.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// Removes last columns that have neither a name nor a number: shadows of a delimiter at the end of each
/// line.
void drop_shadow_columns(Table& table) {
  while (!table.columns.empty() && table.columns.back().name.starts_with("column ") &&
         table.columns.back().not_numbers.empty() &&
         std::all_of(table.columns.back().value.begin(), table.columns.back().value.end(),
                     [](double value) { return value != value; }))
    table.columns.pop_back();
}

/// Names are searched for words and units, which takes memory that grows with their length.
constexpr std::size_t longest_name = 200;

[[noreturn]] void refuse(const std::string& name, const std::string& problem, const std::string& remedy) {
  throw InputError({{{name, 1, 1}, "", problem, remedy}});
}

}  // namespace

namespace {

/// Refuses files that are no text, by their first bytes.
void refuse_other_formats(std::string_view text, const std::string& name) {
  const std::string save_as = "open it there and save it as CSV UTF-8 (File, Save as)";
  if (text.starts_with("MATLAB 5.0") || text.starts_with("\x89HDF"))
    refuse(name, "is a MATLAB file (or HDF5)",
           "write it as text in MATLAB: writetable(table(t, x), 'run.csv')  % column vectors");
  if (text.starts_with("PK\x03\x04") || text.starts_with("\xD0\xCF\x11\xE0"))
    refuse(name, "is a spreadsheet file (Excel, LibreOffice)", save_as);
  if (text.starts_with("RIFF") || text.substr(0, 12).find("ftyp") == 4)
    refuse(name, "is a film", "track the box in it first (Tracker, TrackMate, trackpy) and export a table");
  if (text.starts_with("\x93NUMPY")) refuse(name, "is a NumPy file", "write it with numpy.savetxt");
  if (text.starts_with("\x1F\x8B")) refuse(name, "is compressed", "unpack it first (gunzip)");
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    refuse(name, "is UTF-16 text (a spreadsheet's \"Unicode text\")", "save it as CSV UTF-8");
  if (const std::size_t at = text.find('\0'); at != text.npos)
    throw InputError({{{name, 1 + static_cast<int>(std::count(text.begin(), text.begin() + at, '\n')), 1},
                       "",
                       "is not text (the line holds a zero byte)",
                       "export the table as CSV"}});
}

}  // namespace

Table parse_table(std::string_view text, const std::string& name) {
  refuse_other_formats(text, name);
  if (!utf8_from("UTF-8", text)) {  // micro and degree signs in one byte, as older programs write them
    Table table = parse_table(*utf8_from("ISO-8859-1", text), name);
    table.latin = true;
    return table;
  }
  const std::vector<Line> lines = lines_of(text);
  const std::vector<std::string_view> sample = sample_of(lines);
  if (sample.empty()) refuse(name, "holds no data", "give a table with at least one row");
  Table table;
  table.file = name;
  table.delimiter = find_delimiter(sample);
  table.decimal_comma = has_decimal_comma(sample, table.delimiter);
  const std::size_t width = commonest_width(sample, table.delimiter);

  std::vector<Row> header;
  Row last_comment;
  std::size_t first = 0;
  bool named = false;
  for (; first < lines.size(); ++first) {
    const std::string_view line = trimmed(lines[first].text);
    if (is_comment(line)) {
      last_comment =
          split_cells(line.substr(std::min(line.find_first_not_of("#%/"), line.size())), table.delimiter);
      continue;
    }
    Row cells = split_cells(lines[first].text, table.delimiter);
    if (is_data(cells, width, table.decimal_comma)) break;
    if (named && cells.size() == width && holds_number(cells, table.decimal_comma)) break;
    named = named || is_row_of_names(cells, width, table.decimal_comma);
    header.push_back(std::move(cells));
  }
  if (first == lines.size()) refuse(name, "holds no row of numbers", "export the table as text with numbers");
  if (header.empty() && last_comment.size() == width) header.push_back(last_comment);
  table.header_lines = lines[first].number - 1;
  table.columns = columns_of(header, width);
  for (const TableColumn& column : table.columns)
    if (column.name.size() > longest_name)
      refuse(name,
             "has a column name of " + std::to_string(column.name.size()) + " characters (" +
                 std::to_string(longest_name) + " are the most)",
             "export the table with short names in one line above the numbers");
  // Spreadsheets write lines of nothing but delimiters below the last row.
  std::size_t end = lines.size();
  while (end > first + 1 && filled(split_cells(trimmed(lines[end - 1].text), table.delimiter)) == 0) --end;
  for (std::size_t i = first; i < end; ++i)
    if (!is_comment(trimmed(lines[i].text)))
      append_row(table, split_cells(lines[i].text, table.delimiter), lines[i].number);
  drop_shadow_columns(table);
  return table;
}

Table read_table(const std::filesystem::path& file) {
  keep_unchanged(file);
  std::ifstream input(file, std::ios::binary);
  std::stringstream text;
  std::error_code unreadable;  // of a path that leads nowhere
  const bool is_folder = std::filesystem::is_directory(file, unreadable);
  if (!is_folder) text << input.rdbuf();
  if (is_folder) throw FileError(file.string() + ": is a folder, not a table; name the file in it");
  if (!input) cannot_be_read(file);
  return parse_table(text.str(), file.string());
}

const TableColumn* find_column(const Table& table, std::string_view name) {
  for (const TableColumn& column : table.columns)
    if (column.name == name || (!column.unit.empty() && (column.name + " [" + column.unit + "]" == name ||
                                                         column.name + " (" + column.unit + ")" == name)))
      return &column;
  return nullptr;
}

const TableColumn* find_track_column(const Table& table) {
  for (const char* name : {"TRACK_ID", "particle", "track_id"})
    if (const TableColumn* column = find_column(table, name)) return column;
  static const std::regex numbered(R"(track[ _]?(|n|no|nr|number|id|#|n\xC2\xB0)\.?)", std::regex::icase);
  for (const TableColumn& column : table.columns)
    if (std::regex_match(column.name, numbered)) return &column;
  return nullptr;
}

std::vector<std::string> column_names(const Table& table) {
  std::vector<std::string> names;
  for (const TableColumn& column : table.columns) names.push_back(column.name);
  return names;
}

}  // namespace shakedown
