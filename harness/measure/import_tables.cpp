// SPDX-License-Identifier: MIT
#include "import_tables.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <optional>
#include <regex>
#include <set>

#include "column_reading.hpp"
#include "robust_statistics.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

std::string lower(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

bool contains_any(const std::string& text, const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return text.find(word) != std::string::npos; });
}

std::vector<double> numbers_of(const TableColumn& column) {
  std::vector<double> numbers;
  for (const double value : column.value)
    if (std::isfinite(value)) numbers.push_back(value);
  return numbers;
}

double range_of(const TableColumn& column) {
  const std::vector<double> numbers = numbers_of(column);
  if (numbers.empty()) return 0;
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  return *high - *low;
}

bool never_falls(const TableColumn& column) {
  const std::vector<double> numbers = numbers_of(column);
  return numbers.size() > 2 && std::is_sorted(numbers.begin(), numbers.end()) &&
         numbers.front() < numbers.back();
}

/// "x_box_mm", "t/s": the unit at the end of a name.
std::string unit_in_name(const std::string& name, bool is_time) {
  static const std::regex ending(R"(.*[_/ .]([A-Za-z]+)$)");
  std::smatch found;
  if (!std::regex_match(name, found, ending)) return "";
  const std::string unit = found[1];
  return unit_size(unit, is_time, {1, 1, 0}) ? unit : "";
}

/// The unit, and whether the table says it.
void guess_unit(const TableColumn& column, bool is_time, GuessedColumn& guess) {
  if (!column.unit.empty() && !unit_size(column.unit, is_time, {1, 1, 0})) {
    guess.unit = column.unit;
    guess.certain = false;
    guess.reason += "; its unit is none that shakedown knows";
    return;
  }
  guess.unit = !column.unit.empty() ? column.unit : unit_in_name(column.name, is_time);
  if (!guess.unit.empty()) return;
  guess.certain = false;
  if (is_time) {
    const std::string name = lower(column.name);
    const bool whole = std::all_of(column.value.begin(), column.value.end(),
                                   [](double v) { return !(std::abs(v - std::round(v)) > 0); });
    guess.unit = contains_any(name, {"frame", "slice"}) ? "frame"
                 : whole && range_of(column) > 200      ? "ms"
                                                        : "s";
    if (guess.unit == "frame") guess.certain = true;
  } else {
    // A damper swings by some 0.2 m about zero; pixels are counted from a corner and never negative.
    const std::vector<double> numbers = numbers_of(column);
    const bool from_a_corner = !numbers.empty() && *std::min_element(numbers.begin(), numbers.end()) >= 0;
    guess.unit = range_of(column) < 1 ? "m" : from_a_corner ? "px" : "mm";
  }
  guess.reason +=
      std::string("; unit guessed from ") + (is_time ? "the name and the steps" : "the size of the numbers");
}

/// "word": the whole name; "word*": a word in it begins so ("x_box", "posBox", not "index" for "x*").
bool names(const std::string& name, const std::string& word) {
  const std::string low = lower(name);
  if (!word.ends_with("*")) return low == word;
  const std::string start = word.substr(0, word.size() - 1);
  for (std::size_t at = low.find(start); at != std::string::npos; at = low.find(start, at + 1)) {
    const auto letter = [&](std::size_t i) { return static_cast<unsigned char>(name[i]); };
    if (at == 0 || !std::isalpha(letter(at - 1)) ||
        (std::isupper(letter(at)) && std::islower(letter(at - 1))))
      return true;
  }
  return false;
}

bool names_any(const std::string& name, const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return names(name, word); });
}

const TableColumn* best_column(const std::vector<std::vector<std::string>>& by_rank,
                               const std::vector<const TableColumn*>& candidates,
                               const std::set<std::string>& taken) {
  for (const std::vector<std::string>& words : by_rank)
    for (const TableColumn* column : candidates)
      if (!taken.contains(column->name) && column->not_numbers.size() < column->value.size() / 2 &&
          names_any(column->name, words))
        return column;
  return nullptr;
}

/// Without velocities, sizes, and what stands still: a position moves.
std::vector<const TableColumn*> possible_positions(const Table& table) {
  static const std::vector<std::string> others{"v",      "v_*",   "vx*",    "vy*",     "vel*",
                                               "speed*", "acc*",  "width*", "height*", "force*",
                                               "size*",  "area*", "energy*"};
  std::vector<const TableColumn*> columns;
  for (const TableColumn& column : table.columns) {
    const bool velocity = lower(column.name).ends_with("_v");
    const bool still = numbers_of(column).size() > 2 && !(range_of(column) > 0);
    if (!velocity && !still && !names_any(column.name, others)) columns.push_back(&column);
  }
  return columns;
}

std::vector<const TableColumn*> every_column(const Table& table) {
  std::vector<const TableColumn*> columns;
  for (const TableColumn& column : table.columns) columns.push_back(&column);
  return columns;
}

