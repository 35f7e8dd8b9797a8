// SPDX-License-Identifier: MIT
// Reads drops from a table: intervals between impacts or instants of impacts, in a column (with others that
// tell the drops apart), in columns side by side or in rows; or the track of a falling ball. What the table
// does not say in words is found from its numbers.
#pragma once
#include <string>
#include <vector>

#include "drop_reading.hpp"
#include "table.hpp"

namespace shakedown {

/// Finds the drops in a table: its track of a ball where it has one, else series of intervals or instants,
/// with times in s and heights in m. Notes say how it was read. Throws InputError where the table holds no
/// drop.
ReadDrops drops_of_table(const Table& table, const DropReading& reading);

/// Read a table as read_table() does; a single column with decimal commas is not taken for two columns of
/// whole numbers.
Table read_bounce_table(const std::string& file);
Table parse_bounce_table(const std::string& text, const std::string& name);

/// Reads drops from a file of any kind: sound (WAV, FLAC, OGG) by its first bytes, else a table. Throws
/// FileError, InputError.
ReadDrops read_drops(const std::string& file, const DropReading& reading);

/// Cuts intervals (s) of one column or row into drops: a new one begins where intervals grow and then fall
/// again as before; of a series that is `labelled` as one drop only where the first interval comes again. A
/// first interval that is no flight (a fall from rest, half a flight) is left out. `name` stands before a
/// number where there are several.
std::vector<Drop> drops_of_intervals(const std::vector<double>& interval, const std::string& name,
                                     bool labelled = false);
/// Does the same with instants (s); pauses between drops are left out.
std::vector<Drop> drops_of_instants(const std::vector<double>& instant, const std::string& name,
                                    bool labelled = false);

}  // namespace shakedown
