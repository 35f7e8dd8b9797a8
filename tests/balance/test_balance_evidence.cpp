// SPDX-License-Identifier: MIT
// How probable the momentum balance holds each effect, where the truth is known.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "balance_problem.hpp"
#include "dahl_friction.hpp"
#include "effects.hpp"
#include "force_map.hpp"
#include "force_shapes.hpp"
#include "foretold.hpp"
#include "linear_audit.hpp"
#include "momentum.hpp"
#include "pushed_box.hpp"
#include "random.hpp"
#include "wander_choice.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

Measurement measured(const Experiment& experiment) {
  return measurement_of(pushed_setups(experiment), experiment);
}

MomentumAudit audited(const Experiment& experiment) {
  MomentumOptions options;
  options.formulas = false;
  return audit_momentum(measured(experiment), all_effects(), options);
}

double probability_of_nothing(const MomentumAudit& audit) {
  for (const WeighedSet& set : audit.sets)
    if (set.effects.empty()) return set.probability;
  return 0;
}

/// Of the effect that is named with most certainty.
double most_certain(const MomentumAudit& audit) {
  std::map<std::string, double> sums;
  for (const WeighedSet& set : audit.sets)
    for (const std::string& effect : set.effects) sums[effect] += set.probability;
  double most = 0;
  for (const auto& [effect, sum] : sums) most = std::max(most, sum);
  return most;
}

/// Standard error of this effect's strength were nothing else in question: one column beside the spring's
/// frequency and the nuisances, the noise white as it was made.
double fisher_error(const Experiment& experiment, const std::string& effect) {
  const Measurement measurement = measured(experiment);
  const BalanceProblem balance(measurement, all_effects());
  const double window = 0.6 / balance.frequency();
  SelectionProblem p = balance.windows_of(window, window / 4);
  p.problem.set_covariance({});
  for (int term = 1; p.is_known(term); ++term)
    if (p.known[static_cast<std::size_t>(term)].effect == effect)
      return fit_terms(p, {{0, 0}, {term, 0}}).fit.error[1];
  return 0;
}

void expect_first(const PushedBox& what, const std::string& effect, double truth, std::uint64_t seed = 1) {
  Experiment experiment = pushed_box(what, seed);
  experiment.known.push_back({"camera.scale", 0, 0, {}});  // else its error is in the interval
  const MomentumAudit audit = audited(experiment);
  ASSERT_FALSE(audit.sets.empty());
  ASSERT_EQ(audit.sets.front().effects, std::vector<std::string>{effect}) << audit.sets.front().probability;
  EXPECT_GT(audit.sets.front().probability, 0.5);
  ASSERT_EQ(audit.terms.size(), 1u);
  const FoundTerm& term = audit.terms.front();
  EXPECT_LE(term.low, truth);
  EXPECT_GE(term.high, truth);
  EXPECT_LT(term.high - term.low, 2.5 * 3.92 * fisher_error(experiment, effect)) << effect;
}

TEST(SlowBalanceEvidence, NothingHiddenIsMostProbable) {
  int probable = 0;
  for (std::uint64_t seed = 101; seed <= 120; ++seed) {
    const MomentumAudit audit = audited(pushed_box({}, seed));
    probable += probability_of_nothing(audit) > 0.5;
    EXPECT_LT(most_certain(audit), 0.95) << seed;
  }
  EXPECT_GE(probable, 18);
}

TEST(SlowBalanceEvidence, ViscousDampingComesFirst) {
  PushedBox what;
  what.viscous = 0.02;
  expect_first(what, "blade_viscous_damping", 0.02);
}

TEST(SlowBalanceEvidence, QuadraticDragComesFirst) {
  PushedBox what;
  what.force = [](double, double v, double) { return -0.1 * v * std::abs(v); };
  expect_first(what, "blade_quadratic_drag", 0.1);
}

TEST(SlowBalanceEvidence, DryFrictionComesFirst) {
  PushedBox what;
  what.dry_friction = 0.02;
  expect_first(what, "clamp_dry_friction", 0.02);
}

/// Dahl's friction, run by run from the release on.
std::function<double(double, double, double)> yielding(double force, double travel) {
  auto state = std::make_shared<DahlState>(std::vector<DahlFriction>{{force, travel}});
  auto last = std::make_shared<double>(0);
  return [=](double x, double, double t) {
    if (t == 0)
      *state = DahlState({{force, travel}});
    else
      state->turn(x, x > *last ? 1 : -1);
    return state->newton(*last = x);
  };
}

