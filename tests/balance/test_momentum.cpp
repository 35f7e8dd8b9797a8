// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "balance_problem.hpp"
#include "effects.hpp"
#include "experiment_file.hpp"
#include "force_map.hpp"
#include "momentum.hpp"
#include "momentum_run.hpp"
#include "pushed_box.hpp"
#include "random.hpp"
#include "setup_file.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

MomentumAudit audited(const Experiment& experiment, const std::vector<Setup>& setups) {
  return audit_momentum(measurement_of(setups, experiment), all_effects());
}
MomentumAudit audited(const Experiment& experiment) { return audited(experiment, pushed_setups(experiment)); }
MomentumAudit audited(const PushedBox& what, std::uint64_t seed = 1) {
  return audited(pushed_box(what, seed));
}

std::string names(const MomentumAudit& audit) {
  std::string text;
  for (const FoundTerm& term : audit.terms) text += (text.empty() ? "" : " ") + term.effect;
  return text;
}

/// The standard error that an interval of 95 % stands for.
double error_of(const FoundTerm& term) { return (term.high - term.low) / (2 * 1.96); }

/// One term, this one, within four standard errors; the standard error that was `seen`, in its unit.
void expect_found(const MomentumAudit& audit, const std::string& effect, double value, double seen) {
  ASSERT_EQ(names(audit), effect);
  const FoundTerm& term = audit.terms[0];
  WITHIN_ERRORS(term.value, value, 4, error_of(term), seen) << effect;
  EXPECT_GT(audit.final_fit.p_value, 1e-3) << audit.final_fit.chi2_per_degree();
  EXPECT_FALSE(audit.unexplained);
}

TEST(SlowMomentum, NothingHiddenNothingFound) {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const MomentumAudit audit = audited(PushedBox{}, seed);
    EXPECT_EQ(names(audit), "") << seed;
    EXPECT_GT(audit.as_given.p_value, 1e-4);
    WITHIN(audit.frequency, 1.23, 3e-4, 1.5e-4);
    sum += audit.as_given.chi2_per_degree() / 12;
  }
  WITHIN(sum, 1, 0.06, 0.025);  // 12 x 280 windows
}

TEST(SlowMomentum, EachForceFromOutsideIsNamedAndMeasured) {
  PushedBox what;
  what.viscous = 0.02;
  expect_found(audited(what), "blade_viscous_damping", 0.02, 1.1e-4);
  what = {};
  what.acceleration = -0.05;
  expect_found(audited(what), "constant_acceleration", -0.05, 8e-3);
  what = {};
  what.cubic = -0.03;
  expect_found(audited(what), "spring_cubic", -0.03, 3.2e-4);
  what = {};
  what.force = [](double, double v, double) { return -0.1 * v * std::abs(v); };
  expect_found(audited(what), "blade_quadratic_drag", 0.1, 5.9e-4);
  what = {};
  what.extra_mass = 0.03;  // 10 g are within what scales and a marker's depth make
  const MomentumAudit mass = audited(what);
  // Without a packed layer at several lengths a heavier box and a smaller distance of the grains are one
  // column.
  ASSERT_EQ(mass.terms.size(), 1u);
  std::vector<std::string> told = mass.terms[0].look_alikes;
  told.push_back(mass.terms[0].effect);
  EXPECT_NE(std::find(told.begin(), told.end(), "blade_mass"), told.end());
  EXPECT_NE(std::find(told.begin(), told.end(), "camera_com_bias"), told.end());
}

TEST(SlowMomentum, DryFrictionIsJudgedWhereTheBoxMoves) {
  PushedBox what;
  what.dry_friction = 0.02;
  const MomentumAudit audit = audited(what);
  expect_found(audit, "clamp_dry_friction", 0.02, 1.3e-4);
  EXPECT_TRUE(audit.only_moving);
}

