// SPDX-License-Identifier: MIT
// Finds where in a table the times of impacts stand.
#pragma once
#include <string>
#include <vector>

#include "drop_reading.hpp"
#include "table.hpp"

namespace shakedown {

enum class TimesKind { intervals, instants };

/// A reading of a table: series of times, each with the words that tell it apart.
struct Layout {
  TimesKind kind = TimesKind::intervals;
  std::string how;  ///< in words
  struct Series {
    std::string name;
    std::vector<double> times;  ///< in the table's unit
    double height = not_said;   ///< as written
    std::string height_unit{};
  };
  std::vector<Series> series;
  std::string unit;  ///< of the header; empty: not said
  double score = 0;  ///< share of neighbours that are like flights of one drop, with the headers' word
};

/// Returns the likeliest layout; throws InputError where none has times of a bouncing ball.
Layout layout_of(const Table& table, const DropReading& reading);

/// Clock and height of the track of a ball: nullptr where the table is none.
struct TrackColumns {
  const TableColumn* time = nullptr;
  const TableColumn* height = nullptr;
};
/// Finds the two columns of a track, by the user's words or by names and numbers.
TrackColumns track_columns(const Table& table, const DropReading& reading);

/// Returns the unit at the end of a header without brackets ("interval_s", "t ms"); empty: none.
std::string unit_in_name(const std::string& header);

/// What a header speaks of, in several languages.
enum class Topic { interval, instant, height, index, error, other_quantity, none };
/// Returns the topic of a header; `none` where its words are not known.
Topic topic_of(const std::string& header);

}  // namespace shakedown
