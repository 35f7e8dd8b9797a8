// SPDX-License-Identifier: MIT
// Drops from a table: intervals between impacts or instants of impacts, in a column (with others that tell
// the drops apart), in columns side by side or in rows; or the track of a falling ball. What the table does
// not say in words is found from its numbers.
#pragma once
#include <string>
#include <vector>

#include "drops.hpp"
#include "table.hpp"

namespace shakedown {

/// What the user says of the files; empty: found.
struct DropReading {
  std::string as;                    ///< "intervals", "instants", "track" or "sound"
  std::vector<std::string> columns;  ///< headers of the columns with the times; of a track clock and height
  std::string unit;                  ///< of the times, e.g. "ms"
  double rate = 0;                   ///< Hz; > 0: the times are counts of a clock of this rate
  double gravity = 9.81;             ///< m/s^2
  double height = not_said;          ///< m, of the fall onto the first impact, for all drops
};

/// The sound of a drop, to be shown.
struct SoundShown {
  std::string file;
  std::vector<double> time, level;      ///< s; dB over the noise
  std::vector<double> impacts, others;  ///< s: onsets that belong to the drop, and that do not
};

struct ReadDrops {
  std::vector<Drop> drops;
  std::vector<std::string> notes;  ///< how the file was read, what was left out
  std::vector<SoundShown> sounds;
};

/// Throws InputError where the table holds no drop.
ReadDrops drops_of_table(const Table& table, const DropReading& reading);

/// As read_table(); a single column with decimal commas is not taken for two columns of whole numbers.
Table read_bounce_table(const std::string& file);
Table parse_bounce_table(const std::string& text, const std::string& name);

/// From a file of any kind: sound (WAV, FLAC, OGG) by its first bytes, else a table. Throws FileError,
/// InputError.
ReadDrops read_drops(const std::string& file, const DropReading& reading);

/// Intervals of one column or row as drops: a new one begins where intervals grow and then fall again as
/// before; of a series that is `labelled` as one drop only where the first interval comes again. A first
/// interval that is no flight (a fall from rest, half a flight) is left out. `name` stands before a number
/// where there are several.
std::vector<Drop> drops_of_intervals(const std::vector<double>& interval, const std::string& name,
                                     bool labelled = false);
/// The same of instants; pauses between drops are left out.
std::vector<Drop> drops_of_instants(const std::vector<double>& instant, const std::string& name,
                                    bool labelled = false);

}  // namespace shakedown
