// SPDX-License-Identifier: MIT
// What a column of a table seems to be, from its name and its numbers.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "import_tables.hpp"

namespace shakedown {

/// The column that holds the time, and its unit, by names and values.
GuessedColumn guess_time(const Table& table);

/// The box's position; `taken` are columns that are something else, and gets the one that is chosen.
GuessedColumn guess_box(const Table& table, std::set<std::string>& taken);

/// The grains' centre, likewise.
GuessedColumn guess_centre(const Table& table, std::set<std::string>& taken);

/// Of tables with a track's name before each of its columns ("box.x", "balls.x"): the same coordinate of the
/// next track, where no name tells the grains.
GuessedColumn guess_other_track(const Table& table, const std::string& box, std::set<std::string>& taken);

/// Tables with one row a track and frame: the first track is the box, the second the grains, until the user
/// says otherwise. `columns` are time, box and centre.
void guess_tracks(const Table& table, std::vector<GuessedColumn>& columns);

/// Columns named like this one but for a number ("1 Position", "2 Position" ...), itself among them: trials
/// side by side.
std::vector<std::string> trials_beside(const Table& table, const std::string& column);

}  // namespace shakedown
