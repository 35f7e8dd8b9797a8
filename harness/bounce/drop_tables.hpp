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

}  // namespace shakedown