TEST(SlowBalanceEvidence, FrictionThatYieldsComesFirstWithItsTravel) {
  for (const double travel : {0.004, 0.012, 0.03}) {
    PushedBox what;
    what.force = yielding(0.05, travel);
    const MomentumAudit audit = audited(pushed_box(what, 7));
    ASSERT_FALSE(audit.sets.empty());
    EXPECT_EQ(audit.sets.front().effects, std::vector<std::string>{"clamp_dahl_friction"}) << travel;
    ASSERT_EQ(audit.terms.size(), 1u) << travel;
    WITHIN(audit.terms[0].value, 0.05, 2e-3, 1.3e-4);
    ASSERT_EQ(audit.terms[0].besides.size(), 1u);
    EXPECT_EQ(audit.terms[0].besides[0].first, "clamp_dahl_friction.travel");
    WITHIN(audit.terms[0].besides[0].second / travel, 1, 0.25, 0.044);
    EXPECT_GT(audit.final_fit.p_value, 0.01) << travel;
  }
}

/// A short travel fits dry friction as well: the simpler one goes first, the other is said beside it.
TEST(SlowBalanceEvidence, DryFrictionIsNotCalledYielding) {
  PushedBox what;
  what.dry_friction = 0.05;
  for (std::uint64_t seed = 11; seed <= 13; ++seed) {
    const MomentumAudit audit = audited(pushed_box(what, seed));
    ASSERT_FALSE(audit.sets.empty());
    EXPECT_EQ(audit.sets.front().effects, std::vector<std::string>{"clamp_dry_friction"}) << seed;
  }
}

/// Who knows how the track wanders leaves the balance no wander to hide a friction's noise in.
TEST(SlowBalanceEvidence, DryFrictionIsNoSineWhereTheWanderIsKnown) {
  PushedBox what;
  what.dry_friction = 0.05;
  MomentumOptions options;
  options.formulas = false;
  options.wander = Wander{0, 0.3};
  const Experiment experiment = pushed_box(what, 11);
  const MomentumAudit audit =
      audit_momentum(measurement_of(pushed_setups(experiment), experiment), all_effects(), options);
  EXPECT_EQ(audit.sets.front().effects, std::vector<std::string>{"clamp_dry_friction"});
}

TEST(SlowBalanceEvidence, ACubicSpringComesFirst) {
  PushedBox what;
  what.cubic = -0.05;
  expect_first(what, "spring_cubic", -0.05);
}

TEST(SlowBalanceEvidence, AConstantAccelerationComesFirst) {
  PushedBox what;
  what.acceleration = -0.15;
  expect_first(what, "constant_acceleration", -0.15);
}

/// Frames that no error of the camera's turns into an effect.
void expect_nothing(const Experiment& experiment) {
  const MomentumAudit audit = audited(experiment);
  EXPECT_TRUE(audit.terms.empty()) << audit.terms.front().effect << " " << audit.sets.front().probability;
  EXPECT_LT(most_certain(audit), 0.95);
}

TEST(SlowBalanceEvidence, ATrackThatWandersIsNoForce) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Experiment experiment = pushed_box({}, seed);
    Random random(seed, 1, Stream::other);
    constexpr double deviation = 2e-5, memory = 0.3;  // m, s
    for (MeasuredRun& run : experiment.runs) {
      const double kept = std::exp(-1 / (run.frame_rate * memory)), fresh = std::sqrt(1 - kept * kept);
      double box = deviation * random.normal(), centre = deviation * random.normal();
      for (std::size_t i = 0; i < run.time.size(); ++i) {
        run.x_box[i] += box, run.x_com[i] += centre;
        box = kept * box + fresh * deviation * random.normal();
        centre = kept * centre + fresh * deviation * random.normal();
      }
    }
    expect_nothing(experiment);
  }
}

TEST(SlowBalanceEvidence, ARollingShutterIsNoForce) {
  Experiment experiment = pushed_box({}, 4);
  constexpr double shutter = 2e-3, reach = 0.4;  // s for so many m
  for (MeasuredRun& run : experiment.runs)
    for (std::vector<double>* series : {&run.x_box, &run.x_com}) {
      const std::vector<double> seen = *series;
      for (std::size_t i = 1; i + 1 < seen.size(); ++i) {  // to first order: seen later by so much
        const double speed = (seen[i + 1] - seen[i - 1]) / (run.time[i + 1] - run.time[i - 1]);
        (*series)[i] = seen[i] + speed * shutter * seen[i] / reach;
      }
    }
  expect_nothing(experiment);
}

TEST(SlowBalanceEvidence, ALensIsNoForce) {
  Experiment experiment = pushed_box({}, 5);
  for (MeasuredRun& run : experiment.runs)
    for (std::vector<double>* series : {&run.x_box, &run.x_com})
      for (double& x : *series) x *= 1 + 0.005 * std::pow(x / 0.2, 2);
  expect_nothing(experiment);
}

TEST(SlowBalanceEvidence, ABoxAGramTooHeavyIsNoForce) {
  PushedBox what;
  what.extra_mass = 1e-3;
  expect_nothing(pushed_box(what, 6));
}