/// chi2 per degree of freedom of the right model, at the mean of some films, the track taken for steady.
double misfit_of_the_truth(const PushedBox& what, const std::string& effect) {
  constexpr int films = 4;
  const shakedown::Setup truth = parse_setup(effect, "test", all_effects());
  MomentumOptions options;
  options.formulas = false;
  options.effects = {"clamp_dry_friction"};
  options.wander = Wander{0, 0.3};
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= films; ++seed) {
    const Experiment experiment = pushed_box(what, seed);
    const MomentumAudit audit =
        audit_momentum(measurement_of(truth, experiment, all_effects()), all_effects(), options);
    EXPECT_TRUE(audit.only_moving);
    sum += audit.as_given.chi2_per_degree() / films;
  }
  return sum;
}

// A friction turns when the velocity does: what the frames do not tell of that moment is noise of the
// balance.
TEST(SlowMomentum, WhatIsNotKnownOfATurningPointIsNoise) {
  PushedBox what;
  what.dry_friction = 0.02;
  what.com_noise = 5e-5;  // so that little else is noise
  const double sticking =
      misfit_of_the_truth(what, "[[effect]]\nname = \"clamp_dry_friction\"\nforce = \"20 mN\"\n");
  what.dry_friction = 0;
  what.force = [](double, double v, double) { return -0.02 * std::tanh(v / 2e-3); };
  const double creeping = misfit_of_the_truth(
      what,
      "[[effect]]\nname = \"user_force\"\non = \"box\"\nforce = \"-F*tanh(v/v0)\"\nconstants = {F = "
      "\"20 mN\", v0 = \"2 mm/s\"}\n");
  WITHIN(sticking, 1, 0.1, 0.046);
  WITHIN(creeping, 1, 0.1, 0.021);
}

TEST(SlowMomentum, ForcingIsFoundAtItsFrequency) {
  PushedBox what;
  const double mass = 0.434 + 37 * 4.04e-3;
  what.force = [=](double, double, double t) {
    return mass * 0.01 * std::sin(2 * std::numbers::pi * 3.3 * t + 0.7);
  };
  const MomentumAudit audit = audited(what);
  expect_found(audit, "oscillating_acceleration", 0.01, 1.3e-3);
  ASSERT_FALSE(audit.terms.empty());
  WITHIN(audit.terms[0].frequency, 3.3, 0.01, 1.5e-3);
  WITHIN_ERRORS(audit.terms[0].phase, 0.7, 4, error_of(audit.terms[0]) / audit.terms[0].value, 0.11);
}

/// What no two known strengths stand for is no wander of the track, though it varies like one.
TEST(SlowMomentum, ForcesAreNoWander) {
  PushedBox what;
  const double mass = 0.434 + 37 * 4.04e-3;
  what.cubic = -0.03;
  what.force = [=](double, double, double t) {
    return mass * 0.3 * std::sin(2 * std::numbers::pi * 0.84 * t + 1);
  };
  const MomentumAudit audit = audited(what);
  EXPECT_EQ(names(audit), "spring_cubic oscillating_acceleration");
  EXPECT_LE(audit.wander.deviation, 2.1e-5) << "a tenth of the white noise is usual; seen: 0";
  EXPECT_LT(audit.final_fit.p_value, 0.999) << "seen: 0.11";
}

/// The longer windows cannot see so fast and strong a sine and choose slow ones in its place; none of them
/// may stay.
TEST(SlowMomentum, AStrongFastSineStandsAlone) {
  PushedBox what;
  const double mass = 0.434 + 37 * 4.04e-3;
  what.force = [=](double, double, double t) {
    return mass * 0.1 * std::sin(2 * std::numbers::pi * 3 * t + 1);
  };
  const MomentumAudit audit = audited(what);
  expect_found(audit, "oscillating_acceleration", 0.1, 1.2e-3);
  ASSERT_FALSE(audit.terms.empty());
  WITHIN(audit.terms[0].frequency, 3, 0.01, 5.6e-4);
}

