// SPDX-License-Identifier: MIT
// The event-driven system itself, for those who want to steer it: benchmarks, checks against known physics,
// time reversal.
#pragma once
#include <atomic>
#include <memory>

#include "damper_state.hpp"
#include "observation.hpp"
#include "trajectory.hpp"

namespace shakedown {

class HardSphereSystem {
 public:
  /// The setup's own initial state of run `run`.
  explicit HardSphereSystem(const Setup& setup, int run = 0);
  /// Any initial state in the setup's domain. Throws PhysicsError when grains overlap by more than 1e-12 m.
  HardSphereSystem(const Setup& setup, const State& state);
  ~HardSphereSystem();
  HardSphereSystem(HardSphereSystem&&) noexcept;

  /// Executes every event before time t (s); returns false when `stop` was set.
  bool advance_to(double t, const std::atomic<bool>* stop = nullptr);
  /// Executes n more impacts of any class.
  void advance_impacts(std::int64_t n);

  /// Writes down every event; to be called before the first, with the state that this was made from. Not for
  /// periodic cells.
  void log_collisions(State initial);
  /// The log that was written so far.
  CollisionLog collision_log() const;

  double time() const;  ///< s
  /// Returns the motion at time(), and enters how far energy and momentum are off balance into health().
  Observation observe();
  State state() const;  ///< at time(), lab frame, SI
  /// Returns the energy that contacts and effects have taken since release, J.
  Ledger ledger() const;
  /// Returns how well the promises were kept so far; the balances are those that observe() has seen.
  Health health() const;
  /// Returns the number of impacts by ContactClass.
  const std::array<std::int64_t, contact_classes>& collisions() const;
  /// Returns the number of steps so far: impacts, and everything else that the event loop has dealt with.
  std::int64_t events() const;
  double initial_energy() const;  ///< J
  /// Returns the sum over pair impacts of impulse times distance, N s m. It gives the pressure of a periodic
  /// fluid: Z - 1 = virial / (3 N k T time).
  double virial() const;
  /// Returns the memory held per grain, bytes.
  double bytes_per_grain() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace shakedown
