// SPDX-License-Identifier: MIT
#include "drop_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

#include "column_reading.hpp"
#include "drop_sequences.hpp"
#include "robust_statistics.hpp"
#include "table_layout.hpp"
#include "track_drops.hpp"

namespace shakedown {

namespace {

// Flights that a clock for people can tell, s.
constexpr double shortest = 0.015, longest = 8;

/// Returns the last decimal digit that any of the values has, e.g. 0.001; 0: more than nine digits.
double last_digit(const std::vector<double>& values) {
  for (int digits = 0; digits <= 9; ++digits) {
    const double unit = std::pow(10, digits);
    if (std::all_of(values.begin(), values.end(), [&](double value) {
          return !std::isfinite(value) || std::abs(value * unit - std::round(value * unit)) < 1e-6;
        }))
      return 1 / unit;
  }
  return 0;
}

std::vector<double> flights_of(const Layout& layout) {
  std::vector<double> flights;
  for (const Layout::Series& one : layout.series) {
    std::vector<double> x;
    for (const double t : one.times)
      if (std::isfinite(t)) x.push_back(t);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (layout.kind == TimesKind::intervals) flights.push_back(x[i]);
      if (layout.kind == TimesKind::instants && i > 0 && x[i] > x[i - 1]) flights.push_back(x[i] - x[i - 1]);
    }
  }
  return flights;
}

struct Seconds {
  double size = 1;
  std::string note;
};

/// Returns the size of the table's unit, s: as the user says, as the header says, or such that flights last
/// as they can.
Seconds seconds_of(const Table& table, const Layout& layout, const DropReading& reading) {
  if (reading.rate > 0) return {1 / reading.rate, fmt::format("counts of {} Hz", reading.rate)};
  const std::string unit = reading.unit.empty() ? layout.unit : reading.unit;
  if (!unit.empty()) {
    const std::optional<double> size = unit_size(unit, true, {});
    if (size) return {*size, ""};
    if (!reading.unit.empty())
      throw InputError({{{}, "--unit", "'" + unit + "' is no unit of time", "use s, ms or us, or --rate"}});
  }
  const double usual = median(flights_of(layout));
  for (const auto& [size, name] : {std::pair{1.0, "s"}, std::pair{1e-3, "ms"}, std::pair{1e-6, "us"}})
    if (usual * size > shortest && usual * size < longest)
      return {size, fmt::format("unit of the times: {} (a flight lasts {:.3g} of it)", name, usual)};
  throw InputError({{{table.file, 1, 1},
                     "",
                     fmt::format("has times in an unknown unit (a flight lasts {:.4g})", usual),
                     "say it: --unit ms, or --rate \"48 kHz\" where they are counts of a clock"}});
}

double metres(double height, const std::string& unit) {
  const std::optional<double> size = unit.empty() ? std::nullopt : unit_size(unit, false, {});
  if (size) return height * *size;
  return height * (height > 300 ? 1e-3
                   : height > 4 ? 1e-2
                                : 1);  // nobody drops balls from 4 m and measures it
}

std::string described(const Table& table, const Layout& layout, std::size_t drops) {
  return fmt::format("{}: {} of impacts, {}; {} drop{}", table.file,
                     layout.kind == TimesKind::intervals ? "intervals" : "instants", layout.how, drops,
                     drops == 1 ? "" : "s");
}

void note_falls(const std::vector<Drop>& drops, ReadDrops& read) {
  for (const Drop& drop : drops)
    if (std::isfinite(drop.fall))
      read.notes.push_back(fmt::format("{}{}{}: begins with a fall of {:.3f} s from rest, which is no flight",
                                       drop.file, drop.name.empty() ? "" : ", ", drop.name, drop.fall));
}

}  // namespace

Table parse_bounce_table(const std::string& text, const std::string& name) {
  Table table = parse_table(text, name);
  if (table.delimiter != ',' || table.columns.size() != 2 || table.columns[1].name != "column 2")
    return table;
  // "0,254" in each line and no number with a point: of a counter and whole milliseconds the first would
  // count.
  std::string points;
  std::istringstream lines(text);
  static const std::regex commas(R"re(\s*"?(\d+),(\d+)"?\s*)re");
  double last = not_said;
  int counts = 0, all = 0;
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    constexpr std::size_t longest_line = 100;  // a match takes memory for each character
    if (line.size() < longest_line && std::regex_match(line, found, commas)) {
      const double whole = std::stod(found[1]);
      counts += whole == last + 1;
      last = whole, ++all;
      line = found[1].str() + "." + found[2].str();
    }
    points += line + "\n";
  }
  return all < static_cast<int>(table.rows()) || 2 * counts > all ? table : parse_table(points, name);
}

Table read_bounce_table(const std::string& file) {
  Table table = read_table(file);
  if (table.delimiter != ',' || table.columns.size() != 2) return table;
  std::ifstream input(file, std::ios::binary);
  std::stringstream text;
  text << input.rdbuf();
  return parse_bounce_table(text.str(), file);
}

ReadDrops drops_of_table(const Table& table, const DropReading& reading) {
  if (!table.violations.empty()) throw InputError(table.violations);
  constexpr std::size_t most_columns = 300;  // each is compared with each
  if (table.columns.size() > most_columns)
    throw InputError({{{table.file, 1, 1},
                       "",
                       fmt::format("has {} columns ({} are the most)", table.columns.size(), most_columns),
                       "give the times of one drop in a column or a row, or several files"}});
  if (reading.as.empty() || reading.as == "track")
    if (const TrackColumns track = track_columns(table, reading); track.time)
      return drops_of_track(table, track, reading);
  if (reading.as == "track")
    throw InputError({{{table.file, 1, 1},
                       "--as",
                       "holds no track of a falling ball (a clock and a height that falls and rises)",
                       "name the two columns: --column TIME --column HEIGHT"}});
  const Layout layout = layout_of(table, reading);
  const Seconds seconds = seconds_of(table, layout, reading);
  ReadDrops read;
  for (const Layout::Series& one : layout.series) {
    std::vector<double> times = one.times;
    for (double& time : times) time *= seconds.size;
    std::vector<Drop> found = layout.kind == TimesKind::intervals
                                  ? drops_of_intervals(times, one.name, !one.name.empty())
                                  : drops_of_instants(times, one.name, !one.name.empty());
    for (Drop& drop : found) {
      drop.file = table.file;
      drop.stated_height = metres(one.height, one.height_unit);
      drop.height = reading.height;
      drop.resolution = last_digit(one.times) * seconds.size;
      read.drops.push_back(std::move(drop));
    }
  }
  read.notes.push_back(described(table, layout, read.drops.size()));
  if (!seconds.note.empty()) read.notes.push_back(seconds.note);
  note_falls(read.drops, read);
  return read;
}

}  // namespace shakedown
