// SPDX-License-Identifier: MIT
#include "motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace shakedown::apart {

namespace {

double sine(double frequency, double phase, double time) {
  return std::sin(2 * std::numbers::pi * frequency * time + phase);
}

}  // namespace

Motion::Motion(const Model& model, State state, double step, std::size_t effects)
    : model_(model),
      state_(std::move(state)),
      step_(step),
      encounters_(model, state_, step),
      effect_loss_(effects),
      turns_(std::any_of(model.friction.begin(), model.friction.end(), [](double mu) { return mu > 0; })) {
  if (state_.spin.empty()) state_.spin.assign(state_.size(), Vec3::Zero());
  force_.resize(state_.size());
  torque_.resize(state_.size());
  arc_before_ = state_.x_box * state_.v_box;
}

void Motion::advance(double time) {
  drift();
  std::fill(force_.begin(), force_.end(), Vec3::Zero());
  if (turns_) std::fill(torque_.begin(), torque_.end(), Vec3::Zero());
  box_force_ = 0;
  pushes_ = &encounters_.forces(state_);
  for (const Push& push : *pushes_) {
    const auto i = static_cast<std::size_t>(push.i);
    force_[i] += push.newton;
    if (push.j < 0)
      box_force_ -= push.newton.x();
    else
      force_[static_cast<std::size_t>(push.j)] -= push.newton;
    if (!turns_) continue;
    const Vec3 torque = push.newton.cross(push.normal);
    torque_[i] += push.arm_i * torque;
    if (push.j >= 0) torque_[static_cast<std::size_t>(push.j)] += push.arm_j * torque;
  }
  velocity_before_ = state_.velocity;
  spin_before_ = state_.spin;
  box_before_ = state_.v_box;
  kick_grains(time + step_ / 2);
  if (!model_.held) kick_box(time + step_ / 2);
  enter_contact_work();
  if (model_.arc_length > 0) follow_arc();
  drift();
}

void Motion::drift() {
  double fastest = 0;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    state_.position[i] += step_ / 2 * state_.velocity[i];
    fastest = std::max(fastest, state_.velocity[i].squaredNorm());
  }
  if (!model_.held) state_.x_box += step_ / 2 * state_.v_box;
  encounters_.moved(step_ / 2 * std::sqrt(fastest));
}

/// Kicks the grains. The air moves with the box, whose speed at the middle of the step is guessed from its
/// last change. The drag is taken at the mean of the speeds before and after.
void Motion::kick_grains(double time) {
  Vec3 field = Vec3::Zero();
  for (const Field& one : model_.fields)
    field += one.strength * (one.wave ? sine(one.frequency, one.phase, time) : 1.0);
  const bool air = model_.air_linear > 0 || model_.air_quadratic > 0;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const double m = state_.mass[i];
    Vec3 impulse = step_ * (force_[i] + m * field);
    Vec3& velocity = state_.velocity[i];
    if (air) {
      // The second pass takes the mean of the speeds before and after the kick.
      const Vec3 wind = velocity - Vec3(state_.v_box + box_change_ / 2, 0, 0);
      Vec3 dragged = Vec3::Zero(), between = wind + impulse / (2 * m);
      for (int pass = 0; pass < 2; ++pass) {
        const double rate = (model_.air_linear + model_.air_quadratic * between.norm()) * step_ / (2 * m);
        dragged = -2 * rate * m * (wind + impulse / (2 * m)) / (1 + rate);
        between = wind + (impulse + dragged) / (2 * m);
      }
      impulse += dragged;
      box_force_ -= dragged.x() / step_;
      // This is what it takes from grain and box.
      effect_loss_[static_cast<std::size_t>(model_.air_effect)] -= dragged.dot(between);
    }
    const Vec3 mean = velocity + impulse / (2 * m);
    for (const Field& one : model_.fields)
      effect_loss_[static_cast<std::size_t>(one.effect)] -=
          step_ * m * mean.dot(one.strength) * (one.wave ? sine(one.frequency, one.phase, time) : 1.0);
    velocity += impulse / m;
    if (turns_) state_.spin[i] += step_ * torque_[i] / (0.4 * m * state_.radius[i] * state_.radius[i]);
  }
}

double Motion::push_of(const BoxPush& push, double time) const {
  const double x = state_.x_box;
  switch (push.kind) {
    case BoxPush::Kind::steady: return push.strength;
    case BoxPush::Kind::wave:
      return push.strength * sine(push.frequency, push.phase, time) * std::exp(-push.rate * time);
    case BoxPush::Kind::pendulum: return push.strength * (x - push.length * std::sin(x / push.length));
    case BoxPush::Kind::lopsided: return -push.strength * x * x;
    case BoxPush::Kind::viscous:
    case BoxPush::Kind::quadratic:
    case BoxPush::Kind::dry: break;
  }
  return 0;
}

