// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include "damper_state.hpp"

namespace shakedown {

/// What an event-driven run was, in the fewest bytes: where it began, and then which grains met and when.
/// With the setup that is all: the same impacts executed in the same order give the same motion, bit for bit,
/// without searching for a single event.
struct CollisionLog {
  State initial;
  double end_time = 0;                 ///< s, until when the log holds
  std::int64_t entries = 0;            ///< events of every kind
  std::int64_t impacts = 0;            ///< those of them that are collisions, of any class
  std::vector<std::uint8_t> events;    ///< packed (hardsphere/event_log.hpp)
  std::vector<std::uint64_t> digests;  ///< of the whole state, every digest_interval() entries and at the
                                       ///< end: a replay checks itself
};

}  // namespace shakedown
