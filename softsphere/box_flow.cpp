// SPDX-License-Identifier: MIT
#include "box_flow.hpp"

#include <cmath>
#include <numbers>

namespace shakedown {

BoxFlow::BoxFlow(const Physics& physics)
    : mass_(physics.box_mass),
      stiffness_(physics.stiffness),
      cubic_(physics.spring_cubic),
      forces_(physics.box) {
  plain_ = cubic_ == 0 && forces_.viscous == 0 && forces_.dry_friction == 0 && forces_.constant == 0 &&
           forces_.harmonics.empty() && forces_.free.empty();
}

double BoxFlow::spring_energy(double x) const { return stiffness_ * x * x * (0.5 + 0.25 * cubic_ * x * x); }

void BoxFlow::advance(double time, double step, double& x, double& v, Accounts& accounts) {
  const double before = v;
  if (plain_)
    rotate(step, x, v);
  else
    advance_with_effects(time, step, x, v, accounts);
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

/// State with the works done since the beginning of a piece.
struct BoxFlow::Phase {
  double x = 0, v = 0;
  double viscous_work = 0, dry_work = 0, constant_work = 0;
  // harmonics, then formulas; empty, and so not allocated, for the usual forces
  std::vector<double> other_work;
};

double BoxFlow::force(double t, double x, double v) const {
  double sum = -stiffness_ * x * (1 + cubic_ * x * x) - forces_.viscous * v + forces_.constant;
  for (const Harmonic& harmonic : forces_.harmonics)
    sum += harmonic.amplitude * std::sin(2 * std::numbers::pi * harmonic.frequency * t + harmonic.phase);
  for (const FreeForce& free : forces_.free) sum += free.newton(x, v, t);
  return sum;
}

BoxFlow::Phase BoxFlow::integrate(double time, double step, double x, double v, double sliding) const {
  Phase end;
  end.x = x;
  end.v = v;
  end.other_work.resize(forces_.harmonics.size() + forces_.free.size());
  constexpr std::array<double, 4> nodes{0, 0.5, 0.5, 1}, weights{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  double slope_x = 0, slope_v = 0;
  for (std::size_t stage = 0; stage < 4; ++stage) {
    const double ahead = nodes[stage] * step, share = weights[stage] * step;
    const double xs = x + ahead * slope_x, vs = v + ahead * slope_v, ts = time + ahead;
    const double dry = -forces_.dry_friction * sliding;
    slope_x = vs;
    slope_v = (force(ts, xs, vs) + dry) / mass_;
    end.x += share * slope_x;
    end.v += share * slope_v;
    end.viscous_work -= share * forces_.viscous * vs * vs;
    end.dry_work += share * dry * vs;
    end.constant_work += share * forces_.constant * vs;
    std::size_t line = 0;
    const auto add = [&](double newton) { end.other_work[line++] += share * newton * vs; };
    for (const Harmonic& harmonic : forces_.harmonics)
      add(harmonic.amplitude * std::sin(2 * std::numbers::pi * harmonic.frequency * ts + harmonic.phase));
    for (const FreeForce& free : forces_.free) add(free.newton(xs, vs, ts));
  }
  return end;
}

/// First time within the step at which the velocity is zero, by bisection on the integrator itself.
double BoxFlow::time_of_stop(double time, double step, double x, double v, double sliding) const {
  double low = 0, high = step;
  for (int round = 0; round < 60 && high - low > 1e-16 * step; ++round) {
    const double middle = (low + high) / 2;
    (integrate(time, middle, x, v, sliding).v * sliding > 0 ? low : high) = middle;
  }
  return high;
}

void BoxFlow::advance_with_effects(double time, double step, double& x, double& v, Accounts& accounts) const {
  const auto enter = [&](const Phase& phase) {
    accounts.add_work(forces_.viscous_effect, phase.viscous_work);
    accounts.add_work(forces_.dry_friction_effect, phase.dry_work);
    accounts.add_work(forces_.constant_effect, phase.constant_work);
    std::size_t line = 0;
    for (const Harmonic& harmonic : forces_.harmonics)
      accounts.add_work(harmonic.effect, phase.other_work[line++]);
    for (const FreeForce& free : forces_.free) accounts.add_work(free.effect, phase.other_work[line++]);
    x = phase.x;
    v = phase.v;
  };
  if (forces_.dry_friction == 0) return enter(integrate(time, step, x, v, 0));
  double done = 0;
  // Start, stop and start again within one step is already rare; more than a few pieces cannot happen with
  // smooth forces.
  for (int piece = 0; piece < 8 && done < step; ++piece) {
    double sliding = v > 0 ? 1 : -1;
    if (v == 0) {
      const double pull = force(time + done, x, 0);
      if (std::abs(pull) <= forces_.dry_friction) return;  // stuck until the next step asks again
      sliding = pull > 0 ? 1 : -1;
    }
    const double rest = step - done;
    const Phase whole = integrate(time + done, rest, x, v, sliding);
    if (whole.v * sliding >= 0) return enter(whole);
    const double until = time_of_stop(time + done, rest, x, v, sliding);
    enter(integrate(time + done, until, x, v, sliding));
    v = 0;
    done += until;
  }
}

}  // namespace shakedown
