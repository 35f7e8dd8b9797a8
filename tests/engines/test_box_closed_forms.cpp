// SPDX-License-Identifier: MIT
// The empty box under each effect that acts on it, in every engine that models it, against the solutions of
// textbooks.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "driven_box.hpp"
#include "setups.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

using std::numbers::pi;
constexpr double mass = 0.434, start = 0.1075;
const double w0 = 2 * pi * 1.23, stiffness = mass * w0 * w0;

using Values = std::map<std::string, ParameterValue>;

shakedown::Setup empty_box(std::string_view effect, const Values& values, double duration) {
  shakedown::Setup setup;
  setup.grains.count = 0;
  setup.run.duration = duration;
  add_effect(setup, effect, values);
  return setup;
}

/// Closed forms balance to 1e-12; a dense solution adds up the errors of its pieces.
constexpr double closed = 1e-12, dense = 2e-11;

/// Runs the setup in every engine that models its first effect, for `check` to look at.
void in_every_engine(const shakedown::Setup& setup, double balance,
                     const std::function<void(const Trajectory&)>& check) {
  for (const EngineUnderTest& tested : engines_that_model(setup.effects.front().record->name)) {
    SCOPED_TRACE(tested.name);
    const Trajectory result = tested.make()->run(setup);
    EXPECT_LE(result.health.ledger_error, balance);
    EXPECT_LE(result.health.momentum_error, balance);
    check(result);
  }
}

void expect_motion(const shakedown::Setup& setup, double balance, const std::function<double(double)>& x,
                   double tolerance) {
  in_every_engine(setup, balance, [&](const Trajectory& result) {
    double worst = 0;
    for (std::size_t k = 0; k < result.time.size(); ++k)
      worst = std::max(worst, std::abs(result.x_box[k] - x(result.time[k])));
    EXPECT_LE(worst, tolerance);
  });
}

/// Extrema of x between samples: where v changes sign, from v and its slope (error of third order in the
/// interval).
std::vector<double> extrema_of(const Trajectory& result) {
  std::vector<double> extrema;
  for (std::size_t k = 1; k + 1 < result.time.size(); ++k) {
    const double v = result.v_box[k], next = result.v_box[k + 1];
    if ((v > 0) == (next > 0) || v == 0) continue;
    const double h = result.time[k + 1] - result.time[k], wait = h * v / (v - next);
    extrema.push_back(result.x_box[k] + v * wait / 2);
  }
  return extrema;
}

}  // namespace

TEST(EmptyBox, ViscousDampingMakesExtremaDecayExponentially) {
  const double c = 0.3, decay = c / (2 * mass), w = std::sqrt(w0 * w0 - decay * decay);
  shakedown::Setup setup = empty_box("blade_viscous_damping", {{"damping", c}}, 24 * pi / w);
  setup.run.sample_rate = w / pi;  // extrema are half a damped period apart
  in_every_engine(setup, closed, [&](const Trajectory& result) {
    for (std::size_t n = 0; n < result.time.size(); ++n)
      WITHIN(result.x_box[n], (n % 2 ? -1 : 1) * start * std::exp(-decay * pi / w * static_cast<double>(n)),
             5e-14, 2.5e-15);
    WITHIN(result.ledger.effect_loss[0] + result.total_energy.back(), result.initial_energy, 6e-14, 3.4e-15);
  });
}

TEST(EmptyBox, ClampFrictionTakesTheSameFromEveryExtremumUntilTheBoxSticks) {
  const double force = 0.1, drop = 2 * force / stiffness;
  shakedown::Setup setup = empty_box("clamp_dry_friction", {{"force", force}}, 10);
  setup.run.sample_rate = w0 / pi;
  const int swings = static_cast<int>(std::ceil((start - force / stiffness) / drop));
  in_every_engine(setup, closed, [&](const Trajectory& result) {
    for (std::size_t n = 0; n < result.time.size(); ++n) {
      const int done = std::min(static_cast<int>(n), swings);
      WITHIN(result.x_box[n], (done % 2 ? -1 : 1) * (start - done * drop), 6e-14, 3.2e-15) << n;
    }
    EXPECT_EQ(result.v_box.back(), 0);
    EXPECT_LT(std::abs(result.x_box.back()), force / stiffness);
    // Friction times the whole way.
    const double way = swings * (2 * start) - drop * swings * swings;
    WITHIN(result.ledger.effect_loss[0], force * way, 9e-14, 4.6e-15);
  });
}

