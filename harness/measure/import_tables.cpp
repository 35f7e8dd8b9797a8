// SPDX-License-Identifier: MIT
#include "import_tables.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <optional>
#include <regex>
#include <set>

#include "column_guess.hpp"
#include "column_reading.hpp"
#include "robust_statistics.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

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
  if (guess.role != "time" && is_unit_of_angle(guess.unit)) text += "per_radian = \"? mm\"\n";
  if (guess.role != "time")
    text +=
        "# origin = \"0 " + (guess.unit == "px" || is_unit_of_angle(guess.unit) ? guess.unit : "mm") +
        "\"  # what the column reads where the spring is relaxed\n"
        "# uncertainty = \"0.2 mm\"  # standard deviation of one frame; found from the frames when it is not "
        "given\n";
  return text;
}

/// The column's numbers that belong to one track; all of them where there are no tracks.
std::vector<double> values_of_track(const Table& table, const TableColumn& column, const std::string& track) {
  const TableColumn* tracks = track.empty() ? nullptr : find_track_column(table);
  if (!tracks) return column.value;
  std::vector<double> values;
  for (std::size_t i = 0; i < column.value.size(); ++i)
    if (number_text(tracks->value[i]) == track) values.push_back(column.value[i]);
  return values;
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
    const std::vector<double> shown = values_of_track(table, *column, guess.track);
    for (std::size_t i = 0; i < std::min<std::size_t>(3, shown.size()); ++i)
      text += number_text(shown[i]) + " ";
    text += "... " + (shown.empty() ? "" : number_text(shown.back())) + "\n";
  }
  return text;
}

/// [[run]] of one table; `box` names its own column where several trials stand side by side.
std::string run_text(const Table& table, const std::filesystem::path& file, const ImportedTables& layout,
                     const std::string& box) {
  const GuessedLength length = length_in_name(file);
  std::string text = "\n[[run]]\nfile = " + toml_string(file.generic_string()) + "\nbox_length = \"" +
                     (length.millimetres.empty() ? "?" : length.millimetres) + " mm\"" +
                     (length.millimetres.empty() ? ""
                      : length.certain           ? "  # from the file's name"
                                       : "  # one of the lengths in the file's name; PLEASE CHECK") +
                     "\n";
  if (!box.empty()) text += "column.box_position.from = " + toml_string(box) + "\n";
  if (!layout.columns[2].from.empty() && !find_column(table, layout.columns[2].from))
    text += "column.grain_centre.from = \"\"  # not in this table\n";
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
  GuessedColumn com = guess_centre(first, taken);
  result.columns.push_back(guess_box(first, taken));
  result.columns.push_back(std::move(com));
  guess_tracks(first, result.columns);
  if (result.columns[1].from.empty())
    result.open_questions.push_back("column.box_position.from: " + result.columns[1].reason);
  for (const GuessedColumn& guess : result.columns)
    if (guess.role != "time" && is_unit_of_angle(guess.unit))
      result.open_questions.push_back(
          "column." + guess.role +
          ".per_radian: the length that one radian is (the distance from the pivot)");
    else if (guess.unit == "px" || guess.unit == "pixel")
      result.open_questions.push_back("camera.pixel_size: the length that one pixel shows");
    else if (!guess.unit.empty() && !unit_size(guess.unit, guess.role == "time", everything_given))
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
    const std::vector<std::string> trials = trials_beside(table, result.columns[1].from);
    for (const std::string& trial : trials)
      text += run_text(table, std::filesystem::proximate(file, relative_to.empty() ? "." : relative_to),
                       result, trials.size() > 1 ? trial : "");
    if (trials.size() > 1)
      result.preview += "  " + std::to_string(trials.size()) + " columns are named like '" +
                        result.columns[1].from + "': one run each\n";
    if (length_in_name(file).millimetres.empty())
      result.open_questions.push_back("run.box_length of " + file.filename().string() +
                                      " (delete the line for the setup's)");
  }
  if (!violations.empty()) throw InputError(std::move(violations));
  return result;
}

}  // namespace shakedown
