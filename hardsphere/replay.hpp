// SPDX-License-Identifier: MIT
// A run made again from its collision log, without searching for events: the engine's own code executes each
// impact where the log says that it happened. Every effect that the hard engine models is replayed, and every
// state is the engine's own, bit for bit.
#pragma once
#include <memory>
#include <optional>

#include "damper_state.hpp"
#include "event_log.hpp"

namespace shakedown {

class Replay {
 public:
  /// The log must outlive the replay. Throws InputError for a setup that does not belong to it.
  Replay(const Setup& setup, const CollisionLog& log);
  ~Replay();
  Replay(Replay&&) noexcept;

  /// Executes every event until time t (s) and no later than the log's end; t may not lie before time().
  /// Throws FileError when the replay does not meet the digests in the log: it was written by a build whose
  /// arithmetic differs, or for another setup.
  void advance_to(double t);
  /// Executes the next event and returns it; empty at the end of the log.
  std::optional<LoggedEvent> step();
  /// Time of the next event; infinity at the end of the log.
  double next_time() const;

  double time() const;  ///< s, up to which the events are executed
  State state() const;  ///< lab frame, at time()

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace shakedown
