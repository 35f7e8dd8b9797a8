// SPDX-License-Identifier: MIT
// Holds what was recorded of balls that were dropped and went on bouncing.
#pragma once
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace shakedown {

constexpr double not_said = std::numeric_limits<double>::quiet_NaN();

/// One ball let go once. Interval i is the flight between impact i and i + 1 of the recording.
struct Drop {
  std::string file, name;        ///< name: "throw 3", empty where the file has one drop
  std::vector<double> interval;  ///< s
  /// Number of the impact that begins each interval, from 1: numbers are those of the recording, also where
  /// intervals were joined or left out.
  std::vector<int> impact;
  double height = not_said;         ///< m, from which it fell onto the first impact of the recording
  double stated_height = not_said;  ///< m, as a column of the table says; shown, used only when asked for
  double fall = not_said;           ///< s, from rest onto the first impact, where the times begin with it
  double resolution = 0;            ///< s, last digit or sample of the times; 0: not known
};

/// Why an impact or an instant is not used.
enum class OutlierKind { missed, extra, impact, instant };

struct Outlier {
  std::size_t drop = 0;
  int impact = 0;  ///< as numbered in the recording, from 1
  OutlierKind kind = OutlierKind::impact;
  double value = 0;     ///< impact: its restitution; else the interval, s
  double expected = 0;  ///< of `value`
  double sigmas = 0;    ///< 0: gross, before any fit
  std::string reason;   ///< a sentence without its end
};

/// Consecutive intervals of a drop whose impacts are all good.
struct Flights {
  std::size_t drop = 0;
  std::vector<double> interval;
  std::vector<int> impact;   ///< that begins each interval
  double height = not_said;  ///< m, of the fall onto impact[0]
};

/// Cuts the drops where something is wrong: an impact that is no law's, an instant that is no impact's.
std::vector<Flights> usable_flights(const std::vector<Drop>& drops, const std::vector<Outlier>& outliers);

/// Finds impacts that were missed (one interval as long as two) and instants too many (one interval in two
/// parts), by the drop's neighbours and the file's usual ratio of intervals: no law and no noise is needed.
std::vector<Outlier> gross_outliers(const std::vector<Drop>& drops);

}  // namespace shakedown
