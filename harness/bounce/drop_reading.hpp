// SPDX-License-Identifier: MIT
// A reader of drops is told what DropReading holds, and returns what ReadDrops holds.
#pragma once
#include <string>
#include <vector>

#include "drops.hpp"

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
  std::vector<double> time, level;      ///< s; dB of full scale, the peak of all channels
  std::vector<double> impacts, others;  ///< s: onsets that belong to the drop, and that do not
};

struct ReadDrops {
  std::vector<Drop> drops;
  std::vector<std::string> notes;  ///< how the file was read, what was left out
  std::vector<SoundShown> sounds;
};

}  // namespace shakedown
