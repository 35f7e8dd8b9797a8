// SPDX-License-Identifier: MIT
// From the columns of a table to the series of a run.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "table.hpp"

namespace shakedown {

/// What the experiment file says about one column; SI.
struct ColumnChoice {
  std::string from;   ///< header; empty: not measured
  std::string unit;   ///< as written; empty: the table's header must say it
  SourcePlace place;  ///< where the experiment file says so
  double uncertainty = std::numeric_limits<double>::quiet_NaN();  ///< m, of one frame
  double origin = 0;                                              ///< m, subtracted after the conversion
  bool reversed = false;                                          ///< the axis points away from the release
  std::vector<std::string> tracks;  ///< of tables with one row a track and frame; several: their mean
  std::string track_from;           ///< header of the track numbers; empty: TRACK_ID, particle or track
};

/// How values of a column become metres or seconds.
struct ClockAndScale {
  double frame_rate = 0;    ///< Hz; 0: not said
  double pixel_size = 0;    ///< m; 0: not said
  double release_time = 0;  ///< s, on the table's clock
};

struct RunColumns {
  std::optional<ColumnChoice> time;  ///< absent: rows are frames
  ColumnChoice box;
  std::optional<ColumnChoice> com;
};

/// The series of a run: strictly increasing time, NaN where a position is missing.
struct RunSeries {
  std::vector<double> time, x_box, x_com;
  std::vector<Violation> violations;
  std::vector<std::string> notes;
};

RunSeries read_columns(const Table& table, const RunColumns& columns, const ClockAndScale& scale);

/// SI size of a unit of length (dimension 1) or time (dimension 2) as people and programs write it ("micron",
/// "sec", "px", "frame"); nothing when it is neither or cannot be converted.
std::optional<double> unit_size(const std::string& unit, bool is_time, const ClockAndScale& scale);

}  // namespace shakedown
