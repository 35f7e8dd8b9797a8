// SPDX-License-Identifier: MIT
#include "column_reading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "integrated_motion.hpp"
#include "quantity.hpp"
#include "suggestion.hpp"

namespace shakedown {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_violations = 20;  // a wrong column would otherwise print ten thousand

/// Quotes a cell that is no number, as much of it as somebody reads.
std::string quoted(const std::string& text) {
  constexpr std::size_t most = 60;
  std::size_t end = std::min(text.size(), most);
  while (end < text.size() && end > 0 && (text[end] & 0xc0) == 0x80) --end;  // no half of a character
  return "'" + text.substr(0, end) + (end < text.size() ? "...'" : "'");
}

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

std::string wanted(const ColumnChoice& choice, bool is_time) {
  if (is_time) return "seconds";
  return choice.derivative == 0 ? "metres" : choice.derivative == 1 ? "metres a second" : "m/s^2";
}

std::string remedy_for_unit(const std::string& unit, const ColumnChoice& choice, bool is_time) {
  constexpr std::string_view per_radian = "say what length one radian is, e.g. per_radian = \"100 mm\"";
  if (choice.derivative > 0)
    return std::string(rate_unit_size(unit, choice.derivative, everything_given) ? per_radian
                       : choice.derivative == 1 ? "use m/s, mm/s, rad/s or deg/s"
                                                : "use m/s^2, mm/s^2, rad/s^2 or deg/s^2");
  if (!unit_size(unit, is_time, everything_given))
    return is_time ? "use s, ms or frame" : "use m, mm, um, px, rad or deg";
  return is_time                  ? "give camera.frame_rate"
         : is_unit_of_angle(unit) ? std::string(per_radian)
                                  : "give camera.pixel_size, the length that one pixel shows";
}

Source source_of(const Table& table, const ColumnChoice& choice, bool is_time, ClockAndScale scale,
                 std::vector<Violation>& violations) {
  scale.per_radian = choice.per_radian;
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
  const std::optional<double> size = choice.derivative > 0 ? rate_unit_size(unit, choice.derivative, scale)
                                                           : unit_size(unit, is_time, scale);
  if (size) {
    source.size = *size;
    return source;
  }
  violations.push_back({choice.place, "unit",
                        quoted(unit) + " cannot be turned into " + wanted(choice, is_time),
                        remedy_for_unit(unit, choice, is_time)});
  return source;
}

/// Reports cells that are no numbers, with one message for all alike and the line of the first.
void report_text(const Table& table, const TableColumn& column, std::vector<Violation>& violations) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> alike;  // text -> first row, number
  for (const TableColumn::TextCell& cell : column.not_numbers)
    ++alike.try_emplace(cell.text, cell.row, 0).first->second.second;
  for (const auto& [text, cells] : alike) {
    if (violations.size() >= most_violations) return;
    const std::string more =
        cells.second > 1 ? " (in " + std::to_string(cells.second) + " cells, here the first)" : "";
    violations.push_back({{table.file, table.line[cells.first], 1},
                          column.name,
                          quoted(text) + " is not a number" + more,
                          "correct it, or leave the cell empty where nothing was measured"});
  }
}

std::string seconds(double value) { return write_quantity(value, "s"); }

/// Reports where the clock does not run forwards, once for each way. `mixed`: what to do about rows that
/// nobody told apart by track; empty where there are none.
void check_clock(const Table& table, const std::vector<std::size_t>& rows, const std::vector<double>& time,
                 const std::string& column, const std::string& mixed, std::vector<Violation>& violations) {
  std::size_t first_twice = 0, first_back = 0, twice = 0, back = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (time[i] > time[i - 1]) continue;
    if (time[i] == time[i - 1] && twice++ == 0) first_twice = i;
    if (time[i] < time[i - 1] && back++ == 0) first_back = i;
  }
  const auto times = [](std::size_t count) {
    return count > 1 ? "; " + std::to_string(count) + " times in the table" : std::string();
  };
  const auto add = [&](std::size_t i, const std::string& problem, const char* remedy) {
    violations.push_back(
        {{table.file, table.line[rows[i]], 1}, column, problem, mixed.empty() ? remedy : mixed});
  };
  if (back > 0)
    add(first_back,
        "the clock runs backwards (" + seconds(time[first_back]) + " after " + seconds(time[first_back - 1]) +
            times(back) + ")",
        "sort the table by time, or separate the recordings");
  if (twice > 0 && (back == 0 || mixed.empty()))
    add(first_twice,
        "the time " + seconds(time[first_twice]) + " stands twice (also in line " +
            std::to_string(table.line[rows[first_twice - 1]]) + times(twice) + ")",
        "delete one of the two lines");
}

