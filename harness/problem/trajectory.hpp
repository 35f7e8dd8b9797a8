// SPDX-License-Identifier: MIT
// What an engine gives back: the sampled motion, where the energy went, and how well the engine kept its
// promises.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "collision_log.hpp"

namespace shakedown {

/// Energy by where it went, J, cumulative since release.
struct Ledger {
  std::array<double, contact_classes> contact_loss{};  ///< dissipated in contacts of each class
  std::vector<double> effect_loss;  ///< taken out by each line of Setup::effects (negative: put in)
  double total_loss() const;        ///< J, the sum of all entries
};

/// How well an engine kept its promises; every result carries it and every report shows it.
struct Health {
  double deepest_overlap = 0;  ///< m, positive when surfaces interpenetrate (soft engines: by design)
  /// max |energy + losses - E0| over E0, or over the most energy that was held, or that was lost or put in
  /// between two samples, where that is more
  double ledger_error = 0;
  /// max |momentum - outer impulse| over M Omega Delta0 (where Delta0 = 0: over the sum of m |v| at release),
  /// or over the most momentum that was held where that is more
  double momentum_error = 0;
  std::int64_t elastic_rescues = 0;  ///< impacts made elastic by the regularisation of inelastic collapse
  std::int64_t elastic_pair_rescues = 0;  ///< those of them between grains
  std::int64_t refused_events = 0;        ///< predicted events that turned out receding and were not executed
  std::vector<std::string> notes;         ///< what is not exact, in words
};

struct Trajectory {
  std::string engine;
  // One entry a sample, lab frame.
  std::vector<double> time;          ///< s since release
  std::vector<double> x_box;         ///< m
  std::vector<double> v_box;         ///< m/s
  std::vector<double> x_com;         ///< m, mass-weighted mean of the grains; NaN without grains
  std::vector<double> total_energy;  ///< J, spring + box + grains
  std::array<std::vector<double>, contact_classes> loss;  ///< J, cumulative, by class

  double initial_energy = 0;  ///< J, E0
  Ledger ledger;              ///< at the end
  std::array<std::int64_t, contact_classes> collisions{};
  std::int64_t events = 0;  ///< everything taken from the queue (hard), steps (soft)
  double wall_seconds = 0;  ///< time spent in the engine
  double end_time = 0;      ///< s; less than the duration when interrupted
  bool interrupted = false;
  State end_state;  ///< of box and grains where the engine stopped
  Health health;
  std::shared_ptr<const CollisionLog>
      collision_log;  ///< where it was asked for and the engine has collisions; else empty
};

}  // namespace shakedown
