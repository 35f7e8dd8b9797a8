// SPDX-License-Identifier: MIT
#include "box_flow.hpp"

#include <algorithm>
#include <cmath>

namespace shakedown {

BoxFlow::BoxFlow(const Physics& physics)
    : mass_(physics.box_mass),
      stiffness_(physics.stiffness),
      cubic_(physics.spring_cubic),
      forces_(physics.box),
      dahl_(physics.box.dahl) {
  plain_ = cubic_ == 0 && forces_.none();
  // In the order of BoxForces::each(), then the frictions.
  const auto book = [this](const auto& forces) {
    for (const auto& force : forces) works_.push_back({0, force.effect});
  };
  book(forces_.viscous.shares());
  book(forces_.constant.shares());
  book(forces_.harmonics);
  book(forces_.free);
  book(forces_.dry_friction.shares());
  book(forces_.dahl);
}

double BoxFlow::spring_energy(double x) const { return stiffness_ * x * x * (0.5 + 0.25 * cubic_ * x * x); }

void BoxFlow::advance(double time, double step, double& x, double& v, Accounts& accounts) {
  const double before = v;
  if (plain_) {
    rotate(step, x, v);
  } else {
    Phase now{x, v};
    advance_with_effects(time, step, now, accounts);
    x = now.x;
    v = now.v;
  }
  accounts.outer_impulse += mass_ * (v - before);
}

void BoxFlow::rotate(double step, double& x, double& v) {
  if (step != prepared_step_) {
    prepared_step_ = step;
    const double rate = std::sqrt(stiffness_ / mass_);
    const double half_sine = std::sin(rate * step / 2);
    // cos - 1 is kept, not cos: rounding 1 - 5e-9 would change the energy by 1e-16 at every one of millions
    // of steps, always the same way.
    cosine_less_one_ = -2 * half_sine * half_sine;
    sine_over_rate_ = rate > 0 ? std::sin(rate * step) / rate : step;
    rate_times_sine_ = rate * std::sin(rate * step);
  }
  const double moved = x + (x * cosine_less_one_ + v * sine_over_rate_);
  v += v * cosine_less_one_ - x * rate_times_sine_;
  x = moved;
}

double BoxFlow::force(double t, double x, double v) const {
  return forces_.newton(x, v, t, -stiffness_ * x * (1 + cubic_ * x * x)) + dahl_.newton(x);
}

/// Integrates the motion over one step and leaves in works_ what each force did. `sliding`: which way the box
/// slides where a friction acts, +1 or -1; 0 without it.
BoxFlow::Phase BoxFlow::integrate(double time, double step, Phase from, double sliding) {
  Phase end = from;
  for (Work& work : works_) work.joule = 0;
  constexpr std::array<double, 4> nodes{0, 0.5, 0.5, 1}, weights{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  const double dry = -forces_.dry_friction.sum() * sliding;
  double slope_x = 0, slope_v = 0;
  for (std::size_t stage = 0; stage < 4; ++stage) {
    const double ahead = nodes[stage] * step, share = weights[stage] * step;
    const double xs = from.x + ahead * slope_x, vs = from.v + ahead * slope_v, ts = time + ahead;
    slope_x = vs;
    slope_v = (force(ts, xs, vs) + dry) / mass_;
    end.x += share * slope_x;
    end.v += share * slope_v;
    std::size_t line = 0;
    forces_.each(xs, vs, ts, [&](double newton, int) { works_[line++].joule += share * newton * vs; });
    for (const auto& friction : forces_.dry_friction.shares())
      works_[line++].joule -= share * friction.strength * sliding * vs;
    dahl_.each(xs, [&](double newton, int) { works_[line++].joule += share * newton * vs; });
  }
  return end;
}

/// Returns the first time within the step at which the velocity is zero, s from its beginning, by bisection
/// on the integrator itself.
double BoxFlow::time_of_stop(double time, double step, Phase from, double sliding) {
  double low = 0, high = step;
  for (int round = 0; round < 60 && high - low > 1e-16 * step; ++round) {
    const double middle = (low + high) / 2;
    (integrate(time, middle, from, sliding).v * sliding > 0 ? low : high) = middle;
  }
  return high;
}

void BoxFlow::advance_with_effects(double time, double step, Phase& now, Accounts& accounts) {
  if (!dahl_.any()) return rub(time, step, now, accounts);
  // A twentieth of the travel in one step keeps the error of Runge and Kutta's method, (1/20)^5 / 120 of the
  // friction, below 3e-9 of it.
  const double pieces = std::max(1.0, std::ceil(20 * std::abs(now.v) * step / dahl_.shortest_travel()));
  for (double piece = 0; piece < pieces; ++piece)
    rub(time + step * piece / pieces, step / pieces, now, accounts);
}

/// Takes one step, with the stops that it holds where a friction acts.
void BoxFlow::rub(double time, double step, Phase& now, Accounts& accounts) {
  const double most = forces_.dry_friction.sum();
  const auto enter = [&](const Phase& phase) {
    for (const Work& work : works_) accounts.add_work(work.effect, work.joule);
    dahl_.turn(phase.x, 0);
    now = phase;
  };
  if (most == 0 && !dahl_.any()) return enter(integrate(time, step, now, 0));
  double done = 0;
  // Start, stop and start again within one step is already rare; more than a few pieces cannot happen with
  // smooth forces.
  for (int piece = 0; piece < 8 && done < step; ++piece) {
    double sliding = now.v > 0 ? 1 : -1;
    if (now.v == 0) {
      const double pull = force(time + done, now.x, 0);
      if (std::abs(pull) <= most) return;  // stuck until the next step asks again
      sliding = pull > 0 ? 1 : -1;
    }
    dahl_.turn(now.x, sliding);
    const double rest = step - done;
    const Phase whole = integrate(time + done, rest, now, sliding);
    if (whole.v * sliding >= 0) return enter(whole);
    const double until = time_of_stop(time + done, rest, now, sliding);
    enter(integrate(time + done, until, now, sliding));
    now.v = 0;
    done += until;
  }
}

}  // namespace shakedown
