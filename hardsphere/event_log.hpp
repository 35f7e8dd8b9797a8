// SPDX-License-Identifier: MIT
// Events of a run, packed. An entry is two numbers of 7-bit groups, low ones first:
//   time: the number of units in its last place by which it lies after the time before, so that nothing is
//         lost; coded as zigzag, as rounding may set it back;
//   who:  grain + N * partner; partners from N on are walls and other kinds, see code_of().
// An entry takes about 8 bytes for 37 grains.
#pragma once
#include <cstdint>

#include "collision_log.hpp"
#include "end_walls.hpp"

namespace shakedown {

enum class EventKind : std::uint8_t {
  pair,        ///< partner: the other grain
  wall,        ///< partner: axis that the wall lies across; side: which end of it
  new_anchor,  ///< a grain's flight is described from here on (a prediction went stale, a neighbour list was
               ///< renewed)
  grain_kick,  ///< drag and formulas act on all grains
  next_piece   ///< the box goes on with another piece of its motion
};

struct LoggedEvent {
  double time = 0;  ///< s
  EventKind kind = EventKind::pair;
  int grain = 0, partner = 0, side = 1;
  Meeting meeting = Meeting::touch;
};

/// Returns the number of entries between two digests of the state, for this number of grains: so many that
/// digests cost little.
std::int64_t digest_interval(std::size_t grains);

class EventWriter {
 public:
  explicit EventWriter(State initial);
  /// Appends an event; returns true when a digest of the state is due.
  bool add(const LoggedEvent& event);
  void add_digest(std::uint64_t digest) { log_.digests.push_back(digest); }
  /// Returns the log until time t (s), at which the state has this digest.
  CollisionLog finished(double t, std::uint64_t digest) const;

 private:
  CollisionLog log_;
  std::int64_t interval_, due_;
  std::uint64_t last_bits_ = 0;
};

class EventReader {
 public:
  /// The log must outlive the reader.
  explicit EventReader(const CollisionLog& log) : log_(&log) {}
  bool done() const { return entry_ == log_->entries; }
  /// Reads the next event; throws FileError when the log is cut short or names what is not there.
  LoggedEvent next();
  std::int64_t entry() const { return entry_; }  ///< number of events read

 private:
  /// Reads a number of 7-bit groups. Throws FileError when the log is cut short.
  std::uint64_t number();
  const CollisionLog* log_;
  std::size_t at_ = 0;
  std::int64_t entry_ = 0;
  std::uint64_t last_bits_ = 0;
};

}  // namespace shakedown