// Dahl's friction (harness/problem/dahl_friction.hpp).

TEST(SlowEmptyBox, FrictionThatYieldsAtOnceIsDryFriction) {
  // After a turning point the resistance comes up over the travel, which gives back the impulse F travel:
  // each half swing loses 2 F (reach - travel) instead of 2 F reach, so extrema fall by 2 F/k, less 2 F/k
  // times travel over reach; the release, unloaded, half of that.
  const double force = 0.1, travel = 1e-5, drop = 2 * force / stiffness;
  shakedown::Setup setup = empty_box("clamp_dahl_friction", {{"force", force}, {"travel", travel}}, 4);
  setup.run.sample_rate = 20000;
  in_every_engine(setup, dense, [&](const Trajectory& result) {
    const std::vector<double> extrema = extrema_of(result);
    ASSERT_GE(extrema.size(), 8u);
    double reach = start;
    for (std::size_t n = 0; n < 8; ++n) {
      const double mean = reach - drop / 2, saved = (n == 0 ? 1 : 2) * force * travel / (stiffness * mean);
      reach -= drop - saved;
      WITHIN(std::abs(extrema[n]), reach, 1e-9, 7.3e-11);
    }
  });
}

TEST(EmptyBox, FrictionThatHardlyYieldsIsASpring) {
  // f = sigma (x - x0) for motion much smaller than the travel, x0 the release where it is unloaded.
  const double reach = 1e-5, travel = 1, force = 2;  // sigma 2 N/m beside 25.9
  shakedown::Setup setup = empty_box("clamp_dahl_friction", {{"force", force}, {"travel", travel}}, 6);
  setup.release.displacement = reach;
  const double sigma = force / travel, middle = reach * sigma / (stiffness + sigma);
  const double w = std::sqrt((stiffness + sigma) / mass);
  expect_motion(
      setup, 1e-6, [&](double t) { return middle + (reach - middle) * std::cos(w * t); },
      1e-9);  // seen: 2.3e-10
}

TEST(EmptyBox, FrictionThatYieldsLosesTheAreaOfItsLoop) {
  // A steady loop of amplitude A loses 4 F (A - travel tanh(A / travel)). Friction is weak, so A hardly
  // changes in a period, and the loss of a period about its middle extremum is that of its mean amplitude.
  const double force = 1e-4, travel = 0.03;
  shakedown::Setup setup = empty_box("clamp_dahl_friction", {{"force", force}, {"travel", travel}}, 8);
  setup.run.sample_rate = 20000;
  in_every_engine(setup, dense, [&](const Trajectory& result) {
    const std::vector<double> extrema = extrema_of(result);
    ASSERT_GE(extrema.size(), 12u);
    for (std::size_t n = 4; n + 2 < extrema.size(); ++n) {
      const double a = std::abs(extrema[n]), b = std::abs(extrema[n + 2]), mean = (a + b) / 2;
      const double lost = stiffness * (a * a - b * b) / 2;
      WITHIN(lost / (4 * force * (mean - travel * std::tanh(mean / travel))), 1, 2e-6, 1.2e-7);
    }
    EXPECT_GT(result.ledger.effect_loss[0], 0);
  });
}

