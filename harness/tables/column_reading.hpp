// SPDX-License-Identifier: MIT
// Makes the series of a run from the columns of a table.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "table.hpp"

namespace shakedown {

/// What the experiment file says about one column; SI.
struct ColumnChoice {
  std::string from;   ///< header; empty: not measured
  std::string unit;   ///< as written; empty: the table's header must say it
  SourcePlace place;  ///< where the experiment file says so
  double uncertainty = std::numeric_limits<double>::quiet_NaN();  ///< m, of one frame
  std::optional<double> origin;  ///< m, subtracted after the conversion; nothing: not stated, 0
  double per_radian = 0;         ///< m, what one radian is; 0: not said
  bool reversed = false;         ///< the axis points away from the release
  int derivative = 0;  ///< 1: velocities (m/s, rad/s ...), 2: accelerations; positions are integrals
  std::vector<std::string> tracks;  ///< of tables with one row a track and frame; several: their mean
  std::string track_from;           ///< header of the track numbers; empty: TRACK_ID, particle or track
};

/// How values of a column become metres or seconds.
struct ClockAndScale {
  double frame_rate = 0;               ///< Hz; 0: not said
  double pixel_size = 0;               ///< m; 0: not said
  std::optional<double> release_time;  ///< s, on the table's clock; nothing: its zero, or its first frame
  double per_radian = 0;               ///< m; 0: not said
};

/// Everything that units can need, to ask whether a unit is known at all.
constexpr ClockAndScale everything_given{1, 1, std::nullopt, 1};

struct RunColumns {
  std::optional<ColumnChoice> time;  ///< absent: rows are frames
  ColumnChoice box;
  std::optional<ColumnChoice> com;
  std::optional<ColumnChoice> base;  ///< the far end of the spring, where it moves
};

/// The series of a run: strictly increasing time, NaN where a position is missing.
struct RunSeries {
  std::vector<double> time, x_box, x_com;
  std::vector<std::pair<double, double>> base;  ///< s, m; empty: it rests
  std::vector<Violation> violations;
  std::vector<std::string> notes;
};

/// Reads the columns of one run in SI; what is wrong with them stands in RunSeries::violations.
RunSeries read_columns(const Table& table, const RunColumns& columns, const ClockAndScale& scale);

/// Returns the SI size of a unit of time, or of length or angle, as people and programs write it ("micron",
/// "sec", "px", "frame", "deg"); nothing when it is none or cannot be converted.
std::optional<double> unit_size(const std::string& unit, bool is_time, const ClockAndScale& scale);

/// Returns the same for a velocity (`derivative` 1: "mm/s", "deg/s") or acceleration (2: "m/s^2", "rad/s2").
std::optional<double> rate_unit_size(const std::string& unit, int derivative, const ClockAndScale& scale);

/// Tells whether a unit is rad, deg or what else people write for them.
bool is_unit_of_angle(const std::string& unit);

}  // namespace shakedown