/// Returns the time of every row, s; NaN where the cell is not a number (reported).
std::vector<double> times_of(const Table& table, const RunColumns& columns, const ClockAndScale& scale,
                             std::vector<Violation>& violations) {
  std::vector<double> time(table.rows(), missing);
  if (!columns.time) {
    if (!(scale.frame_rate > 0))
      violations.push_back({columns.box.place, "column.time",
                            "is missing, and so is camera.frame_rate (no clock)", "give one of the two"});
    else
      for (std::size_t i = 0; i < time.size(); ++i)
        time[i] = static_cast<double>(i) / scale.frame_rate - scale.release_time.value_or(0);
    return time;
  }
  const Source source = source_of(table, *columns.time, true, scale, violations);
  if (!source.column) return time;
  report_text(table, *source.column, violations);
  std::vector<char> reported(table.rows(), 0);
  for (const TableColumn::TextCell& cell : source.column->not_numbers) reported[cell.row] = 1;
  std::size_t without = 0, first = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    time[i] = source.column->value[i] * source.size - scale.release_time.value_or(0);
    if (std::isnan(time[i]) && !reported[i] && without++ == 0) first = i;
  }
  if (without > 0)
    violations.push_back(
        {{table.file, table.line[first], 1},
         source.column->name,
         "the time is missing" + (without > 1 ? " (in " + std::to_string(without) + " lines)" : ""),
         "complete or delete the line"});
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

/// Returns what to do about rows of several tracks that are read as one; empty when the table has no such
/// rows.
std::string choose_a_track(const Table& table) {
  const TableColumn* column = find_track_column(table);
  if (!column) return "";
  const auto [low, high] = std::minmax_element(column->value.begin(), column->value.end());
  if (!(*low < *high)) return "";
  return "column " + quoted(column->name) + " tells tracks apart: say which one with track = \"" +
         write_quantity(*low, "") + "\" or another";
}

using Series = std::map<double, double>;  // s -> m

/// Returns position by time of one quantity.
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
    sum += sign * (source.column->value[i] * source.size - choice.origin.value_or(0));
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

/// Returns the usual spelling of a unit: "microns" -> "um".
std::string usual_spelling(const std::string& unit) {
  struct Spelling {
    const char* written;
    const char* unit;
  };
  static constexpr std::array<Spelling, 20> spellings{
      {{"degree", "deg"},  {"degrees", "deg"}, {"\xC2\xB0", "deg"}, {"Grad", "deg"},     {"radian", "rad"},
       {"radians", "rad"}, {"sec", "s"},       {"secs", "s"},       {"second", "s"},     {"seconds", "s"},
       {"msec", "ms"},     {"micron", "um"},   {"microns", "um"},   {"\xC2\xB5m", "um"}, {"\xCE\xBCm", "um"},
       {"pixel", "px"},    {"pixels", "px"},   {"frames", "frame"}, {"meter", "m"},      {"metre", "m"}}};
  for (const Spelling& spelling : spellings)
    if (unit == spelling.written) return spelling.unit;
  return unit;
}

bool is_angle(const std::string& name) { return name == "rad" || name == "mrad" || name == "deg"; }

}  // namespace

bool is_unit_of_angle(const std::string& unit) { return is_angle(usual_spelling(unit)); }

std::optional<double> rate_unit_size(const std::string& unit, int derivative, const ClockAndScale& scale) {
  constexpr std::array<std::array<std::string_view, 3>, 2> ends{
      {{"/s", "/sec", " s^-1"}, {"/s^2", "/s2", "/s\xC2\xB2"}}};
  for (const std::string_view end : ends[static_cast<std::size_t>(derivative - 1)])
    if (unit.ends_with(end)) return unit_size(unit.substr(0, unit.size() - end.size()), false, scale);
  return {};
}

