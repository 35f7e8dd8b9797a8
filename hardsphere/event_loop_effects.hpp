// SPDX-License-Identifier: MIT
// Part of event_loop.hpp: what acts between impacts.
#pragma once
#include "event_loop.hpp"

namespace shakedown {

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::go_on() {
  if constexpr (driven) {
    box_.go_on();
    box_time_ = -1;
    renew_walls(0);
  }
}

/// Drag and formulas on grains: small impulses, centred, so that the error is of second order in their
/// interval.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::kick_grains() {
  const double h = kick_every_;
  next_kick_ += h;
  account(now_);
  const BoxMotion::Point box = box_now();
  const Vec3 frame_x = frame_.displacement(now_), frame_v = frame_.velocity(now_);
  const Vec3 air(box.v, 0, walls_across(2).at(now_).v + frame_v.z());  // goes with the box, also on its arc
  double box_impulse = 0, across_impulse = 0;
  for (int i = 0; i < grains_.size(); ++i) {
    Flight3 flight = grains_.flight(i);
    flight.advance(now_);
    const double m = grains_.mass(i);
    Vec3 velocity = Vec3(flight.v[0], flight.v[1], flight.v[2]) + frame_v;
    const Vec3 before = velocity;
    if (forces_.drag_effect >= 0) {
      const Vec3 wind = velocity - air;
      velocity = air + wind * air_speed_left(wind.norm(), m, h);
      box_impulse -= m * (velocity.x() - before.x());
      across_impulse += m * (velocity.z() - before.z());
      ledger_.effect_loss[static_cast<std::size_t>(forces_.drag_effect)] +=
          m / 2 * (before.squaredNorm() - velocity.squaredNorm());
    }
    for (const FreeForce& force : forces_.free) {
      const double impulse = h * force.newton(flight.x[0] + frame_x.x(), velocity.x(), now_);
      if (!std::isfinite(impulse))
        throw PhysicsError(
            "the formula of user_force on a grain is not finite at t = " + std::to_string(now_) + " s");
      ledger_.effect_loss[static_cast<std::size_t>(force.effect)] -=
          impulse * (velocity.x() + impulse / m / 2);
      outer_impulse_ += impulse;
      velocity.x() += impulse / m;
    }
    grain_momentum_ += m * (velocity - before);
    for (std::size_t axis = 0; axis < 3; ++axis)
      flight.v[axis] = velocity[static_cast<int>(axis)] - frame_v[static_cast<int>(axis)];
    grains_.set_flight(i, flight);
  }
  if (forces_.drag_effect >= 0) {
    const double jump = box_impulse / box_.mass();
    double& loss = ledger_.effect_loss[static_cast<std::size_t>(forces_.drag_effect)];
    loss -= box_impulse * (box.v + jump / 2);
    if (forces_.arc_effect >= 0) {  // whatever holds the box on its arc drives the air across
      loss += across_impulse * air.z();
      ledger_.effect_loss[static_cast<std::size_t>(forces_.arc_effect)] -= across_impulse * air.z();
    }
    box_.restart(now_, box.x, box.v + jump);
    box_point_.v += jump;
  }
  grains_.predict_all();
  for (int i = 0; i < grains_.size(); ++i) after(i);
  renew_walls(0);
}

/// What is left of a speed w after time h of drag m w' = -c1 w - c2 w |w|, as a fraction (closed form).
template <class Grains, class Motion>
double EventLoop<Grains, Motion>::air_speed_left(double speed, double mass, double h) const {
  const double rate = forces_.linear_drag / mass, square = forces_.quadratic_drag / mass * speed;
  const double lost = rate > 0 ? -std::expm1(-rate * h) / rate : h;
  return std::exp(-rate * h) / (1 + square * lost);
}

/// Adds up what the outer forces did to the grains since the last call: their momentum in the falling frame
/// was constant.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::account(double t) {
  if constexpr (driven) {
    box_.account(t);
    if (!falling_ || t <= accounted_) return;
    constexpr std::array<double, 4> node{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                         0.8611363115940526};
    constexpr std::array<double, 4> weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                           0.3478548451374538};
    const double longest = std::min(1.0, 0.2 / std::max(frame_.top_frequency(), 1e-3));
    while (accounted_ < t) {
      const double h = std::min(longest, t - accounted_);
      for (std::size_t k = 0; k < node.size(); ++k) {
        const double time = accounted_ + h / 2 * (1 + node[k]);
        const Vec3 momentum = grain_momentum_ + grain_mass_ * frame_.velocity(time);
        frame_.each(time, [&](int effect, const Vec3& acceleration) {
          ledger_.effect_loss[static_cast<std::size_t>(effect)] -=
              h / 2 * weight[k] * acceleration.dot(momentum);
        });
      }
      accounted_ = h < t - accounted_ ? accounted_ + h : t;
    }
  }
}

}  // namespace shakedown
