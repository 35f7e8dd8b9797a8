// SPDX-License-Identifier: MIT
#include "column_reading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "quantity.hpp"
#include "suggestion.hpp"

namespace shakedown {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_violations = 20;  // a wrong column would otherwise print ten thousand

std::string quoted(const std::string& text) { return "'" + text + "'"; }

std::string remedy_for_column(const Table& table, const std::string& wanted) {
  std::vector<std::string_view> names;
  for (const TableColumn& column : table.columns) names.push_back(column.name);
  const std::string_view near = nearest(wanted, names);
  return (near.empty() ? "" : "did you mean '" + std::string(near) + "'? ") +
         "the columns are: " + listed(names);
}

/// A column, and how its numbers become SI.
struct Source {
  const TableColumn* column = nullptr;
  double size = 1;
};

Source source_of(const Table& table, const ColumnChoice& choice, bool is_time, const ClockAndScale& scale,
                 std::vector<Violation>& violations) {
  Source source;
  source.column = find_column(table, choice.from);
  if (!source.column) {
    violations.push_back({choice.place, "from",
                          "there is no column " + quoted(choice.from) + " in " + table.file,
                          remedy_for_column(table, choice.from)});
    return source;
  }
  const std::string unit = choice.unit.empty() ? source.column->unit : choice.unit;
  if (unit.empty()) {
    violations.push_back({choice.place, "unit",
                          "is missing (neither given here nor in the header of " + table.file + ")",
                          is_time ? "write unit = \"s\"" : "write unit = \"mm\""});
    return source;
  }
  const std::optional<double> size = unit_size(unit, is_time, scale);
  if (size) {
    source.size = *size;
    return source;
  }
  std::string remedy = is_time ? "use s, ms or frame" : "use m, mm, um or px";
  if (unit_size(unit, is_time, {1, 1, 0}))
    remedy = is_time ? "give camera.frame_rate" : "give camera.pixel_size, the length that one pixel shows";
  violations.push_back({choice.place, "unit",
                        quoted(unit) + " cannot be turned into " + (is_time ? "seconds" : "metres"), remedy});
  return source;
}

void report_text(const Table& table, const TableColumn& column, std::vector<Violation>& violations) {
  for (const TableColumn::TextCell& cell : column.not_numbers) {
    if (violations.size() >= most_violations) return;
    violations.push_back({{table.file, table.line[cell.row], 1},
                          column.name,
                          quoted(cell.text) + " is not a number",
                          "correct it, or leave the cell empty where nothing was measured"});
  }
}

std::string seconds(double value) { return write_quantity(value, "s"); }

/// The clock must run forwards; says where it does not. Rows that nobody told apart by track are `mixed`:
/// what to do about it, or nothing.
void check_clock(const Table& table, const std::vector<std::size_t>& rows, const std::vector<double>& time,
                 const std::string& column, const std::string& mixed, std::vector<Violation>& violations) {
  for (std::size_t i = 1; i < rows.size() && violations.size() < most_violations; ++i) {
    if (time[i] > time[i - 1]) continue;
    const SourcePlace place{table.file, table.line[rows[i]], 1};
    const bool twice = time[i] == time[i - 1];
    const std::string problem =
        twice ? "the time " + seconds(time[i]) + " stands twice (also in line " +
                    std::to_string(table.line[rows[i - 1]]) + ")"
              : "the clock runs backwards (" + seconds(time[i]) + " after " + seconds(time[i - 1]) + ")";
    const std::string remedy = !mixed.empty() ? mixed
                               : twice        ? "delete one of the two lines"
                                              : "sort the table by time, or separate the recordings";
    violations.push_back({place, column, problem, remedy});
    if (!mixed.empty()) return;  // the same of every frame
  }
}

/// SI time of every row; NaN where the cell is not a number (reported).
std::vector<double> times_of(const Table& table, const RunColumns& columns, const ClockAndScale& scale,
                             std::vector<Violation>& violations) {
  std::vector<double> time(table.rows(), missing);
  if (!columns.time) {
    if (!(scale.frame_rate > 0))
      violations.push_back({columns.box.place, "column.time",
                            "is missing, and so is camera.frame_rate (no clock)", "give one of the two"});
    else
      for (std::size_t i = 0; i < time.size(); ++i)
        time[i] = static_cast<double>(i) / scale.frame_rate - scale.release_time;
    return time;
  }
  const Source source = source_of(table, *columns.time, true, scale, violations);
  if (!source.column) return time;
  report_text(table, *source.column, violations);
  std::vector<char> reported(table.rows(), 0);
  for (const TableColumn::TextCell& cell : source.column->not_numbers) reported[cell.row] = 1;
  for (std::size_t i = 0; i < time.size(); ++i) {
    time[i] = source.column->value[i] * source.size - scale.release_time;
    if (std::isnan(time[i]) && !reported[i] && violations.size() < most_violations)
      violations.push_back({{table.file, table.line[i], 1},
                            source.column->name,
                            "the time is missing",
                            "complete or delete the line"});
  }
  return time;
}

const TableColumn* track_column(const Table& table, const ColumnChoice& choice,
                                std::vector<Violation>& violations) {
  if (!choice.track_from.empty()) {
    const TableColumn* column = find_column(table, choice.track_from);
    if (!column)
      violations.push_back({choice.place, "track_from",
                            "there is no column " + quoted(choice.track_from) + " in " + table.file,
                            remedy_for_column(table, choice.track_from)});
    return column;
  }
  if (const TableColumn* column = find_track_column(table)) return column;
  if (const TableColumn* column = find_column(table, "id")) return column;
  violations.push_back({choice.place, "track", "no column of " + table.file + " holds track numbers",
                        "say which with track_from"});
  return nullptr;
}

bool is_track(double number, const std::vector<std::string>& tracks) {
  return std::any_of(tracks.begin(), tracks.end(), [&](const std::string& track) {
    try {
      return std::stod(track) == number;
    } catch (const std::exception&) {
      return false;
    }
  });
}

/// What to do about rows of several tracks that are read as one; nothing when the table has no such rows.
std::string choose_a_track(const Table& table) {
  const TableColumn* column = find_track_column(table);
  if (!column) return "";
  const auto [low, high] = std::minmax_element(column->value.begin(), column->value.end());
  if (!(*low < *high)) return "";
  return "column " + quoted(column->name) + " tells tracks apart: say which one with track = \"" +
         write_quantity(*low, "") + "\" or another";
}

using Series = std::map<double, double>;  // s -> m

/// Position by time of one quantity.
Series series_of(const Table& table, const ColumnChoice& choice, const std::vector<double>& time,
                 const ClockAndScale& scale, const std::string& clock, std::vector<Violation>& violations) {
  const Source source = source_of(table, choice, false, scale, violations);
  if (!source.column) return {};
  report_text(table, *source.column, violations);
  const TableColumn* tracks = choice.tracks.empty() ? nullptr : track_column(table, choice, violations);
  if (!choice.tracks.empty() && !tracks) return {};
  const double sign = choice.reversed ? -1 : 1;
  std::map<double, std::pair<double, std::size_t>> sums;
  std::map<double, std::vector<std::size_t>> rows_of_track;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (std::isnan(time[i])) continue;
    if (tracks && !is_track(tracks->value[i], choice.tracks)) continue;
    rows_of_track[tracks ? tracks->value[i] : 0].push_back(i);
    auto& [sum, count] = sums[time[i]];
    sum += sign * (source.column->value[i] * source.size - choice.origin);
    ++count;
  }
  if (rows_of_track.size() < std::max<std::size_t>(1, choice.tracks.size()))
    violations.push_back({choice.place, "track", "not every one of these tracks is in " + table.file,
                          "look at the track numbers there"});
  const std::string mixed = tracks ? "" : choose_a_track(table);
  for (const auto& [track, rows] : rows_of_track) {
    std::vector<double> own;
    for (const std::size_t row : rows) own.push_back(time[row]);
    check_clock(table, rows, own, clock, mixed, violations);
  }
  Series series;
  // The mean of grains of which one is lost would jump: such a frame is missing.
  for (const auto& [when, sum] : sums)
    series[when] = sum.second == rows_of_track.size() ? sum.first / static_cast<double>(sum.second) : missing;
  return series;
}

