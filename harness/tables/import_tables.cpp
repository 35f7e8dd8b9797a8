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
#include "value_reading.hpp"

namespace shakedown {

namespace {

struct GuessedLength {
  std::string millimetres;  ///< empty: the name does not say
  bool certain = true;      ///< no other number of millimetres stands in the name
};

/// Guesses the box's length from a file's name: "L040", "L=40.25mm", "65 mm_b". The letter counts for more,
/// for grains have millimetres too.
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

bool is_pixel(const std::string& unit) { return unit.starts_with("px") || unit.starts_with("pixel"); }

std::string column_text(const GuessedColumn& guess, const ImportOptions& options) {
  std::string text = "\n[column." + guess.role + "]  # " + guess.reason +
                     (guess.certain ? "" : "; PLEASE CHECK") + "\nfrom = " + toml_string(guess.from) +
                     "\nunit = " + toml_string(guess.unit) + "\n";
  if (!guess.track.empty()) text += "track = " + toml_string(guess.track) + "\n";
  if (guess.role != "time" && is_unit_of_angle(guess.unit)) text += "per_radian = \"? mm\"\n";
  if (guess.role != "time" && !options.origin.empty())
    text += "origin = " + toml_string(options.origin) + "\n";
  else if (guess.role != "time")
    text += "# origin = \"0 " + (guess.unit == "px" || is_unit_of_angle(guess.unit) ? guess.unit : "mm") +
            "\"  # what the column reads where the spring is relaxed\n";
  if (guess.role != "time")
    text +=
        "# uncertainty = \"0.2 mm\"  # standard deviation of one frame; found from the frames when it is not "
        "given\n";
  return text;
}

/// Returns the column's numbers that belong to one track; all of them where there are no tracks.
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

/// Returns the line of the box's length of this table: as given, as the file's name says, or left to be
/// filled in.
std::string length_line(const std::filesystem::path& file, const std::string& given, bool asked) {
  if (!given.empty()) return "box_length = " + toml_string(given) + "\n";
  const GuessedLength length = length_in_name(file);
  if (!length.millimetres.empty())
    return "box_length = \"" + length.millimetres + " mm\"" +
           (length.certain ? "  # from the file's name"
                           : "  # one of the lengths in the file's name; PLEASE CHECK") +
           "\n";
  return asked ? "box_length = \"? mm\"\n" : "# box_length = \"40 mm\"  # left out: the setup's\n";
}

/// Returns "a", "a, b, c", or with more "a, b, c and 4 more".
std::string title_of(const std::vector<std::filesystem::path>& files) {
  constexpr std::size_t named = 3;
  std::string title;
  for (std::size_t i = 0; i < std::min(named, files.size()); ++i)
    title += (i ? ", " : "") + files[i].stem().string();
  return files.size() > named ? title + " and " + std::to_string(files.size() - named) + " more" : title;
}

void check(const std::string& value, std::string_view unit, const char* option, const std::string& example,
           std::vector<Violation>& violations) {
  if (value.empty()) return;
  TomlValue text;
  text.kind = TomlValue::Kind::text;
  text.text = value;
  const ValueOrProblem<double> number = number_in(text, unit);
  if (const auto* problem = std::get_if<Problem>(&number))
    violations.push_back({{option, 0, 0}, "", problem->problem, "write it with its unit, e.g. " + example});
}

void check_options(const ImportOptions& options, std::size_t files) {
  std::vector<Violation> violations;
  check(options.frame_rate, "Hz", "--frame-rate", "\"240 Hz\"", violations);
  check(options.pixel_size, "mm", "--pixel", "\"0.25 mm\"", violations);
  for (const std::string& length : options.lengths) check(length, "mm", "--length", "\"40 mm\"", violations);
  if (options.lengths.size() > 1 && options.lengths.size() != files)
    violations.push_back({{"--length", 0, 0},
                          "",
                          "says " + std::to_string(options.lengths.size()) + " lengths of " +
                              std::to_string(files) + " tables",
                          "give one for all, or one for each in their order"});
  if (!violations.empty()) throw InputError(std::move(violations));
}

/// Returns the [[run]] of one table; `box` names its own column where several trials stand side by side.
std::string run_text(const Table& table, const std::filesystem::path& file, const ImportedTables& layout,
                     const std::string& box, const std::string& length) {
  std::string text = "\n[[run]]\nfile = " + toml_string(file.generic_string()) + "\n" + length;
  if (!box.empty()) text += "column.box_position.from = " + toml_string(box) + "\n";
  if (!layout.columns[2].from.empty() && !find_column(table, layout.columns[2].from))
    text += "column.grain_centre.from = \"\"  # not in this table\n";
  return text;
}

/// Guesses what each column of the first table is, and collects what the table does not say.
ImportedTables guessed_from(const Table& first) {
  ImportedTables result;
  std::set<std::string> taken;
  result.columns.push_back(guess_time(first));
  taken.insert(result.columns[0].from);
  GuessedColumn com = guess_centre(first, taken);
  result.columns.push_back(guess_box(first, taken));
  if (com.from.empty()) com = guess_other_track(first, result.columns[1].from, taken);
  result.columns.push_back(std::move(com));
  guess_tracks(first, result.columns);
  if (result.columns[1].from.empty())
    result.open_questions.push_back("column.box_position.from: " + result.columns[1].reason);
  for (const GuessedColumn& guess : result.columns)
    if (guess.role != "time" && is_unit_of_angle(guess.unit))
      result.open_questions.push_back(
          "column." + guess.role +
          ".per_radian: the length that one radian is (the distance from the pivot)");
    else if (!is_pixel(guess.unit) && !guess.unit.empty() &&
             !unit_size(guess.unit, guess.role == "time", everything_given))
      result.open_questions.push_back("column." + guess.role + ".unit: '" + guess.unit +
                                      "' is not known here");
  return result;
}

/// Adds title, camera and columns of the experiment file, and what the camera must still be asked for.
void add_layout(const std::string& title, const ImportOptions& options, ImportedTables& result) {
  const bool needs_rate = result.columns[0].from.empty() || result.columns[0].unit.starts_with("frame");
  const bool in_pixels = std::any_of(result.columns.begin(), result.columns.end(),
                                     [](const GuessedColumn& guess) { return is_pixel(guess.unit); });
  if (in_pixels && options.pixel_size.empty())
    result.open_questions.push_back("camera.pixel_size: the length that one pixel shows (--pixel)");
  if (needs_rate && options.frame_rate.empty())
    result.open_questions.push_back("camera.frame_rate: the frames a second (--frame-rate)");
  std::string& text = result.experiment;
  text = "# Written by shakedown import from the tables' own headers; check what is marked.\ntitle = " +
         toml_string(title) + "\n\n[camera]\n";
  if (needs_rate || !options.frame_rate.empty())
    text += "frame_rate = " + toml_string(options.frame_rate.empty() ? "? Hz" : options.frame_rate) + "\n";
  if (in_pixels || !options.pixel_size.empty())
    text += "pixel_size = " + toml_string(options.pixel_size.empty() ? "? mm" : options.pixel_size) + "\n";
  text +=
      "# sensor = \"encoder\"  # or camera, ranger, gyro, other: only a camera has a lens and a shutter\n";
  for (const GuessedColumn& guess : result.columns)
    if (!guess.from.empty()) text += column_text(guess, options);
}

/// Reports columns that the first table has and this one lacks.
void check_layout(const Table& table, const std::string& first, const std::vector<GuessedColumn>& columns,
                  std::vector<Violation>& violations) {
  for (const GuessedColumn& guess : columns)
    if (!guess.from.empty() && guess.role != "grain_centre" && !find_column(table, guess.from))
      violations.push_back({{table.file, 1, 1},
                            guess.role,
                            "has no column '" + guess.from + "' as " + first + " has",
                            "import tables of different layout one by one"});
}

/// Adds the runs of one table; `length`: its line, or nothing.
void add_runs(const Table& table, const std::filesystem::path& file, const std::string& length,
              ImportedTables& result) {
  const std::vector<std::string> trials = trials_beside(table, result.columns[1].from);
  for (const std::string& trial : trials)
    result.experiment += run_text(table, file, result, trials.size() > 1 ? trial : "", length);
  if (trials.size() > 1)
    result.preview += "  " + std::to_string(trials.size()) + " columns are named like '" +
                      result.columns[1].from + "': one run each\n";
}

}  // namespace

ImportedTables import_tables(const std::vector<std::filesystem::path>& files,
                             const std::filesystem::path& relative_to, const ImportOptions& options) {
  EXPECT(!files.empty());
  check_options(options, files.size());
  const Table first = read_table(files.front());
  ImportedTables result = guessed_from(first);
  add_layout(title_of(files), options, result);
  std::vector<Violation> violations;
  // A length that some tables say, or that grains need, is asked for; a box alone is the setup's.
  const bool asked = !result.columns[2].from.empty() ||
                     std::any_of(files.begin(), files.end(), [](const std::filesystem::path& file) {
                       return !length_in_name(file).millimetres.empty();
                     });
  for (std::size_t which = 0; which < files.size(); ++which) {
    const std::filesystem::path& file = files[which];
    const std::string given = options.lengths.empty()       ? ""
                              : options.lengths.size() == 1 ? options.lengths.front()
                                                            : options.lengths[which];
    const Table table = file == files.front() ? first : read_table(file);
    result.preview += preview_of(table, result.columns);
    check_layout(table, first.file, result.columns, violations);
    add_runs(table, std::filesystem::proximate(file, relative_to.empty() ? "." : relative_to),
             length_line(file, given, asked), result);
    if (given.empty() && asked && length_in_name(file).millimetres.empty())
      result.open_questions.push_back("run.box_length of " + file.filename().string() +
                                      " (--length; delete the line for the setup's)");
  }
  if (!violations.empty()) throw InputError(std::move(violations));
  return result;
}

}  // namespace shakedown