TEST(SlowMomentum, TwoForcesAtOnce) {
  PushedBox what;
  what.viscous = 0.03;
  what.cubic = 0.05;
  const MomentumAudit audit = audited(what);
  ASSERT_EQ(audit.terms.size(), 2u) << names(audit);
  EXPECT_FALSE(audit.unlisted);
  for (const FoundTerm& term : audit.terms) {
    const bool cubic = term.effect == "spring_cubic";
    WITHIN_ERRORS(term.value, cubic ? 0.05 : 0.03, 4, error_of(term), cubic ? 5.3e-4 : 1.4e-4) << term.effect;
  }
}

TEST(SlowMomentum, CameraErrorsAreNotForces) {
  Experiment experiment = pushed_box({}, 2);
  for (MeasuredRun& run : experiment.runs)
    for (std::size_t i = 0; i < run.time.size(); ++i)
      run.x_com[i] = run.x_box[i] + 0.95 * (run.x_com[i] - run.x_box[i]);
  expect_found(audited(experiment), "camera_com_bias", 0.05, 4.7e-3);  // known to 5e-3 beforehand
  experiment = pushed_box({}, 3);
  for (MeasuredRun& run : experiment.runs)
    for (std::size_t i = 0; i < run.time.size(); ++i)
      run.x_box[i] += 1e-3 * run.time[i], run.x_com[i] += 1e-3 * run.time[i];
  expect_found(audited(experiment), "camera_drift", 1e-3, 2.8e-6);
  experiment = pushed_box({}, 4);
  for (MeasuredRun& run : experiment.runs)
    for (std::size_t i = 0; i < run.time.size(); ++i)
      run.x_com[i] = run.x_box[i] + std::cos(1.5 * run.x_box[i] / 0.59) * (run.x_com[i] - run.x_box[i]);
  const MomentumAudit arc = audited(experiment);
  ASSERT_EQ(names(arc), "camera_arc");
  WITHIN(arc.terms[0].value, 0.59, 0.018, 9.4e-4);
}

TEST(SlowMomentum, GapsOutliersAndColouredNoiseDoNotConvict) {
  PushedBox what;
  what.colour = 0.5;
  const MomentumAudit coloured = audited(what, 5);
  EXPECT_EQ(names(coloured), "");
  WITHIN(coloured.as_given.chi2_per_degree(), 1, 0.2, 0.16);
  Experiment experiment = pushed_box({}, 6);
  Random random(7, 0, Stream::other);
  for (MeasuredRun& run : experiment.runs)
    for (std::size_t i = 0; i < run.time.size(); ++i) {
      if (random.uniform() < 0.02) run.x_box[i] = NAN;
      if (random.uniform() < 0.02) run.x_com[i] = NAN;
      if (random.uniform() < 0.05) run.x_box[i] += 0.03 * (random.uniform() - 0.5);
      if (i > 1000 && i < 1020) run.x_com[i] = NAN;  // 80 ms: too long to fill
    }
  const MomentumAudit audit = audited(experiment);
  EXPECT_EQ(names(audit), "");
  EXPECT_GT(audit.as_given.p_value, 1e-4) << audit.as_given.chi2_per_degree();
}

TEST(SlowMomentum, EmptyBoxAndMissingGrains) {
  PushedBox what;
  what.grains = false;
  what.viscous = 0.02;
  expect_found(audited(what), "blade_viscous_damping", 0.02, 6.8e-5);
  Experiment experiment = pushed_box({}, 8);
  std::vector<shakedown::Setup> setups = pushed_setups(experiment);
  for (MeasuredRun& run : experiment.runs) run.x_com.clear();
  EXPECT_FALSE(audited(experiment, setups).possible);
}