GuessedColumn guess_time(const Table& table) {
  GuessedColumn guess{"time", "", "", "", "by its name"};
  const TableColumn* column =
      best_column({{"t", "t_s", "time", "time_s", "position_t", "zeit", "temps", "seconds", "t_ms"},
                   {"time*", "zeit*"},
                   {"frame", "slice", "slice n", "frame*", "slice*"}},
                  every_column(table), {});
  if (!column) {
    for (const TableColumn& candidate : table.columns)
      if (never_falls(candidate)) {
        column = &candidate;
        guess.reason = "it only grows";
        guess.certain = false;
        break;
      }
  }
  if (!column) return {"time", "", "", "", "no column looks like a clock: rows are taken as frames", false};
  guess.from = column->name;
  guess_unit(*column, true, guess);
  return guess;
}

/// Of x and y of one track the one that moves more.
const TableColumn* along_the_motion(const Table& table, const TableColumn* column,
                                    const std::set<std::string>& taken) {
  if (!column) return nullptr;
  const std::string name = lower(column->name);
  if (name.empty() || (name.back() != 'x' && name.back() != 'y')) return column;
  const std::string twin = column->name.substr(0, column->name.size() - 1) + (name.back() == 'x' ? "y" : "x");
  std::string upper_twin = twin;
  upper_twin.back() = static_cast<char>(std::toupper(static_cast<unsigned char>(twin.back())));
  for (const std::string& other : {twin, upper_twin})
    if (const TableColumn* found = find_column(table, other);
        found && !taken.contains(other) && range_of(*found) > 1.5 * range_of(*column))
      return found;
  return column;
}

GuessedColumn guess_position(const Table& table, const std::string& role,
                             const std::vector<std::vector<std::string>>& words,
                             std::set<std::string>& taken) {
  GuessedColumn guess{role, "", "", "", "by its name"};
  const TableColumn* column =
      along_the_motion(table, best_column(words, possible_positions(table), taken), taken);
  if (!column) return {role, "", "", "", "no column looks like it", false};
  taken.insert(column->name);
  guess.from = column->name;
  guess_unit(*column, false, guess);
  return guess;
}

/// Tables with one row a track and frame: the first track is the box, the second the grains, until the user
/// says otherwise.
void guess_tracks(const Table& table, std::vector<GuessedColumn>& columns) {
  const TableColumn* tracks = find_track_column(table);
  if (!tracks) return;
  std::set<double> numbers;
  for (const double value : tracks->value)
    if (std::isfinite(value)) numbers.insert(value);
  if (numbers.empty()) return;
  columns[1].track = std::to_string(static_cast<long long>(*numbers.begin()));
  columns[1].certain = numbers.size() == 1;
  columns[1].reason +=
      numbers.size() == 1 ? "; one track" : "; the first of " + std::to_string(numbers.size()) + " tracks";
  if (numbers.size() < 2) return;
  columns[2] = columns[1];
  columns[2].role = "grain_centre";
  columns[2].track = std::to_string(static_cast<long long>(*std::next(numbers.begin())));
  columns[2].reason = "the second track";
}

struct GuessedLength {
  std::string millimetres;  ///< empty: the name does not say
  bool certain = true;      ///< no other number of millimetres stands in the name
};

/// "L040", "L=40.25mm", "65 mm_b": the letter counts for more, for grains have millimetres too.
GuessedLength length_in_name(const std::filesystem::path& file) {
  static const std::regex millimetres(R"((?:^|[^0-9.])([0-9]{2,3}(?:\.[0-9]+)?) ?mm)", std::regex::icase),
      letter(R"((?:^|[^A-Za-z])L[=_]?0*([1-9][0-9]{0,2}(?:\.[0-9]+)?)(?![0-9]))");
  const std::string name = file.stem().string();
  std::smatch found;
  GuessedLength length;
  if (std::regex_search(name, found, letter)) length.millimetres = found[1];
  for (std::sregex_iterator it(name.begin(), name.end(), millimetres), end; it != end; ++it) {
    const std::string other = (*it)[1];
    if (length.millimetres.empty()) length.millimetres = other;
    if (std::stod(other) != std::stod(length.millimetres)) length.certain = false;
  }
  return length;
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string column_text(const GuessedColumn& guess) {
  std::string text = "\n[column." + guess.role + "]  # " + guess.reason +
                     (guess.certain ? "" : "; PLEASE CHECK") + "\nfrom = " + toml_string(guess.from) +
                     "\nunit = " + toml_string(guess.unit) + "\n";
  if (!guess.track.empty()) text += "track = " + toml_string(guess.track) + "\n";
  if (guess.role != "time")
    text +=
        "# uncertainty = \"0.2 mm\"  # standard deviation of one frame; found from the frames when it is not "
        "given\n";
  return text;
}

std::string preview_of(const Table& table, const std::vector<GuessedColumn>& columns) {
  std::string text = table.file + ": " + std::to_string(table.rows()) + " rows, " +
                     std::to_string(table.columns.size()) + " columns, " +
                     (table.delimiter == '\t'  ? "tabs"
                      : table.delimiter == ' ' ? "blanks"
                                               : std::string("'") + table.delimiter + "'") +
                     " between cells" + (table.decimal_comma ? ", decimal comma" : "") +
                     (table.latin ? ", letters of Latin-1" : "") + ", " + std::to_string(table.header_lines) +
                     " lines of header\n";
  for (const GuessedColumn& guess : columns) {
    const TableColumn* column = guess.from.empty() ? nullptr : find_column(table, guess.from);
    text += "  " + guess.role + ": ";
    if (!column) {
      text += guess.reason + "\n";
      continue;
    }
    text += "'" + guess.from + "' in " + guess.unit + (guess.track.empty() ? "" : ", track " + guess.track) +
            " (" + guess.reason + "): ";
    for (std::size_t i = 0; i < std::min<std::size_t>(3, column->value.size()); ++i)
      text += number_text(column->value[i]) + " ";
    text += "... " + (column->value.empty() ? "" : number_text(column->value.back())) + "\n";
  }
  return text;
}

}  // namespace

