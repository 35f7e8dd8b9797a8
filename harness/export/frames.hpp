// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <functional>
#include <limits>

#include "collision_log_file.hpp"

namespace shakedown {

/// Which moments of a run are wanted.
struct FrameTimes {
  double from = 0;                                      ///< s
  double to = std::numeric_limits<double>::infinity();  ///< s; later than the run's end: its end
  double rate = usual_frame_rate;                       ///< Hz
  const std::atomic<bool>* stop = nullptr;              ///< set to true: no more frames, Interrupted

  /// Number of frames that this log has, and the time of frame k, s.
  std::int64_t count(const CollisionLog& log) const;
  double time(std::int64_t k) const { return from + static_cast<double>(k) / rate; }
};

/// Box and grains at one moment, lab frame, SI.
struct Frame {
  std::int64_t number = 0;  ///< from 0
  double time = 0;          ///< s
  State state;
  Vec3 box_low, box_high;  ///< m, corners of the inner box
};

/// Calls use(frame) for each moment in order, rebuilt from the log without searching for an event. Throws
/// InputError for times outside the run and for more than 5e7 positions of grains, FileError where the log
/// does not fit this build.
void for_each_frame(const StoredRun& run, const FrameTimes& times,
                    const std::function<void(const Frame&)>& use);

}  // namespace shakedown