TEST(BalanceEvidence, AWanderIsBoundedByNoiseOrByTheSwing) {
  MomentumRun run;
  run.x_box = Eigen::ArrayXd::LinSpaced(11, -0.1, 0.1);
  EXPECT_DOUBLE_EQ(most_wander({run}, 1e-3), most_wander_of_noise * 1e-3);
  EXPECT_DOUBLE_EQ(most_wander({run}, 1e-5), most_wander_of_swing * 0.1);
  EXPECT_DOUBLE_EQ(most_wander({MomentumRun{}}, 1e-3), most_wander_of_noise * 1e-3);
}

/// In the regression of this box, with the formula among its terms.
bool formula_imitates(std::string_view formula, const ShapeValues& values, const PushedBox& what) {
  const Measurement measurement = measured(pushed_box(what, 5));
  const BalanceProblem balance(measurement, all_effects());
  const double window = 0.6 / balance.frequency();
  SelectionProblem p = balance.windows_of(window, window / 4);
  p.problem.set_covariance({});
  for (const ForceShape& shape : force_shapes())
    if (shape.formula == formula) {
      PreparedTerm& term = p.terms.emplace_back();
      term.shape = &shape, term.shape_values = values;
      for (const MomentumRun& run : *p.runs) term.samples.push_back(shape_samples(shape, values, run));
    }
  return imitates_known(p, {{0, 0}, {static_cast<int>(p.terms.size()) - 1, 0}});
}

// A power of the speed that linear damping imitates to a thousandth is linear damping, however sharp the
// data.
TEST(BalanceEvidence, AFormulaNeverBeatsTheKnownEffectThatItImitates) {
  PushedBox what;
  what.grains = false, what.box_noise = 2e-5;
  what.force = [](double, double v, double) {
    return -0.02 * std::copysign(std::pow(std::abs(v), 0.974), v);
  };
  EXPECT_TRUE(formula_imitates("-c*sign(v)*abs(v)^p", {0.974}, what));
  what.force = [](double x, double v, double) { return -20 * v * x * x; };
  EXPECT_FALSE(formula_imitates("-c*v*x^2", {}, what));
}

// A bump in space is like nothing in the list.
TEST(SlowBalanceEvidence, AFormulaThatImitatesNothingIsOffered) {
  const auto bump = [](double x, double v, double) {
    return -0.4 * v * std::exp(-std::pow((x - 0.03) / 0.01, 2));
  };
  const MomentumAudit audit =
      audit_momentum(measured(pushed_box({.force = bump, .box_noise = 5e-5}, 5)), all_effects());
  EXPECT_TRUE(audit.unlisted);
}

TEST(BalanceEvidence, SinesStandBehindWhatDampsTheBox) {
  FoundTerm sine, weak, strong;
  sine.effect = "oscillating_acceleration", weak.effect = "spring_cubic",
  strong.effect = "blade_viscous_damping";
  sine.frequency = 2.4, sine.gain = 900, weak.gain = 10, strong.gain = 50;
  std::vector<FoundTerm> terms{sine, weak, strong};
  by_what_they_explain(terms);
  EXPECT_EQ(terms[0].effect, "blade_viscous_damping");
  EXPECT_EQ(terms[1].effect, "spring_cubic");
  EXPECT_EQ(terms[2].effect, "oscillating_acceleration");
}

TEST(BalanceEvidence, LostFramesMakeNoNaN) {
  PushedBox what;
  what.viscous = 0.02, what.duration = 6;
  Experiment experiment = pushed_box(what, 7);
  Random random(8, 0, Stream::other);
  for (MeasuredRun& run : experiment.runs)
    for (std::size_t i = 0; i < run.time.size(); ++i) {
      if (random.uniform() < 0.03) run.x_box[i] = NAN;
      if (random.uniform() < 0.03 || (i > 700 && i < 740)) run.x_com[i] = NAN;
    }
  const MomentumAudit audit = audited(experiment);
  ASSERT_EQ(audit.sets.front().effects, std::vector<std::string>{"blade_viscous_damping"});
  double sum = 0;
  for (const WeighedSet& set : audit.sets) {
    EXPECT_TRUE(std::isfinite(set.probability));
    sum += set.probability;
  }
  EXPECT_GT(sum, 0.99 - 1e-9);
  EXPECT_LT(sum, 1 + 1e-9);
  EXPECT_TRUE(std::isfinite(audit.terms.front().high - audit.terms.front().low));
  for (const NuisanceFound& nuisance : audit.nuisances)
    EXPECT_TRUE(std::isfinite(nuisance.value) && std::isfinite(nuisance.error)) << nuisance.name;
  EXPECT_TRUE(std::isfinite(audit.rest) && std::isfinite(audit.frequency));
  for (MeasuredRun& run : experiment.runs)  // nothing at all
    std::fill(run.x_box.begin(), run.x_box.end(), NAN);
  EXPECT_FALSE(audited(experiment).possible);
}

}  // namespace
}  // namespace shakedown