TEST(SlowEmptyBox, FrictionThatYieldsIsOneLawInBothEngines) {
  for (const double travel : {1e-5, 1e-3, 0.02}) {
    shakedown::Setup setup = empty_box("clamp_dahl_friction", {{"force", 0.2}, {"travel", travel}}, 8);
    add_effect(setup, "constant_acceleration", {{"acceleration", Vec3(0.1, 0, 0)}});
    add_effect(setup, "clamp_dry_friction", {{"force", 0.01}});
    std::optional<Trajectory> first;
    in_every_engine(setup, dense, [&](const Trajectory& result) {
      if (!first) first = result;
      double worst = 0;
      for (std::size_t k = 0; k < result.time.size(); ++k)
        worst = std::max(worst, std::abs(result.x_box[k] - first->x_box[k]));
      WITHIN(worst, 0, 3e-12, 1.9e-13);
    });
  }
}

TEST(EmptyBox, QuadraticDragFollowsTheRecurrenceOfItsExtrema) {
  // v dv/dx = -w0^2 x - b v^2 on a way from -A to B: (1 - 2 b B) exp(2 b B) = (1 + 2 b A) exp(-2 b A), b =
  // c/M.
  const double c = 0.3, b = c / mass;
  const auto next = [&](double amplitude) {
    const double wanted = (1 + 2 * b * amplitude) * std::exp(-2 * b * amplitude);
    double low = 0, high = amplitude;
    for (int i = 0; i < 100; ++i) {
      const double middle = (low + high) / 2;
      ((1 - 2 * b * middle) * std::exp(2 * b * middle) > wanted ? low : high) = middle;
    }
    return low;
  };
  shakedown::Setup setup = empty_box("blade_quadratic_drag", {{"drag", c}}, 6);
  setup.run.sample_rate = 20000;
  in_every_engine(setup, dense, [&](const Trajectory& result) {
    const std::vector<double> extrema = extrema_of(result);
    ASSERT_EQ(extrema.size(), 14u);
    double amplitude = start;
    for (const double extremum : extrema)
      WITHIN(std::abs(extremum), amplitude = next(amplitude), 2e-13, 1.2e-14);
    EXPECT_LT(amplitude, 0.7 * start);
  });
}

TEST(EmptyBox, CubicSpringHasThePeriodOfDuffing) {
  for (const double b : {0.5, 0.04, -0.3}) {
    // T = 4 K(m) / (w0 sqrt(1 + b)), m = b / (2 (1 + b)); for m < 0: K(m) = K(m/(m - 1)) / sqrt(1 - m).
    const double m = b / (2 * (1 + b));
    const double K = m >= 0 ? std::comp_ellint_1(std::sqrt(m))
                            : std::comp_ellint_1(std::sqrt(m / (m - 1))) / std::sqrt(1 - m);
    shakedown::Setup setup = empty_box("spring_cubic", {{"coefficient", b}}, 8);
    setup.run.sample_rate = w0 * std::sqrt(1 + b) / K;  // quarter periods
    in_every_engine(setup, dense, [&](const Trajectory& result) {
      constexpr std::array<double, 4> quarter{start, 0, -start, 0};
      for (std::size_t n = 0; n < result.time.size(); ++n)
        WITHIN(result.x_box[n], quarter[n % 4], 1e-11, 2.2e-12) << b;
      WITHIN(result.initial_energy / (stiffness * start * start / 2 * (1 + b / 2)), 1, 4e-15, 2.3e-16);
      EXPECT_EQ(result.ledger.effect_loss[0], 0);
    });
  }
}

TEST(EmptyBox, HarmonicAccelerationForcesIt) {
  const double a = 0.4, f = 1.7, phase = 0.6, w = 2 * pi * f, forced = a / (w0 * w0 - w * w);
  expect_motion(
      empty_box("oscillating_acceleration",
                {{"amplitude", Vec3(a, 0.2, 0)}, {"frequency", f}, {"phase", phase}}, 8),
      closed,
      [&](double t) {
        return forced * std::sin(w * t + phase) + (start - forced * std::sin(phase)) * std::cos(w0 * t) -
               forced * w / w0 * std::cos(phase) * std::sin(w0 * t);
      },
      2e-12);
}