ImportedTables import_tables(const std::vector<std::filesystem::path>& files,
                             const std::filesystem::path& relative_to) {
  EXPECT(!files.empty());
  ImportedTables result;
  const Table first = read_table(files.front());
  std::set<std::string> taken;
  result.columns.push_back(guess_time(first));
  taken.insert(result.columns[0].from);
  GuessedColumn com =
      guess_position(first, "grain_centre",
                     {{"x_com", "x_com_m", "com", "cm"},
                      {"com*", "grain*", "centre*", "center*", "schwerpunkt*", "mass centre*"}},
                     taken);
  result.columns.push_back(guess_position(
      first, "box_position",
      {{"x_box", "x_box_m", "box"}, {"box*", "carrier*"}, {"x", "position_x", "x_m", "x_mm"}, {"x*"}, {"y"}},
      taken));
  result.columns.push_back(std::move(com));
  guess_tracks(first, result.columns);
  if (result.columns[1].from.empty())
    result.open_questions.push_back("column.box_position.from: " + result.columns[1].reason);
  for (const GuessedColumn& guess : result.columns)
    if (guess.unit == "px" || guess.unit == "pixel")
      result.open_questions.push_back("camera.pixel_size: the length that one pixel shows");
    else if (!guess.unit.empty() && !unit_size(guess.unit, guess.role == "time", {1, 1, 0}))
      result.open_questions.push_back("column." + guess.role + ".unit: '" + guess.unit +
                                      "' is not known here");
  const bool needs_rate = result.columns[0].from.empty() || result.columns[0].unit.starts_with("frame");
  if (needs_rate) result.open_questions.push_back("camera.frame_rate: the frames a second");

  std::string& text = result.experiment;
  text = "# Written by shakedown import from the tables' own headers; check what is marked.\ntitle = " +
         toml_string(files.front().stem().string()) + "\n\n[camera]\n";
  text += needs_rate ? "frame_rate = \"? Hz\"\n" : "";
  text += std::any_of(
              result.columns.begin(), result.columns.end(),
              [](const GuessedColumn& g) { return g.unit.starts_with("px") || g.unit.starts_with("pixel"); })
              ? "pixel_size = \"? mm\"\n"
              : "";
  for (const GuessedColumn& guess : result.columns)
    if (!guess.from.empty()) text += column_text(guess);
  std::vector<Violation> violations;
  for (const std::filesystem::path& file : files) {
    const Table table = file == files.front() ? first : read_table(file);
    result.preview += preview_of(table, result.columns);
    for (const GuessedColumn& guess : result.columns)
      if (!guess.from.empty() && guess.role != "grain_centre" && !find_column(table, guess.from))
        violations.push_back({{table.file, 1, 1},
                              guess.role,
                              "has no column '" + guess.from + "' as " + first.file + " has",
                              "import tables of different layout one by one"});
    const GuessedLength length = length_in_name(file);
    text += "\n[[run]]\nfile = " +
            toml_string(
                std::filesystem::proximate(file, relative_to.empty() ? "." : relative_to).generic_string()) +
            "\nbox_length = \"" + (length.millimetres.empty() ? "?" : length.millimetres) + " mm\"" +
            (length.millimetres.empty() ? ""
             : length.certain           ? "  # from the file's name"
                                        : "  # one of the lengths in the file's name; PLEASE CHECK") +
            "\n";
    if (length.millimetres.empty())
      result.open_questions.push_back("run.box_length of " + file.filename().string());
    if (!result.columns[2].from.empty() && !find_column(table, result.columns[2].from))
      text += "column.grain_centre.from = \"\"  # not in this table\n";
  }
  if (!violations.empty()) throw InputError(std::move(violations));
  return result;
}

}  // namespace shakedown
