// SPDX-License-Identifier: MIT
// A box that rings down alone, in closed form: whatever damps it is told from its amplitudes, at any phase
// and origin of the recording.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "diagnosis.hpp"
#include "effects.hpp"
#include "empty_box.hpp"
#include "engines.hpp"
#include "known_effects.hpp"
#include "random.hpp"
#include "setup_file.hpp"
#include "swing.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

struct RingDown {
  double viscous = 0, dry = 0, quadratic = 0;  // N s/m, N, N s^2/m^2
  double start = 0, origin = 0;                // s after release, m
};

shakedown::Setup empty_box() {
  shakedown::Setup setup;
  setup.grains.count = 0;
  return setup;
}

/// By leapfrog in steps of 0.1 ms: 1e-8 of the amplitude.
Experiment recorded(const RingDown& what, std::uint64_t seed) {
  const shakedown::Setup setup = empty_box();
  const double mass = setup.box.mass,
               stiffness = mass * std::pow(2 * std::numbers::pi * setup.spring.frequency, 2);
  constexpr double rate = 100, duration = 20, noise = 1e-4;
  constexpr int steps = 100;
  const double step = 1 / (rate * steps);
  Random random(seed, 0, Stream::camera);
  Experiment experiment;
  MeasuredRun& run = experiment.runs.emplace_back();
  run.name = "empty";
  run.box_length = setup.box.length;
  run.frame_rate = rate;
  double x = setup.release.displacement, v = 0;
  for (int frame = 0; frame < static_cast<int>(duration * rate); ++frame) {
    const double t = frame / rate;
    if (t >= what.start) {
      run.time.push_back(t - what.start);
      run.x_box.push_back(x + what.origin + noise * random.normal());
    }
    for (int i = 0; i < steps; ++i) {
      v += (-stiffness * x - what.viscous * v - what.quadratic * v * std::abs(v)) / mass * step;
      const double friction = what.dry / mass * step;
      v = std::abs(v) < friction ? 0 : v - std::copysign(friction, v);
      x += v * step;
    }
  }
  return experiment;
}

void expect_named(RingDown what, const std::string& effect, double truth, Tolerance within) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  DiagnoseOptions options;
  options.known = all_effects();
  std::uint64_t seed = 1;
  for (const auto& [start, origin] : {std::pair(0.0, 0.0), {0.23, 0.012}, {0.61, -0.03}}) {
    what.start = start, what.origin = origin;
    const Diagnosis d =
        diagnose(empty_box(), measurement_of({empty_box()}, recorded(what, seed++)), *engine, options);
    EXPECT_EQ(d.verdict, Verdict::missing) << d.sentence;
    ASSERT_FALSE(d.hypotheses.empty());
    EXPECT_EQ(d.hypotheses.front().effects, std::vector<std::string>{effect}) << start;
    EXPECT_GT(d.explained, 0.95);
    ASSERT_EQ(d.momentum.terms.size(), 1u) << d.sentence;
    WITHIN(d.momentum.terms.front().value, truth, within) << start;
  }
}

TEST(SlowEmptyBox, ViscousDampingIsNamed) {
  expect_named({.viscous = 0.03}, "blade_viscous_damping", 0.03, {4e-4, 7.7e-5});
}

TEST(SlowEmptyBox, DryFrictionIsNamed) {
  expect_named({.dry = 0.01}, "clamp_dry_friction", 0.01, {2.5e-4, 4.2e-5});
}

TEST(SlowEmptyBox, QuadraticDragIsNamed) {
  expect_named({.quadratic = 0.1}, "blade_quadratic_drag", 0.1, {1e-3, 1.8e-4});
}

TEST(SlowEmptyBox, WithoutFrictionNothingIsMissing) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  DiagnoseOptions options;
  options.known = all_effects();
  const Diagnosis d =
      diagnose(empty_box(), measurement_of({empty_box()}, recorded({.start = 0.4, .origin = 0.01}, 9)),
               *engine, options);
  EXPECT_TRUE(d.missing.empty()) << d.sentence;
  EXPECT_NE(d.verdict, Verdict::unknown) << d.sentence;
}

}  // namespace

TEST(SlowEmptyBox, AnOriginIsToldThoughTheFrequencyWasGivenWrong) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  DiagnoseOptions options;
  options.known = all_effects();
  shakedown::Setup given = empty_box();
  given.spring.frequency *= 0.95;
  const Diagnosis d =
      diagnose(given, measurement_of({given}, recorded({.viscous = 0.03, .start = 0.23, .origin = 0.012}, 7)),
               *engine, options);
  const auto origin = std::find_if(d.camera.begin(), d.camera.end(), [](const NuisanceFound& n) {
    return n.name.starts_with("camera_origin");
  });
  ASSERT_NE(origin, d.camera.end());
  WITHIN_ERRORS(origin->value, 0.012, 4, origin->error, 4e-6);
  EXPECT_LT(origin->error, 2e-4);
}

