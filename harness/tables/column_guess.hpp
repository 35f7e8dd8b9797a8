// SPDX-License-Identifier: MIT
// Guesses what a column of a table is, from its name and its numbers.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "table.hpp"

namespace shakedown {

/// What a column seems to be.
struct GuessedColumn {
  std::string role;     ///< "time", "box_position", "grain_centre"
  std::string from;     ///< header; empty: nothing suitable
  std::string unit;     ///< as it will stand in the experiment file
  std::string track;    ///< of tables with one row a track and frame
  std::string reason;   ///< why, in words
  bool certain = true;  ///< false: look at it
};

/// Guesses the column that holds the time, and its unit, by names and values.
GuessedColumn guess_time(const Table& table);

/// Guesses the box's position; `taken` are columns that are something else, and gets the one that is chosen.
GuessedColumn guess_box(const Table& table, std::set<std::string>& taken);

/// Guesses the grains' centre, likewise.
GuessedColumn guess_centre(const Table& table, std::set<std::string>& taken);

/// Guesses the grains' centre in tables with a track's name before each of its columns ("box.x", "balls.x"),
/// where no name tells the grains: the same coordinate of the next track.
GuessedColumn guess_other_track(const Table& table, const std::string& box, std::set<std::string>& taken);

/// Guesses tracks in tables with one row a track and frame: the first is the box, the second the grains,
/// until the user says otherwise. `columns` are time, box and centre.
void guess_tracks(const Table& table, std::vector<GuessedColumn>& columns);

/// Returns the columns named like this one but for a number ("1 Position", "2 Position" ...), itself among
/// them: trials side by side.
std::vector<std::string> trials_beside(const Table& table, const std::string& column);

}  // namespace shakedown
