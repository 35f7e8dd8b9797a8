// SPDX-License-Identifier: MIT
#include "column_guess.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <regex>

#include "column_reading.hpp"

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

double range_of_column(const TableColumn& column) {
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

/// Tells whether a name is "word", or whether a word in it begins as "word*" ("x_box", "posBox", not "index"
/// for "x*").
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

/// Returns the unit at the end of a name: "x_box_mm", "t/s".
std::string unit_in_name(const std::string& name, bool is_time) {
  static const std::regex ending(R"(.*[_/ .]([A-Za-z]+)$)");
  std::smatch found;
  if (!std::regex_match(name, found, ending)) return "";
  const std::string unit = found[1];
  return unit_size(unit, is_time, everything_given) ? unit : "";
}

const std::vector<std::string> angle_words{"angle*",  "winkel*", "theta*",  "phi*",   "alpha*",
                                           "\u03b8*", "\u03c6*", "\u03d5*", "\u03b1*"};

bool is_angle_name(const std::string& name) { return names_any(name, angle_words); }

/// Tells whether ImageJ made the table: it counts in pixels as long as nobody tells it a scale.
bool is_of_imagej(const Table& table) {
  return std::any_of(table.columns.begin(), table.columns.end(), [](const TableColumn& column) {
    return names_any(column.name, {"slice*", "pixel value*"});
  });
}

/// Guesses the unit, and whether the table says it.
void guess_unit(const Table& table, const TableColumn& column, bool is_time, GuessedColumn& guess) {
  if (!column.unit.empty() && !unit_size(column.unit, is_time, everything_given)) {
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
    guess.unit = contains_any(name, {"frame", "slice", "bild", "image"}) ? "frame"
                 : whole && range_of_column(column) > 200                ? "ms"
                                                                         : "s";
    if (guess.unit == "frame") guess.certain = true;
  } else {
    // A damper swings by some 0.2 m about zero; pixels are counted from a corner and never negative.
    const std::vector<double> numbers = numbers_of(column);
    const bool from_a_corner = !numbers.empty() && *std::min_element(numbers.begin(), numbers.end()) >= 0;
    constexpr double full_turn = 6.3;  // more than that an oscillating angle in radians cannot reach
    guess.unit = is_angle_name(column.name)    ? (range_of_column(column) > full_turn ? "deg" : "rad")
                 : is_of_imagej(table)         ? "px"
                 : range_of_column(column) < 1 ? "m"
                 : from_a_corner               ? "px"
                                               : "mm";
  }
  guess.reason +=
      std::string("; unit guessed from ") + (is_time ? "the name and the steps" : "the size of the numbers");
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

/// Returns the columns that may be positions: not velocities, not sizes, and not what stands still.
std::vector<const TableColumn*> possible_positions(const Table& table) {
  static const std::vector<std::string> others{"v",      "v_*",   "vx*",    "vy*",     "vel*",
                                               "speed*", "acc*",  "width*", "height*", "force*",
                                               "size*",  "area*", "energy*"};
  std::vector<const TableColumn*> columns;
  for (const TableColumn& column : table.columns) {
    const bool velocity = lower(column.name).ends_with("_v");
    const bool still = numbers_of(column).size() > 2 && !(range_of_column(column) > 0);
    if (!velocity && !still && !names_any(column.name, others)) columns.push_back(&column);
  }
  return columns;
}

std::vector<const TableColumn*> every_column(const Table& table) {
  std::vector<const TableColumn*> columns;
  for (const TableColumn& column : table.columns) columns.push_back(&column);
  return columns;
}

/// Returns the one of a track's x and y that moves more.
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
        found && !taken.contains(other) && range_of_column(*found) > 1.5 * range_of_column(*column))
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
  guess_unit(table, *column, false, guess);
  return guess;
}

}  // namespace

GuessedColumn guess_time(const Table& table) {
  GuessedColumn guess{"time", "", "", "", "by its name"};
  const TableColumn* column =
      best_column({{"t", "t_s", "time", "time_s", "position_t", "zeit", "temps", "seconds", "t_ms"},
                   {"time*", "zeit*", "t(s)*", "t [s]*"},
                   {"frame", "slice", "slice n", "bild", "frame*", "slice*", "bild*", "image*"}},
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
  guess_unit(table, *column, true, guess);
  return guess;
}

GuessedColumn guess_box(const Table& table, std::set<std::string>& taken) {
  std::vector<std::vector<std::string>> words{
      {"x_box", "x_box_m", "box"},
      {"box*", "carrier*"},
      {"x", "position_x", "x_m", "x_mm", "x(t)"},
      {"position*", "pos*", "weg*", "auslenkung*", "displacement*", "elongation*", "deflection*", "s(t)"}};
  words.push_back(angle_words);
  words.insert(words.end(), {{"x*"}, {"y"}});
  return guess_position(table, "box_position", words, taken);
}

GuessedColumn guess_centre(const Table& table, std::set<std::string>& taken) {
  return guess_position(table, "grain_centre",
                        {{"x_com", "x_com_m", "com", "cm"},
                         {"com*", "grain*", "centre*", "center*", "schwerpunkt*", "mass centre*"}},
                        taken);
}

GuessedColumn guess_other_track(const Table& table, const std::string& box, std::set<std::string>& taken) {
  GuessedColumn none{"grain_centre", "", "", "", "no column looks like it", false};
  const std::size_t dot = box.rfind('.');
  if (dot == std::string::npos || dot == 0) return none;
  for (const TableColumn* column : possible_positions(table)) {
    if (taken.contains(column->name) || !column->name.ends_with(box.substr(dot))) continue;
    GuessedColumn guess{"grain_centre", column->name, "", "", "another track of the table"};
    guess_unit(table, *column, false, guess);
    guess.certain = false;
    taken.insert(column->name);
    return guess;
  }
  return none;
}

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

std::vector<std::string> trials_beside(const Table& table, const std::string& column) {
  const auto without_number = [](const std::string& name) {
    std::string rest;
    for (const char letter : name)
      if (!std::isdigit(static_cast<unsigned char>(letter)) &&
          !std::ispunct(static_cast<unsigned char>(letter)))
        rest += letter;
    return rest;
  };
  std::vector<std::string> trials;
  const bool numbered = std::any_of(column.begin(), column.end(), [](char letter) {
    return std::isdigit(static_cast<unsigned char>(letter));
  });
  for (const TableColumn& other : table.columns)
    if (other.name == column || (numbered && without_number(other.name) == without_number(column)))
      trials.push_back(other.name);
  return trials;
}

}  // namespace shakedown