/// Nothing is stored at release: errors are fractions of what the books hold later.
TEST(EmptyBox, ShakenFromRestAtTheCentreHasItsBooksMeasured) {
  shakedown::Setup setup;
  setup.grains.count = 0;
  setup.release.displacement = 0;
  setup.run.duration = 2;
  add_effect(setup, "oscillating_acceleration", {{"amplitude", Vec3(0.5, 0, 0)}, {"frequency", 0.9}});
  for (const EngineUnderTest& tested : engines_that_model("oscillating_acceleration")) {
    SCOPED_TRACE(tested.name);
    const Trajectory result = tested.make()->run(setup);
    EXPECT_EQ(result.initial_energy, 0);
    EXPECT_GT(result.health.ledger_error, 0);
    EXPECT_LE(result.health.ledger_error, 1e-12);
    EXPECT_GT(result.health.momentum_error, 0);
    EXPECT_LE(result.health.momentum_error, 5e-14);
  }
}

TEST(SlowEmptyBox, HasTheResonanceCurveOfTheDampedOscillator) {
  const double c = 2, a = 0.5, rate = c / mass;
  for (const double f : {0.7, 1.23, 1.9}) {
    const double w = 2 * pi * f;
    shakedown::Setup setup =
        empty_box("oscillating_acceleration", {{"amplitude", Vec3(a, 0, 0)}, {"frequency", f}}, 20);
    add_effect(setup, "blade_viscous_damping", {{"damping", c}});
    setup.soft.contact_time = 1e-3;
    const double amplitude = a / std::hypot(w0 * w0 - w * w, rate * w),
                 lag = std::atan2(rate * w, w0 * w0 - w * w);
    in_every_engine(setup, closed, [&](const Trajectory& result) {
      double worst = 0;
      for (std::size_t k = 0; k < result.time.size(); ++k)
        if (result.time[k] > 15)
          worst = std::max(worst, std::abs(result.x_box[k] - amplitude * std::sin(w * result.time[k] - lag)));
      EXPECT_LE(worst, 1e-13) << f;
    });
  }
}

TEST(EmptyBox, ConstantAccelerationShiftsItsCentre) {
  const double shift = 0.3 / (w0 * w0);
  expect_motion(
      empty_box("constant_acceleration", {{"acceleration", Vec3(0.3, 0.1, 0)}}, 8), closed,
      [&](double t) { return shift + (start - shift) * std::cos(w0 * t); }, 2e-12);
}

TEST(EmptyBox, AddedMassSlowsIt) {
  const double w = w0 * std::sqrt(mass / (mass + 0.05));
  expect_motion(
      empty_box("blade_mass", {{"mass", 0.05}}, 8), closed, [&](double t) { return start * std::cos(w * t); },
      2e-12);
}

TEST(EmptyBox, StartsWithAPush) {
  expect_motion(
      empty_box("initial_box_velocity", {{"velocity", -0.2}}, 8), closed,
      [&](double t) { return start * std::cos(w0 * t) - 0.2 / w0 * std::sin(w0 * t); }, 2e-12);
}

TEST(EmptyBox, FollowsAFormula) {
  // A formula's spring on top of the blade's: still harmonic.
  const double w = std::sqrt(w0 * w0 + 5 / mass);
  expect_motion(
      empty_box("user_force",
                {{"force", std::string("-k*x")}, {"constants", std::map<std::string, double>{{"k", 5.0}}}},
                8),
      dense, [&](double t) { return start * std::cos(w * t); }, 2e-12);
}

TEST(EmptyBox, ComesToRestAlsoWhereTimesCannotResolveWhen) {
  shakedown::Setup setup;
  add_effect(setup, "clamp_dry_friction", {{"force", 0.02}});
  for (const double v : {3.3e-17, -3.3e-17, 1e-15, 1e-13}) {
    DrivenBox box(physics_of(setup), 3.4533526531033837e-06, v, 8.0745202870759023);
    int pieces = 0;
    while (std::isfinite(box.valid_until()) && pieces < 10) {
      box.go_on();
      ++pieces;
    }
    EXPECT_LT(pieces, 3) << v;
    EXPECT_EQ(box.v(), 0) << v;
  }
}