TEST(SlowMomentum, AForceInNoListIsWrittenAsAFormula) {
  PushedBox what;
  what.force = [](double x, double v, double) {
    return -0.4 * v * std::exp(-std::pow((x - 0.045) / 0.012, 2));
  };
  MomentumAudit audit = audited(what);
  EXPECT_TRUE(audit.unlisted);
  EXPECT_FALSE(audit.unexplained);
  EXPECT_EQ(names(audit), "");
  ASSERT_EQ(audit.formulas.size(), 1u);
  EXPECT_EQ(audit.formulas[0].formula, "-c*v*exp(-((x-x0)/w)^2)");
  const std::vector<double> truth{0.4, 0.045, 0.012}, errors{0.011, 1.9e-4, 3.9e-4};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const FormulaConstant& constant = audit.formulas[0].constants[i];
    WITHIN_ERRORS(constant.value, truth[i], 4, (constant.high - constant.low) / (2 * 1.96), errors[i])
        << constant.name;
  }
  EXPECT_EQ(audit.curves.front().of, ShapeOf::damping_at_x);

  what.force = [](double x, double v, double) { return -20 * v * x * x; };
  audit = audited(what, 2);
  ASSERT_GE(audit.formulas.size(), 1u);
  for (std::size_t i = 1; i < audit.formulas.size(); ++i)  // a trifle beside it may be told too
    EXPECT_LT(audit.formulas[i].gain, 0.01 * audit.formulas[0].gain) << audit.formulas[i].formula;
  EXPECT_EQ(audit.formulas[0].formula, "-c*v*x^2");
  WITHIN(audit.formulas[0].constants[0].value, 20, 0.5, 0.24);  // the trifle takes its part

  what.force = [](double x, double, double) { return x > 0.06 ? -15 * (x - 0.06) : 0; };
  audit = audited(what, 3);
  ASSERT_EQ(audit.formulas.size(), 1u);
  EXPECT_EQ(audit.formulas[0].formula, "-k*max(0,x-x0)");
  WITHIN(audit.formulas[0].constants[1].value, 0.06, 1.5e-3, 8e-5);

  // Two variables: what a layered blade loses a turn, whatever the frequency.
  what.force = [](double x, double v, double) { return -0.6 * std::abs(x) * std::tanh(v / 0.01); };
  audit = audited(what, 5);
  EXPECT_EQ(names(audit), "");
  ASSERT_EQ(audit.formulas.size(), 1u);
  EXPECT_EQ(audit.formulas[0].formula, "-c*tanh(v/0.001)*abs(x)");
  WITHIN(audit.formulas[0].constants[0].value, 0.6, 0.02, 0.0032);
}

TEST(SlowMomentum, AWeakForceInNoListSaysWhatItCannotTell) {
  PushedBox what;
  what.force = [](double x, double v, double) { return -0.025 * v * x * x; };  // about 6 standard errors
  const MomentumAudit audit = audited(what, 4);
  if (audit.unlisted) {
    EXPECT_GE(audit.formulas[0].look_alikes.size(), 2u);
  } else {
    ASSERT_EQ(audit.terms.size(), 1u);
    EXPECT_GE(audit.terms[0].look_alikes.size(), 1u);
  }
}

TEST(SlowMomentum, AWrongFrequencyIsARefitNotAForce) {
  const Experiment experiment = pushed_box({}, 9);
  std::vector<shakedown::Setup> setups = pushed_setups(experiment);
  for (shakedown::Setup& setup : setups) setup.spring.frequency = 1.21;
  const MomentumAudit audit = audited(experiment, setups);
  EXPECT_EQ(names(audit), "");
  EXPECT_LT(audit.as_given.p_value, 1e-10);
  EXPECT_GT(audit.refitted.p_value, 1e-3);
  EXPECT_LT(audit.frequency_low, 1.23);
  EXPECT_GT(audit.frequency_high, 1.23);
}

std::vector<shakedown::Setup> with_damping(const Experiment& experiment, double damping) {
  std::vector<shakedown::Setup> setups = pushed_setups(experiment);
  for (shakedown::Setup& setup : setups)
    set_number(setup, "blade_viscous_damping.damping", damping, all_effects());
  return setups;
}

TEST(SlowMomentum, WhatTheSetupHasTooMuchOfIsTakenOff) {
  PushedBox what;
  what.viscous = 0.02;
  const Experiment experiment = pushed_box(what, 11);
  expect_found(audited(experiment, with_damping(experiment, 0.05)), "blade_viscous_damping", 0.02,
               1.1e-4);  // of the setup's 0.05
}

