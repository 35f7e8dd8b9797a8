// SPDX-License-Identifier: MIT
// The event-driven system itself, for those who want to steer it: benchmarks, checks against known physics,
// time reversal.
#pragma once
#include <atomic>
#include <memory>

#include "initial_state.hpp"
#include "trajectory.hpp"

namespace shakedown {

/// What a damper looks like at one moment, lab frame, SI.
struct Observation {
  double time, x_box, v_box, x_com, total_energy;
};

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

  double time() const;
  Observation observe();
  State state() const;
  Ledger ledger() const;
  /// Errors in Health's units; also updated by every observe().
  Health health() const;
  const std::array<std::int64_t, contact_classes>& collisions() const;
  std::int64_t events() const;
  double initial_energy() const;
  /// Sum over pair impacts of impulse times distance, N s m; pressure of a periodic fluid: Z - 1 = virial /
  /// (3 N k T time).
  double virial() const;
  /// Memory held per grain, bytes.
  double bytes_per_grain() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace shakedown