std::optional<double> unit_size(const std::string& unit, bool is_time, const ClockAndScale& scale) {
  const std::string name = usual_spelling(unit);
  if (name == "px") return !is_time && scale.pixel_size > 0 ? std::optional(scale.pixel_size) : std::nullopt;
  if (name == "frame")
    return is_time && scale.frame_rate > 0 ? std::optional(1 / scale.frame_rate) : std::nullopt;
  const ValueOrReason<Unit> parsed = parse_unit(name);
  if (is_angle(name))
    return !is_time && scale.per_radian > 0 ? std::optional(std::get<Unit>(parsed).si * scale.per_radian)
                                            : std::nullopt;
  const Dimension wanted = is_time ? Dimension{0, 0, 1} : Dimension{1, 0, 0};
  if (!std::holds_alternative<Unit>(parsed) || std::get<Unit>(parsed).dimension != wanted)
    return std::nullopt;
  return std::get<Unit>(parsed).si;
}

namespace {

/// Counts time from the first frame, which is taken for the release without a stated one: numbers of frames
/// need not begin with 0 (ImageJ's begin with 1).
void count_from_first_frame(const Table& table, const RunColumns& columns, const ClockAndScale& scale,
                            std::vector<double>& time, std::vector<std::string>& notes) {
  const TableColumn* column = columns.time ? find_column(table, columns.time->from) : nullptr;
  if (!column || scale.release_time || !(scale.frame_rate > 0)) return;
  const std::string& unit = columns.time->unit.empty() ? column->unit : columns.time->unit;
  if (usual_spelling(unit) != "frame") return;
  double first = std::numeric_limits<double>::infinity();
  for (const double when : time) first = std::fmin(first, when);
  if (!std::isfinite(first) || first == 0) return;
  for (double& when : time) when -= first;
  notes.push_back(table.file + ": frames are counted from " +
                  write_number(std::round(first * scale.frame_rate)) +
                  ", the first of the table, which is taken for the release (else give release_time)");
}

}  // namespace

namespace {

/// Integrates velocities or accelerations to positions.
Series integrated(const Series& rates, const Table& table, const ColumnChoice& choice, RunSeries& run) {
  TimeSeries series;
  for (const auto& [when, rate] : rates) series.time.push_back(when), series.value.push_back(rate);
  for (int times = 0; times < choice.derivative && series.why_not.empty(); ++times)
    series = integral_of_swing(series);
  if (!series.why_not.empty())
    run.violations.push_back({{table.file, 0, 0}, choice.from, series.why_not, "give a longer recording"});
  Series places;
  for (std::size_t i = 0; i < series.time.size(); ++i) places[series.time[i]] = series.value[i];
  run.notes.push_back(table.file + ": positions are the " + (choice.derivative == 2 ? "double " : "") +
                      "integral of " + quoted(choice.from) +
                      " without what is slower than the swing; its noise walks, and their middle is unknown");
  return places;
}

}  // namespace

RunSeries read_columns(const Table& table, const RunColumns& columns, const ClockAndScale& scale) {
  RunSeries run;
  run.violations = table.violations;
  std::vector<double> time = times_of(table, columns, scale, run.violations);
  count_from_first_frame(table, columns, scale, time, run.notes);
  const std::string clock = columns.time ? columns.time->from : "";
  if (!run.violations.empty() && !any_number(time)) return run;
  Series box = series_of(table, columns.box, time, scale, clock, run.violations);
  if (columns.box.derivative > 0 && run.violations.empty()) box = integrated(box, table, columns.box, run);
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
  if (columns.base) {
    for (const auto& [when, place] : series_of(table, *columns.base, time, scale, clock, run.violations))
      if (std::isfinite(place)) run.base.emplace_back(when, place);
    if (run.violations.empty() && run.base.size() < 2)
      run.violations.push_back({{table.file, 0, 0},
                                columns.base->from,
                                "holds fewer than two numbers",
                                "choose another column, or leave column.base_position out"});
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