bool any_number(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

std::optional<double> unit_size(const std::string& unit, bool is_time, const ClockAndScale& scale) {
  struct Spelling {
    const char* written;
    const char* unit;
  };
  static constexpr std::array<Spelling, 14> spellings{{{"sec", "s"},
                                                       {"secs", "s"},
                                                       {"second", "s"},
                                                       {"seconds", "s"},
                                                       {"msec", "ms"},
                                                       {"micron", "um"},
                                                       {"microns", "um"},
                                                       {"\xC2\xB5m", "um"},
                                                       {"\xCE\xBCm", "um"},
                                                       {"pixel", "px"},
                                                       {"pixels", "px"},
                                                       {"frames", "frame"},
                                                       {"meter", "m"},
                                                       {"metre", "m"}}};
  std::string name = unit;
  for (const Spelling& spelling : spellings)
    if (unit == spelling.written) name = spelling.unit;
  if (name == "px") return !is_time && scale.pixel_size > 0 ? std::optional(scale.pixel_size) : std::nullopt;
  if (name == "frame")
    return is_time && scale.frame_rate > 0 ? std::optional(1 / scale.frame_rate) : std::nullopt;
  const ValueOrReason<Unit> parsed = parse_unit(name);
  const Dimension wanted = is_time ? Dimension{0, 0, 1} : Dimension{1, 0, 0};
  if (!std::holds_alternative<Unit>(parsed) || std::get<Unit>(parsed).dimension != wanted)
    return std::nullopt;
  return std::get<Unit>(parsed).si;
}

RunSeries read_columns(const Table& table, const RunColumns& columns, const ClockAndScale& scale) {
  RunSeries run;
  run.violations = table.violations;
  const std::vector<double> time = times_of(table, columns, scale, run.violations);
  const std::string clock = columns.time ? columns.time->from : "";
  if (!run.violations.empty() && !any_number(time)) return run;
  const Series box = series_of(table, columns.box, time, scale, clock, run.violations);
  Series com;
  if (columns.com) {
    std::vector<Violation> of_com;
    com = series_of(table, *columns.com, time, scale, clock, of_com);
    const auto reported = [&](const Violation& violation) {  // without tracks both stand in the same rows
      return std::any_of(run.violations.begin(), run.violations.end(), [&](const Violation& other) {
        return other.key == violation.key && other.place.line == violation.place.line &&
               other.problem == violation.problem;
      });
    };
    std::erase_if(of_com, reported);
    run.violations.insert(run.violations.end(), of_com.begin(), of_com.end());
  }
  Series all = box;
  all.insert(com.begin(), com.end());
  for (const auto& [when, unused] : all) {
    const auto in_box = box.find(when);
    const Series::const_iterator in_com = com.find(when);
    run.time.push_back(when);
    run.x_box.push_back(in_box == box.end() ? missing : in_box->second);
    if (columns.com) run.x_com.push_back(in_com == com.end() ? missing : in_com->second);
  }
  if (run.violations.empty() && run.time.size() < 5)
    run.violations.push_back({{table.file, 0, 0},
                              "",
                              "holds " + std::to_string(run.time.size()) + " frames (too few for a motion)",
                              "give a longer recording"});
  if (run.violations.empty() && !any_number(run.x_box))
    run.violations.push_back(
        {{table.file, 0, 0}, columns.box.from, "holds no number", "choose another column"});
  if (columns.com && run.violations.empty() && !any_number(run.x_com)) {
    run.notes.push_back(table.file + ": column " + quoted(columns.com->from) +
                        " is empty: taken as not measured");
    run.x_com.clear();
  }
  return run;
}

}  // namespace shakedown