TEST(SlowMomentum, OneSpringHasOneCoefficientWhateverTheRelease) {
  PushedBox what;
  what.cubic = -0.03;  // at 107.5 mm, as all runs were released
  const Experiment experiment = pushed_box(what, 12);
  std::vector<shakedown::Setup> setups = pushed_setups(experiment);
  setups.back().release.displacement *= 0.5;  // so the setup says
  const MomentumAudit audit = audited(experiment, setups);
  expect_found(audit, "spring_cubic", -0.03, 3.2e-4);
}

double top_speed_of_the_map(const Experiment& experiment) {
  const Measurement measurement = measurement_of(pushed_setups(experiment), experiment);
  const BalanceProblem balance(measurement, all_effects());
  return ForceMap(balance.windows_of(0.5, 0.125).problem, balance.runs()).scales().velocity;
}

// Frames too far apart give a stiffness that is none, and no frequency: what the setup says of it stays.
TEST(Momentum, WithoutAStiffnessThereIsABalanceAllTheSame) {
  const std::string folder = std::string(TEST_DATA) + "/long_pendulum/";
  const shakedown::Setup setup = read_setup(folder + "setup.toml", all_effects());
  MomentumOptions options;
  options.formulas = false;
  const MomentumAudit audit =
      audit_momentum(measurement_of(setup, read_experiment(folder + "experiment.toml"), all_effects()),
                     all_effects(), options);
  EXPECT_TRUE(audit.possible);
  EXPECT_TRUE(std::isfinite(audit.frequency));
}

TEST(Momentum, SpeedsOverAGapAreNotTheBoxs) {
  Experiment experiment = pushed_box({}, 13);
  const double whole = top_speed_of_the_map(experiment);
  for (MeasuredRun& run : experiment.runs) {
    run.x_box[0] = NAN;
    for (std::size_t i = 1000; i < 1020; ++i) run.x_box[i] = NAN;
  }
  EXPECT_DOUBLE_EQ(top_speed_of_the_map(experiment), whole);
}

TEST(SlowMomentum, WhatTheSetupHasIsNotMissed) {
  PushedBox what;
  what.viscous = 0.05;
  const Experiment experiment = pushed_box(what, 10);
  const MomentumAudit audit = audited(experiment, with_damping(experiment, 0.05));
  EXPECT_EQ(names(audit), "");
  EXPECT_GT(audit.as_given.p_value, 1e-3) << audit.as_given.chi2_per_degree();
}

// Most of what a balance asks changes no camera: frames are smoothed once.
TEST(MomentumRun, WithForcesOfAnotherSetupIsThatOfTheSetup) {
  const Experiment experiment = pushed_box({}, 1);
  Measurement::Run changed = measurement_of(pushed_setups(experiment), experiment).runs.front();
  const MomentumRun as_given = momentum_run(changed);
  shakedown::Setup& setup = changed.setup;
  setup.box.mass *= 1.01;
  setup.grains.mass *= 0.99;
  setup.effects.push_back(with_defaults(*all_effects().find("clamp_dry_friction")));
  setup.effects.back().values["force"] = 0.01;
  setup.effects.push_back(with_defaults(*all_effects().find("blade_viscous_damping")));
  setup.effects.back().values["damping"] = 0.02;
  const MomentumRun one = with_forces_of(setup, as_given), other = momentum_run(changed);
  EXPECT_NE(one.stiffness, as_given.stiffness);
  EXPECT_EQ(std::tie(one.box_mass, one.grain_mass, one.stiffness, one.viscous, one.dry_friction, one.effects),
            std::tie(other.box_mass, other.grain_mass, other.stiffness, other.viscous, other.dry_friction,
                     other.effects));
  for (const auto& series : {&MomentumRun::time, &MomentumRun::v_smooth, &MomentumRun::model_force,
                             &MomentumRun::model_force_dx, &MomentumRun::model_force_dv})
    EXPECT_TRUE((one.*series == other.*series).all());
}

}  // namespace
}  // namespace shakedown