/// Returns the force that drags at this speed (m/s) over the speed, N s/m.
double Motion::drag_at(double speed) const {
  double drag = 0;
  for (const BoxPush& push : model_.pushes) {
    if (push.kind == BoxPush::Kind::viscous) drag += push.strength;
    if (push.kind == BoxPush::Kind::quadratic) drag += push.strength * std::abs(speed);
  }
  return drag;
}

void Motion::kick_box(double time) {
  const double mass = model_.box_mass, x = state_.x_box, before = state_.v_box;
  double force = box_force_ - model_.stiffness * x * (1 + model_.cubic * x * x), rub = 0;
  for (const BoxPush& push : model_.pushes) {
    force += push_of(push, time);
    if (push.kind == BoxPush::Kind::dry) rub += push.strength;
  }
  double free = before + step_ * force / mass, between = 0;
  for (int pass = 0; pass < 2; ++pass) {  // the second time with the mean speed
    between = (before + free) / 2;
    const double part = drag_at(between) * step_ / (2 * mass);
    free = (before * (1 - part) + step_ * force / mass) / (1 + part);
  }
  const double stop = std::min(std::abs(free), step_ * rub / mass);
  state_.v_box = free - std::copysign(stop, free);
  box_change_ = state_.v_box - before;
  const double way = step_ * (before + state_.v_box) / 2, dragged = (before + free) / 2;
  for (const BoxPush& push : model_.pushes) {
    double newton = push_of(push, time);
    if (push.kind == BoxPush::Kind::viscous) newton = -push.strength * dragged;
    if (push.kind == BoxPush::Kind::quadratic) newton = -push.strength * std::abs(between) * dragged;
    if (push.kind == BoxPush::Kind::dry && rub > 0)
      newton = -std::copysign(stop, free) * mass / step_ * push.strength / rub;
    effect_loss_[static_cast<std::size_t>(push.effect)] -= newton * way;
  }
}

/// Gives the grains the transverse velocity that they pick up as seen from the box, -6/5 (x v) / l: it goes
/// across as 3/5 x^2 / l.
void Motion::follow_arc() {
  const double now = state_.x_box * state_.v_box, change = -1.2 * (now - arc_before_) / model_.arc_length;
  arc_before_ = now;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    effect_loss_[static_cast<std::size_t>(model_.arc_effect)] -=
        state_.mass[i] * change * (state_.velocity[i].z() + change / 2);
    state_.velocity[i].z() += change;
  }
}

/// Books the work of the contacts: force times the mean of the velocities before and after, exact for a kick.
void Motion::enter_contact_work() {
  for (const Push& push : *pushes_) {
    const auto i = static_cast<std::size_t>(push.i), j = static_cast<std::size_t>(std::max(push.j, 0));
    const bool wall = push.j < 0;
    Vec3 twice = velocity_before_[i] + state_.velocity[i];
    twice -= wall ? Vec3(box_before_ + state_.v_box, 0, 0) : Vec3(velocity_before_[j] + state_.velocity[j]);
    double power = push.newton.dot(twice) / 2;
    if (turns_) {
      const Vec3 torque = push.newton.cross(push.normal);
      power += push.arm_i * torque.dot(spin_before_[i] + state_.spin[i]) / 2;
      if (!wall) power += push.arm_j * torque.dot(spin_before_[j] + state_.spin[j]) / 2;
    }
    contact_work_[static_cast<std::size_t>(push.kind)] += step_ * power;
  }
}

std::array<double, contact_classes> Motion::contact_loss() const {
  std::array<double, contact_classes> loss{};
  for (std::size_t kind = 0; kind < loss.size(); ++kind)
    loss[kind] = -contact_work_[kind] - encounters_.stored()[kind];
  return loss;
}

double Motion::energy() const {
  double energy = 0;
  for (const double held : encounters_.stored()) energy += held;
  if (!model_.held) {
    const double x = state_.x_box;
    energy += model_.box_mass * state_.v_box * state_.v_box / 2 +
              model_.stiffness * x * x * (0.5 + 0.25 * model_.cubic * x * x);
  }
  for (std::size_t i = 0; i < state_.size(); ++i)
    energy += state_.mass[i] * (state_.velocity[i].squaredNorm() / 2 +
                                0.2 * state_.radius[i] * state_.radius[i] * state_.spin[i].squaredNorm());
  return energy;
}

}  // namespace shakedown::apart
