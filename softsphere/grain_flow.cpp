// SPDX-License-Identifier: MIT
#include "grain_flow.hpp"

#include <cmath>
#include <numbers>

#include "sum_in_order.hpp"

namespace shakedown {

namespace {

/// The change of velocity during a step (m/s), and of position beyond v step (m).
struct Change {
  Vec3 velocity = Vec3::Zero();
  Vec3 position = Vec3::Zero();
  int effect = -1;
};

Change by_harmonic(const HarmonicVector& harmonic, double time, double step) {
  const double rate = 2 * std::numbers::pi * harmonic.frequency;
  const double phase = rate * time + harmonic.phase;
  if (rate * step < 1e-9) {
    const Vec3 acceleration = harmonic.amplitude * std::sin(phase);
    return {acceleration * step, acceleration * (step * step / 2), harmonic.effect};
  }
  const double sine = std::sin(phase), cosine = std::cos(phase), later = phase + rate * step;
  return {harmonic.amplitude * ((cosine - std::cos(later)) / rate),
          harmonic.amplitude * ((cosine * step - (std::sin(later) - sine) / rate) / rate), harmonic.effect};
}

/// Adds changes common to all grains and books the exact work of each of them: m change . (v + v') / 2.
void add_velocity(const std::vector<Change>& changes, Bodies& bodies, Accounts& accounts) {
  const Eigen::Index n = bodies.grains;
  Vec3 total = Vec3::Zero();
  for (const Change& change : changes) total += change.velocity;
  Vec3 mean_momentum;  // of before and after
  const double mass = sum_in_order(bodies.mass);
  for (int axis = 0; axis < 3; ++axis) {
    mean_momentum(axis) =
        sum_in_order(bodies.mass * bodies.velocity.col(axis).head(n)) + mass * total(axis) / 2;
    bodies.velocity.col(axis).head(n) += total(axis);
  }
  for (const Change& change : changes) accounts.add_work(change.effect, change.velocity.dot(mean_momentum));
  accounts.outer_impulse += mass * total.x();
}

/// Adds the share of the accelerations to grains that have already gone v step.
void accelerate_grains(const GrainForces& forces, double time, double step, Bodies& bodies,
                       Accounts& accounts) {
  const Eigen::Index n = bodies.grains;
  if (forces.constant.shares().empty() && forces.harmonics.empty()) return;
  std::vector<Change> changes;
  for (const auto& share : forces.constant.shares())
    changes.push_back({share.strength * step, share.strength * (step * step / 2), share.effect});
  for (const auto& harmonic : forces.harmonics) changes.push_back(by_harmonic(harmonic, time, step));
  for (const Change& change : changes)
    for (int axis = 0; axis < 3; ++axis) bodies.position.col(axis).head(n) += change.position(axis);
  add_velocity(changes, bodies, accounts);
}

}  // namespace

void advance_grains(const GrainForces& forces, double time, double step, Bodies& bodies, Accounts& accounts) {
  const Eigen::Index n = bodies.grains;
  for (int axis = 0; axis < 3; ++axis)
    bodies.position.col(axis).head(n) += step * bodies.velocity.col(axis).head(n);
  accelerate_grains(forces, time, step, bodies, accounts);
}

void follow_arc(const GrainForces& forces, double before, Bodies& bodies, Accounts& accounts) {
  const double change = -1.2 * (bodies.x_box() * bodies.v_box() - before) / forces.arc_length;
  if (change != 0) add_velocity({{Vec3(0, 0, change), Vec3::Zero(), forces.arc_effect}}, bodies, accounts);
}

}  // namespace shakedown