TEST(SlowEmptyBox, NoGrainsInAnyRunIsAnEmptyBoxToo) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  DiagnoseOptions options;
  options.known = all_effects();
  shakedown::Setup with_grains = empty_box();
  with_grains.grains.count = shakedown::Setup{}.grains.count;
  const Diagnosis d =
      diagnose(with_grains, measurement_of({empty_box()}, recorded({.viscous = 0.03}, 1)), *engine, options);
  EXPECT_EQ(d.missing, std::vector<std::string>{"blade_viscous_damping"});
  EXPECT_EQ(d.runs_simulated, 0);
  EXPECT_EQ(d.amended.grains.count, 0);
}

namespace {

/// Viscous 0.03 N s/m and 10 mN dry, a frequency counted 2 % wrong.
Diagnosis of_damped_box(const std::vector<KnownValue>& known, const DiagnoseOptions& options,
                        double stated_frequency_factor = 1) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  shakedown::Setup given = empty_box();
  given.spring.frequency *= stated_frequency_factor;
  Experiment experiment = recorded({.viscous = 0.03, .dry = 0.01, .start = 0.23, .origin = 0.004}, 5);
  experiment.known = known;
  return diagnose(given, measurement_of(given, experiment, all_effects()), *engine, options);
}

DiagnoseOptions of_all_effects() {
  DiagnoseOptions options;
  options.known = all_effects();
  return options;
}

const FoundTerm& term_of(const Diagnosis& d, const std::string& effect) {
  for (const FoundTerm& term : d.momentum.terms)
    if (term.effect == effect) return term;
  ADD_FAILURE() << effect << " is not found: " << d.sentence;
  static const FoundTerm none;
  return none;
}

double half_width(const FoundTerm& term) { return (term.high - term.low) / 2 / term.value; }

}  // namespace

TEST(SlowEmptyBox, ABadlyKnownScaleShrinksNothing) {
  const Diagnosis usual = of_damped_box({}, of_all_effects()),
                  bad = of_damped_box({{"camera.scale", 0, 0.1, {}}}, of_all_effects());
  const FoundTerm &viscous = term_of(usual, "blade_viscous_damping"),
                  &with_bad = term_of(bad, "blade_viscous_damping");
  WITHIN(with_bad.value / viscous.value, 1, 4e-15, 2.3e-16);
  WITHIN(half_width(with_bad) / half_width(viscous), 1, 2e-4, 1.1e-5);
  // Dry friction is as uncertain as the lengths.
  EXPECT_GT(half_width(term_of(bad, "clamp_dry_friction")), 0.19);
  EXPECT_LT(half_width(term_of(usual, "clamp_dry_friction")), 0.1);
}

TEST(SlowEmptyBox, ABadlyWeighedBoxWidensEveryForce) {
  const Diagnosis bad =
      of_damped_box({{"box.mass", empty_box().box.mass, 0.05 * empty_box().box.mass, {}}}, of_all_effects());
  WITHIN(half_width(term_of(bad, "blade_viscous_damping")), 0.1, 0.02, 1.9e-3);
}

TEST(SlowEmptyBox, TheMassOfKnownIsTheBoxs) {
  const double mass = empty_box().box.mass;
  const Diagnosis usual = of_damped_box({}, of_all_effects()),
                  heavy = of_damped_box({{"box.mass", 1.1 * mass, 0.001 * mass, {}}}, of_all_effects());
  WITHIN(term_of(heavy, "blade_viscous_damping").value / term_of(usual, "blade_viscous_damping").value, 1.1,
         1.2e-13, 1.4e-14);
}

TEST(SlowEmptyBox, AFrequencyKnownExactlyStays) {
  DiagnoseOptions options = of_all_effects();
  options.fixed = {"spring.frequency"};
  const double stated = 1.02 * empty_box().spring.frequency;
  const Diagnosis held = of_damped_box({}, options, 1.02);
  WITHIN(held.momentum.frequency / stated, 1, 1.6e-11, 8.2e-13);
  EXPECT_EQ(held.amended.spring.frequency, stated);
  for (const DiagnosedParameter& p : held.parameters) EXPECT_NE(p.name, "spring.frequency");
  const double right = empty_box().spring.frequency;
  WITHIN(
      of_damped_box({{"spring.frequency", right, 0, {}}}, of_all_effects(), 1.02).momentum.frequency / right,
      1, 1e-9, 8.9e-11);
}

