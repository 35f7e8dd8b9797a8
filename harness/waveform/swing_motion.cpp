// SPDX-License-Identifier: MIT
#include "swing_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shakedown {

namespace {

struct SwingState {
  double t = 0, x = 0, v = 0;
};

class Swing {
 public:
  Swing(const Physics& physics, const SwingStart& start, double time)
      : physics_(physics),
        dahl_(physics.box.dahl),
        dry_(physics.box.dry_friction.sum()),
        now_{time, start.position, start.velocity} {
    if (turns()) set_off(now_.v);
  }

  const SwingState& now() const { return now_; }
  bool rests() const { return resting_; }
  double acceleration(const SwingState& s) const {
    return resting_ ? 0 : (driving(s) - direction_ * dry_) / physics_.box_mass;
  }

  /// Makes one step of h (s), or less where the box turns.
  void advance(double h) {
    if (resting_) {
      now_.t += h;
      if (!(std::abs(driving(now_)) <= dry_)) set_off(0);
      return;
    }
    const SwingState next = stepped(h);
    if (!turns() || next.v * direction_ >= 0) {
      now_ = next;
      return;
    }
    // Where the velocity is zero: regula falsi, which a parabola satisfies in a few steps.
    double low = 0, high = h, v_low = now_.v, v_high = next.v;
    SwingState turn = next;
    for (int i = 0; i < 4 && std::abs(turn.v) > 1e-12 * std::abs(v_high - v_low); ++i) {
      const double at = low + (high - low) * v_low / (v_low - v_high);
      turn = stepped(at);
      (turn.v * direction_ >= 0 ? low : high) = at;
      (turn.v * direction_ >= 0 ? v_low : v_high) = turn.v;
    }
    // A box that sets off and is back within a step has hardly moved: time must go on all the same.
    constexpr double hardly = 1e-6;
    now_ = turn.t > now_.t + hardly * h ? turn : next;
    now_.v = 0;
    set_off(0);
  }

 private:
  bool turns() const { return dry_ != 0 || dahl_.any(); }

  /// Returns all forces but the dry one, N.
  double driving(const SwingState& s) const {
    const double spring = -physics_.stiffness * s.x * (1 + physics_.spring_cubic * s.x * s.x);
    return physics_.box.newton(s.x, s.v, s.t, spring) + (dahl_.any() ? dahl_.newton(s.x) : 0);
  }

  void set_off(double velocity) {
    const double force = driving(now_);
    direction_ = velocity != 0 ? std::copysign(1.0, velocity) : std::copysign(1.0, force);
    resting_ = velocity == 0 && dry_ > 0 && std::abs(force) <= dry_;
    if (!resting_) dahl_.turn(now_.x, direction_);
  }

  SwingState stepped(double h) const {
    const auto at = [&](double part, double v, double a) {
      return SwingState{now_.t + part * h, now_.x + part * h * v, now_.v + part * h * a};
    };
    const double a1 = acceleration(now_);
    const SwingState s2 = at(0.5, now_.v, a1);
    const double a2 = acceleration(s2);
    const SwingState s3 = at(0.5, s2.v, a2);
    const double a3 = acceleration(s3);
    const SwingState s4 = at(1, s3.v, a3);
    const double a4 = acceleration(s4);
    return {now_.t + h, now_.x + h / 6 * (now_.v + 2 * s2.v + 2 * s3.v + s4.v),
            now_.v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)};
  }

  const Physics& physics_;
  DahlState dahl_;
  double dry_ = 0, direction_ = 0;
  bool resting_ = false;
  SwingState now_;
};

/// Returns the place on Hermite's cubic between two steps, m.
double between(const SwingState& a, const SwingState& b, double t) {
  const double h = b.t - a.t;
  if (!(h > 0)) return b.x;
  const double u = (t - a.t) / h, w = 1 - u;
  return w * w * (1 + 2 * u) * a.x + u * u * (3 - 2 * u) * b.x + h * u * w * (w * a.v - u * b.v);
}

}  // namespace

std::vector<double> swing_of(const Physics& physics, const SwingStart& start, const std::vector<double>& time,
                             double farthest) {
  std::vector<double> x;
  if (time.empty()) return x;
  x.reserve(time.size());
  const double step = 2 * std::numbers::pi * std::sqrt(physics.box_mass / physics.stiffness) / steps_a_period;
  Swing swing(physics, start, time.front());
  // Every turn ends a step early: a swing has two turns a period.
  const double expected = (time.back() - time.front()) / step;
  if (!(expected < 1e7)) return x;
  const auto most_steps = static_cast<std::size_t>(4 * expected) + 1000;
  for (std::size_t taken = 0; taken < most_steps; ++taken) {
    const SwingState before = swing.now();
    while (x.size() < time.size() && time[x.size()] <= before.t) x.push_back(before.x);
    if (x.size() == time.size()) return x;
    swing.advance(step);
    const SwingState& now = swing.now();
    if (!(std::abs(now.x) <= farthest) || !std::isfinite(now.v)) return {};
    while (x.size() < time.size() && time[x.size()] <= now.t)
      x.push_back(between(before, now, time[x.size()]));
  }
  return {};
}

}  // namespace shakedown
