// SPDX-License-Identifier: MIT
// Drag and formulas act on grains as small impulses at even intervals, centred, so that the error is of
// second order in the interval.
#pragma once
#include <string>
#include <vector>

#include "loop_accounts.hpp"
#include "loop_walls.hpp"

namespace shakedown {

template <class Scene>
class GrainKicks {
 public:
  GrainKicks(Scene& scene, LoopWalls<Scene>& walls, LoopAccounts<Scene>& accounts, const GrainForces& forces,
             double interval)
      : scene_(scene), walls_(walls), accounts_(accounts), forces_(forces) {
    if (forces_.drag.sum().none() && forces_.free.empty()) return;
    interval_ = interval;
    next_ = interval / 2;
  }

  double next() const { return next_; }  ///< s, time of the next kick; `never` where nothing kicks
  /// Kicks all grains at the scene's time, and the box by the reaction of the air, and predicts every event
  /// anew.
  void act();

 private:
  /// Impulses of one effect's drag on the box, N s: along the axis and across.
  struct Reaction {
    double on_box = 0, across = 0;
  };

  void drag(double mass, const Vec3& air, Vec3& velocity);
  void push(double mass, double x, Vec3& velocity);
  void kick_box(const BoxMotion::Point& box, double speed_across);
  double speed_left(double speed, double mass);

  Scene& scene_;
  LoopWalls<Scene>& walls_;
  LoopAccounts<Scene>& accounts_;
  const GrainForces forces_;
  double interval_ = never, next_ = never;
  std::vector<Reaction> reactions_;
  /// What the linear drag does over one interval, kept while grains have this mass, kg: the integral of the
  /// decaying speed over the speed at the start, s, and the fraction of the speed that is left.
  struct {
    double mass = 0, time_lost = 0, left = 1;
  } linear_;
};

template <class Scene>
void GrainKicks<Scene>::act() {
  next_ += interval_;
  accounts_.catch_up();
  const BoxMotion::Point box = scene_.box_now();
  const Vec3 frame_x = scene_.frame.displacement(scene_.now), frame_v = scene_.frame.velocity(scene_.now);
  const Vec3 air(box.v, 0, scene_.speed_across());  // goes with the box, also on its arc
  reactions_.assign(forces_.drag.shares().size(), {});
  for (int i = 0; i < scene_.grains.size(); ++i) {
    Flight3 flight = scene_.grains.flight(i);
    flight.advance(scene_.now);
    const double m = scene_.grains.mass(i);
    const Vec3 before = Vec3(flight.v[0], flight.v[1], flight.v[2]) + frame_v;
    Vec3 velocity = before;
    if (!reactions_.empty()) drag(m, air, velocity);
    if (!forces_.free.empty()) push(m, flight.x[0] + frame_x.x(), velocity);
    accounts_.grain_pushed(m * (velocity - before));
    for (std::size_t axis = 0; axis < 3; ++axis)
      flight.v[axis] = velocity[static_cast<int>(axis)] - frame_v[static_cast<int>(axis)];
    scene_.grains.set_flight(i, flight);
  }
  if (!reactions_.empty()) kick_box(box, air.z());
  if constexpr (requires { scene_.grains.predict_all_before(next_); })
    scene_.grains.predict_all_before(next_);
  else
    scene_.grains.predict_all();
  for (int i = 0; i < scene_.grains.size(); ++i) walls_.after(i, true);
  walls_.renew(0);
}

/// Changes the velocity (lab, m/s) of a grain by the drag of the air over one interval. Several effects share
/// the change as their forces do at the mean speed, which is of second order in the interval.
template <class Scene>
void GrainKicks<Scene>::drag(double mass, const Vec3& air, Vec3& velocity) {
  const Vec3 before = velocity, wind = velocity - air;
  const bool linear = forces_.drag.sum().quadratic == 0;
  const double speed = linear ? 0 : wind.norm(), left = speed_left(speed, mass);
  velocity = air + wind * left;
  if (reactions_.size() == 1) {
    reactions_[0].on_box -= mass * (velocity.x() - before.x());
    reactions_[0].across += mass * (velocity.z() - before.z());
    accounts_.loss_of(forces_.drag.shares()[0].effect) +=
        mass / 2 * (before.squaredNorm() - velocity.squaredNorm());
    return;
  }
  const double mean = speed * (1 + left) / 2, all = forces_.drag.sum().over_speed(mean);
  for (std::size_t k = 0; k < reactions_.size(); ++k) {
    const auto& share = forces_.drag.shares()[k];
    const double part = all > 0 ? share.strength.over_speed(mean) / all : 0;
    reactions_[k].on_box -= part * (mass * (velocity.x() - before.x()));
    reactions_[k].across += part * (mass * (velocity.z() - before.z()));
    accounts_.loss_of(share.effect) += part * (mass / 2 * (before.squaredNorm() - velocity.squaredNorm()));
  }
}

/// Changes the velocity (lab, m/s) of a grain at x (lab, m) by the user's formulas over one interval.
template <class Scene>
void GrainKicks<Scene>::push(double mass, double x, Vec3& velocity) {
  for (const FreeForce& force : forces_.free) {
    const double impulse = interval_ * force.newton(x, velocity.x(), scene_.now);
    if (!std::isfinite(impulse))
      throw PhysicsError(
          "the formula of user_force on a grain is not finite at t = " + std::to_string(scene_.now) + " s");
    accounts_.loss_of(force.effect) -= impulse * (velocity.x() + impulse / mass / 2);
    accounts_.pushed_from_outside(impulse);
    velocity.x() += impulse / mass;
    constexpr double fastest = 1e6;  // m/s, the bound of speeds in a setup
    if (!(std::abs(velocity.x()) <= fastest))
      throw PhysicsError("user_force drives a grain beyond 1e6 m/s at t = " + std::to_string(scene_.now) +
                         " s; check the units of its constants and the grains' mass");
  }
}

/// Gives the reaction of the air to the box and to what holds it on its arc.
template <class Scene>
void GrainKicks<Scene>::kick_box(const BoxMotion::Point& box, double speed_across) {
  double impulse = 0;
  for (const Reaction& reaction : reactions_) impulse += reaction.on_box;
  const double jump = impulse / scene_.box.mass();
  for (std::size_t k = 0; k < reactions_.size(); ++k) {
    double& loss = accounts_.loss_of(forces_.drag.shares()[k].effect);
    loss -= reactions_[k].on_box * (box.v + jump / 2);
    if (forces_.arc_effect < 0) continue;
    loss += reactions_[k].across * speed_across;
    accounts_.loss_of(forces_.arc_effect) -= reactions_[k].across * speed_across;
  }
  scene_.kick_box(jump);
}

/// Returns the fraction of a speed w that is left after one interval of the drag m w' = -c1 w - c2 w |w|, in
/// closed form.
template <class Scene>
double GrainKicks<Scene>::speed_left(double speed, double mass) {
  const AirDrag& drag = forces_.drag.sum();
  if (mass != linear_.mass) {
    const double rate = drag.linear / mass;
    linear_ = {mass, rate > 0 ? -std::expm1(-rate * interval_) / rate : interval_,
               std::exp(-rate * interval_)};
  }
  return linear_.left / (1 + drag.quadratic / mass * speed * linear_.time_lost);
}

}  // namespace shakedown