TEST(EmptyBox, OnlyTheEffectsAskedForAreAdded) {
  DiagnoseOptions options = of_all_effects();
  options.effects = {"spring_cubic"};
  const Diagnosis d = of_damped_box({}, options);
  for (const std::string& effect : d.missing) EXPECT_EQ(effect, "spring_cubic");
  for (const Hypothesis& hypothesis : d.hypotheses)
    for (const std::string& effect : hypothesis.effects)
      EXPECT_TRUE(effect == "spring_cubic" || effect == unlisted_effect) << effect;
}

TEST(Swing, IsCountedFromItsFirstTurnAboutItsOwnOrigin) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const Measurement recorded_anywhere =
      measurement_of({empty_box()}, recorded({.start = 0.23, .origin = 0.012}, 3));
  const Measurement started = from_first_turns(recorded_anywhere, *engine);
  const Measurement::Run& run = started.runs.front();
  // undamped: it turns as far away as it was released
  WITHIN(std::abs(run.setup.release.displacement), empty_box().release.displacement, 2e-5, 3e-6);
  const double omega = 2 * std::numbers::pi * run.setup.spring.frequency;
  double squares = 0;
  for (std::size_t i = 0; i < run.recorded.time.size(); ++i)
    squares += std::pow(
        run.recorded.x_box[i] - run.setup.release.displacement * std::cos(omega * run.recorded.time[i]), 2);
  // Standard error of 2000 frames.
  WITHIN(std::sqrt(squares / static_cast<double>(run.recorded.time.size())), 1e-4, 1e-5, 1.6e-6);
}

/// A wheel with a coarse encoder and a clock that jitters: steps of 7 to 23 ms about 10 ms, angles (as
/// millimetres) in steps of 10.9.
Experiment coarse_wheel(double frequency, double amplitude, double decay, double duration,
                        std::uint64_t seed) {
  constexpr double step = 10.9e-3;
  Random random(seed, 0, Stream::camera);
  Experiment experiment;
  MeasuredRun& run = experiment.runs.emplace_back();
  run.name = "wheel";
  run.box_length = empty_box().box.length;
  run.frame_rate = 100;
  for (double t = 0; t < duration;
       t += random.uniform() < 0.9 ? 7e-3 + 3e-3 * random.uniform() : 23e-3 * random.uniform() + 7e-3) {
    const double x = amplitude * std::exp(-decay * t) * std::cos(2 * std::numbers::pi * frequency * t + 0.7);
    run.time.push_back(t);
    run.x_box.push_back(step * std::round(x / step));
  }
  return experiment;
}

TEST(SlowEmptyBox, ACoarseEncoderWithAJitteringClockIsAnsweredInWords) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  DiagnoseOptions options;
  options.known = all_effects();
  for (const double amplitude : {0.02, 0.1, 0.5})
    for (const double duration : {3.0, 12.0}) {
      shakedown::Setup given = empty_box();
      given.spring.frequency = 0.9;
      given.release.displacement = amplitude;
      const Diagnosis d = diagnose(
          given, measurement_of({given}, coarse_wheel(0.9, amplitude, 0.05, duration, 5)), *engine, options);
      EXPECT_FALSE(d.sentence.empty());
      for (const DiagnosedParameter& p : d.parameters) EXPECT_TRUE(std::isfinite(p.value)) << p.name;
    }
}

// A softening cubic that fits the balance of a large swing runs away where it is simulated from further out.
TEST(EmptyBox, ASpringThatRunsAwayIsAnsweredInWords) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  shakedown::Setup given = empty_box();
  const double a = given.release.displacement;
  Measurement measurement = measurement_of({given}, recorded({.viscous = 0.03}, 3));
  for (Measurement::Run& run : measurement.runs) {
    run.setup.effects.push_back(with_defaults(*all_effects().find("spring_cubic")));
    set_number(run.setup, "spring_cubic.coefficient", -0.5, all_effects());
    set_number(run.setup, "spring_cubic.reference", a / 3, all_effects());
  }
  const SwingError error = swing_error(measurement, *engine, false);
  EXPECT_TRUE(std::isinf(error.error));
  EXPECT_FALSE(error.why_not.empty());
}

TEST(Swing, TurnsWhereTheFirstPeriodsShowItThoughADampingIsMissing) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const Measurement damped = measurement_of({empty_box()}, recorded({.viscous = 0.1, .start = 0.23}, 3));
  double farthest = 0;
  const Measurement::Run& run = damped.runs.front();
  for (std::size_t i = 0; i < run.recorded.time.size() && run.recorded.time[i] < 0.8; ++i)
    farthest = std::max(farthest, std::abs(run.recorded.x_box[i]));
  const auto turn = [&](double periods) {
    return std::abs(from_first_turns(damped, *engine, periods).runs.front().setup.release.displacement);
  };
  WITHIN(turn(1.5) / farthest, 1, 0.1, 0.073);
  EXPECT_LT(turn(std::numeric_limits<double>::infinity()), 0.6 * farthest);
}
