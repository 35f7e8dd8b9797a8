// SPDX-License-Identifier: MIT
// The whole diagnosis on small experiments from a laboratory of soft spheres.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "diagnosis.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "engines.hpp"
#include "errors.hpp"
#include "experiment_file.hpp"
#include "hidden_measurements.hpp"
#include "next_experiment.hpp"
#include "rules.hpp"
#include "setup_file.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// As said by somebody who measured the camera: what its errors would take up is left to the physics.
Measurement through_a_perfect_camera(Measurement measurement) {
  for (const EffectRecord* record : all_effects())
    if (!record->camera_error.known_as.empty())
      measurement.known.push_back({std::string(record->camera_error.known_as), 0, 0, {}});
  return measurement;
}

Diagnosis diagnosis_of(const Hidden& hidden, const std::vector<std::string>& effects = {}, int threads = 2,
                       const std::vector<std::string>& fixed = {}, bool perfect_camera = false) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  DiagnoseOptions options;
  options.effects = effects;
  options.known = all_effects();
  options.execution.threads = threads;
  options.fixed = fixed;
  options.strength_uncertainty = &strength_uncertainty;  // as the program
  const Measurement measurement = as_measured(measured(hidden), believed(hidden.duration));
  return diagnose(believed(hidden.duration),
                  perfect_camera ? through_a_perfect_camera(measurement) : measurement, *engine, options);
}

/// The standard error that an interval of 95 % stands for.
double error_of(const DiagnosedParameter& p) { return (p.high - p.low) / (2 * 1.96); }

TEST(SlowDiagnosis, NothingHiddenIsAdequate) {
  const Diagnosis d = diagnosis_of({{}});
  EXPECT_EQ(d.verdict, Verdict::adequate) << d.sentence;
  EXPECT_TRUE(d.missing.empty());
  EXPECT_EQ(write_setup(d.amended), write_setup(believed()));
  EXPECT_GT(d.ladder.front().p_value, 0.03);
}

TEST(SlowDiagnosis, LimitsHoldAndWhatWasNotTriedIsSaid) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const Measurement measurement = as_measured(measured({{"blade_viscous_damping=damping:0.05 N s/m"}}));
  DiagnoseOptions options;
  options.known = all_effects();
  options.execution.threads = 2;
  options.budget = 1200;
  const Diagnosis few = diagnose(believed(), measurement, *engine, options);
  EXPECT_LE(few.runs_simulated, options.budget);
  EXPECT_FALSE(few.not_tried.empty());
  EXPECT_EQ(few.missing, std::vector<std::string>{"blade_viscous_damping"}) << few.sentence;
  // No time at all: one fit of the model as given and one with what the balance found.
  options.budget = 0;
  options.seconds = 1e-9;
  const Diagnosis hasty = diagnose(believed(), measurement, *engine, options);
  EXPECT_EQ(hasty.runs_simulated, least_budget(measurement));
  EXPECT_FALSE(hasty.not_tried.empty());
  EXPECT_EQ(hasty.missing, std::vector<std::string>{"blade_viscous_damping"}) << hasty.sentence;
  // What cannot be kept is refused.
  options.budget = 1;
  EXPECT_THROW(diagnose(believed(), measurement, *engine, options), InputError);
}

// The signature is sure, and simulations do not suffice for a fit as usual: it has what was kept for the
// last.
TEST(SlowDiagnosis, WhatIsSureIsNamedThoughSimulationsRunOut) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const Measurement measurement = as_measured(measured({{"velocity_dependent_restitution=exponent:0.2"}}));
  DiagnoseOptions options;
  options.known = all_effects();
  options.effects = {"velocity_dependent_restitution"};
  options.execution.threads = 2;
  for (const int budget : {1600, 2600}) {  // named from 2800 on without it
    options.budget = budget;
    const Diagnosis d = diagnose(believed(), measurement, *engine, options);
    EXPECT_LE(d.runs_simulated, budget);
    EXPECT_EQ(d.missing, options.effects) << budget << ": " << d.sentence;
    EXPECT_EQ(d.hypotheses.front().effects, options.effects) << budget;
  }
}

TEST(SlowDiagnosis, AnotherPackingIsAParameterNotAnEffect) {
  const Diagnosis d = diagnosis_of({{}, {{"release.packing", "random"}}});
  EXPECT_EQ(d.verdict, Verdict::refit) << d.sentence;
  EXPECT_TRUE(d.missing.empty());
  ASSERT_FALSE(d.parameters.empty());
  EXPECT_EQ(d.parameters.front().name, "release.packing");
  EXPECT_EQ(d.parameters.front().word, "random");
}

TEST(SlowDiagnosis, ForcesInNoListAreUnknownAndAFormulaIsOffered) {
  const Diagnosis d = diagnosis_of({{"user_force=force:\"-c*v*exp(-((x-x0)/w)^2)\",constants.c:0.8 N "
                                     "s/m,constants.x0:45mm,constants.w:12mm"},
                                    {},
                                    {},
                                    {0.040, 0.065}});
  EXPECT_EQ(d.verdict, Verdict::unknown) << d.sentence;
  EXPECT_NE(d.force_formula.find("user_force"), std::string::npos);
  ASSERT_FALSE(d.next_experiments.empty());
  EXPECT_NE(d.next_experiments.front().find("alone"), std::string::npos);
}

// Restitution that rises with the speed is in no list, and nothing that is asked for explains it.
TEST(SlowDiagnosis, WhatLiesInTheContactsIsOfferedAsACurve) {
  const Diagnosis d = diagnosis_of(
      {{"user_restitution=restitution:\"0.85-0.35*exp(-v/0.15)\""}, {}, {}, {0.040, 0.065}, 5, "8 s"},
      {"user_restitution", "blade_viscous_damping"});
  EXPECT_EQ(d.verdict, Verdict::unknown) << d.sentence;
  EXPECT_TRUE(d.missing.empty());
  ASSERT_TRUE(d.free_restitution) << d.sentence;
  const FreeRestitution& found = *d.free_restitution;
  // One film of chaos, which is another on each kind of processor (sines by their libraries differ in the
  // last digit): on one the curve left less than half, on another 0.86 mm of 1.25 beside a floor of 0.36.
  EXPECT_LT(found.with.error_box, found.without.error_box);
  EXPECT_LT(found.with.error_box, rules::explains * found.with.floor_box);
  EXPECT_LT(found.curve.grains.value.front(), found.curve.grains.value.back() - 0.1);
  EXPECT_NE(d.sentence.find("it rises from"), std::string::npos) << d.sentence;
  EXPECT_NE(diagnosis_text(d).find("name = \"user_restitution\""), std::string::npos);
  EXPECT_NE(diagnosis_json(d).find("\"restitution_curve\""), std::string::npos);
  EXPECT_TRUE(violations_of(found.setup).empty());
}

/// The hard engine, but for formulas.
class NoFormulas final : public Engine {
 public:
  std::string_view name() const override { return hard_->name(); }
  Capability can_model(const EffectRecord& effect) const override { return hard_->can_model(effect); }
  Trajectory run(const shakedown::Setup& setup, const RunOptions& options) const override {
    for (const EffectChoice& effect : setup.effects)
      if (effect.record->name == "user_force") throw PhysicsError("energy and losses do not balance");
    return hard_->run(setup, options);
  }

 private:
  std::unique_ptr<Engine> hard_ = engine_named("hard");
};

// What the balance writes may have corners or push the box ever further: that is no reason to say nothing.
TEST(SlowDiagnosis, AFormulaThatCannotBeSimulatedEndsNoDiagnosis) {
  const Measurement measurement = as_measured(
      measured({{"user_force=force:\"-c*v*exp(-((x-x0)/w)^2)\",constants.c:0.8 N s/m,constants.x0:45mm,"
                 "constants.w:12mm"},
                {},
                {},
                {0.040, 0.065}}));
  DiagnoseOptions options;
  options.known = all_effects();
  options.execution.threads = 2;
  options.budget = 1500;
  const Diagnosis d = diagnose(believed(), measurement, NoFormulas(), options);
  EXPECT_EQ(d.verdict, Verdict::unknown) << d.sentence;
  EXPECT_TRUE(std::any_of(d.notes.begin(), d.notes.end(), [](const std::string& note) {
    return note.find("cannot be simulated") != std::string::npos;
  }));
}

// The strength that the balance finds is that at the setup's own reference.
TEST(SlowDiagnosis, ACubicSpringThatTheSetupHasKeepsItsReference) {
  const std::vector<Override> half_there{{"spring_cubic.coefficient", "0.01"},
                                         {"spring_cubic.reference", "\"53.75 mm\""}};
  const shakedown::Setup setup = parse_setup("", "believed", all_effects(), half_there);
  const Experiment experiment = measured({{"spring_cubic=coefficient:0.08"}});  // 0.02 at 53.75 mm
  const MomentumAudit found = audit_momentum(as_measured(experiment, setup), all_effects());
  ASSERT_EQ(found.terms.size(), 1u);
  EXPECT_EQ(found.terms[0].effect, "spring_cubic");
  EXPECT_LT(found.terms[0].low, 0.02);
  EXPECT_GT(found.terms[0].high, 0.02);
  EXPECT_LT(found.terms[0].high, 0.03);  // 0.08 at the release
}

TEST(SlowDiagnosis, AStrengthThatTheSetupHasIsRefittedAndNotMissing) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  DiagnoseOptions options;
  options.known = all_effects();
  const std::vector<Override> too_much{{"blade_viscous_damping.damping", "\"0.08 N s/m\""}};
  const shakedown::Setup setup =
      parse_setup("[run]\nduration = \"5 s\"\n", "believed", all_effects(), too_much);
  const Diagnosis d = diagnose(
      setup, as_measured(measured({{"blade_viscous_damping=damping:0.03 N s/m"}}), setup), *engine, options);
  EXPECT_EQ(d.verdict, Verdict::refit) << d.sentence;
  EXPECT_TRUE(d.missing.empty());
  const auto damping = std::find_if(d.parameters.begin(), d.parameters.end(), [](const auto& parameter) {
    return parameter.name == "blade_viscous_damping.damping";
  });
  ASSERT_NE(damping, d.parameters.end());
  EXPECT_LT(damping->low, 0.03);
  EXPECT_GT(damping->high, 0.03);
  EXPECT_LT(damping->high, 0.05);
}

TEST(SlowDiagnosis, ABalanceWithDryFrictionInTheSetupHoldsThoughTheBoxSticks) {
  const Experiment experiment = measured({{"clamp_dry_friction=force:20 mN"}});
  shakedown::Setup amended = believed();
  set_number(amended, "clamp_dry_friction.force", 0.02, all_effects());
  EXPECT_LT(audit_momentum(as_measured(experiment), all_effects()).as_given.p_value, 1e-6);
  EXPECT_GT(audit_momentum(as_measured(experiment, amended), all_effects()).as_given.p_value, 0.01);
}

TEST(SlowDiagnosis, OtherRestitutionsAreARefitThatCoversThem) {
  const Diagnosis d = diagnosis_of({{},
                                    {{"restitution.grain_grain", "0.6"}, {"restitution.grain_wall", "0.7"}},
                                    {},
                                    {0.040, 0.065, 0.104}});
  EXPECT_EQ(d.verdict, Verdict::refit) << d.sentence;
  for (const DiagnosedParameter& p : d.parameters) {
    const bool of_grains = p.name == "restitution.grain_grain", of_walls = p.name == "restitution.grain_wall";
    const double truth = of_grains ? 0.6 : of_walls ? 0.7 : 1.23;
    EXPECT_LE(p.low, truth) << p.name;
    EXPECT_GE(p.high, truth) << p.name;
    EXPECT_LT(error_of(p), 2 * (of_grains ? 0.1 : of_walls ? 0.12 : 3.5e-4)) << p.name;  // seen, twice
  }
  EXPECT_LT(d.ladder.back().error_box, d.ladder.front().error_box);
}

TEST(SlowDiagnosis, FindsAForceOnTheBoxAndTheErrorFalls) {
  const Diagnosis d = diagnosis_of({{"blade_viscous_damping=damping:0.08 N s/m"}});
  EXPECT_EQ(d.missing, std::vector<std::string>{"blade_viscous_damping"}) << d.sentence;
  EXPECT_LT(d.ladder.back().error_box, d.ladder.front().error_box / 2);
  EXPECT_FALSE(d.where.empty());
  // The amended setup is a setup, with the effect at a strength that covers the truth.
  const shakedown::Setup amended = parse_setup(write_setup(d.amended), "amended", all_effects());
  WITHIN(get_number(amended, "blade_viscous_damping.damping", all_effects()), 0.08, 2e-3, 3.7e-4);
  // The ensembles do not bend what the balance knows better.
  ASSERT_EQ(d.momentum.terms.size(), 1u);
  const FoundTerm& balance = d.momentum.terms.front();
  // What the balance finds without a simulation stands in the ranking too.
  ASSERT_FALSE(d.ranking.empty());
  EXPECT_EQ(d.ranking.front().effect, balance.effect);
  EXPECT_EQ(d.ranking.front().gain, balance.gain);
  EXPECT_TRUE(d.ranking.front().by_balance);
  const auto damping =
      std::find_if(d.parameters.begin(), d.parameters.end(),
                   [](const DiagnosedParameter& p) { return p.name == "blade_viscous_damping.damping"; });
  ASSERT_NE(damping, d.parameters.end());
  EXPECT_LT(damping->high - damping->low,
            3 * (balance.high - balance.low));  // seen: 2.0; by themselves 5 to 10
  EXPECT_LE(damping->low, 0.08);
  EXPECT_GE(damping->high, 0.08);
}

TEST(SlowDiagnosis, WhatTheBalanceCannotTellApartIsSaid) {
  const Diagnosis d =
      diagnosis_of({{"blade_viscous_damping=damping:0.0009 N s/m"}, {}, {}, {0.040, 0.040}},
                   {"blade_viscous_damping", "blade_quadratic_drag", "clamp_dry_friction"}, 2, {}, true);
  std::set<std::string> in_question(d.missing.begin(), d.missing.end());
  for (const Hypothesis& answer : d.answers) in_question.insert(answer.effects.begin(), answer.effects.end());
  EXPECT_TRUE(in_question.contains("blade_viscous_damping")) << d.sentence;
  EXPECT_GE(d.answers.size(), 2u) << d.sentence;
  const std::vector<std::string> ties = ties_of(d.answers);
  const bool others =
      std::any_of(ties.begin(), ties.end(), [](const std::string& tie) { return tie != unlisted_effect; });
  EXPECT_EQ(d.sentence.find("do not rule out") != std::string::npos, others) << d.sentence;
}

// Restitutions of old grains hidden from the fit: the force is there, and not alone.
TEST(SlowDiagnosis, AModelThatIsStillRejectedIsSaidToBe) {
  const Diagnosis d =
      diagnosis_of({{"blade_viscous_damping=damping:0.08 N s/m"}, {{"restitution.grain_grain", "0.6"}}},
                   {"blade_viscous_damping"}, 2, {"restitution.grain_grain", "restitution.grain_wall"});
  EXPECT_EQ(d.missing, std::vector<std::string>{"blade_viscous_damping"}) << d.sentence;
  EXPECT_LE(d.ladder.back().p_value, 0.01);
  EXPECT_NE(d.sentence.find("still does not hold"), std::string::npos) << d.sentence;
}

TEST(SlowDiagnosis, FrictionOfGrainsAndOfWallsEachGetsItsOwnInterval) {
  const Diagnosis d =
      diagnosis_of({{"grain_friction=grain_grain:0.4,grain_wall:0.1"}, {}, {}, {0.040, 0.065, 0.104}},
                   {"grain_friction"}, 2, {"restitution.grain_grain", "restitution.grain_wall"});
  EXPECT_EQ(d.missing, std::vector<std::string>{"grain_friction"}) << d.sentence;
  int found = 0;
  for (const DiagnosedParameter& p : d.parameters) {
    if (p.name != "grain_friction.grain_grain" && p.name != "grain_friction.grain_wall") continue;
    const double truth = p.name == "grain_friction.grain_grain" ? 0.4 : 0.1;
    WITHIN_ERRORS(p.value, truth, 4, error_of(p), truth == 0.4 ? 0.1 : 0.043) << p.name;
    ++found;
  }
  EXPECT_EQ(found, 2);
  std::set<std::string> notes(d.notes.begin(), d.notes.end());
  EXPECT_EQ(notes.size(), d.notes.size());  // what holds for both is said once
}

// Of two seeds the refit leaves p = 0.07 and 0.08, for the restitutions take up most of it, and the effect
// brings 71 and 65 of chi2.
TEST(SlowDiagnosis, AnEffectIsFoundBesideAModelThatTheDataAccept) {
  const Diagnosis d = diagnosis_of(
      {{"velocity_dependent_restitution=exponent:0.05"}, {}, {}, {0.040, 0.065, 0.104}, 5, "8 s"}, {}, 2, {},
      true);
  EXPECT_EQ(d.missing, std::vector<std::string>{"velocity_dependent_restitution"}) << d.sentence;
  const auto exponent = std::find_if(
      d.parameters.begin(), d.parameters.end(),
      [](const DiagnosedParameter& p) { return p.name == "velocity_dependent_restitution.exponent"; });
  ASSERT_NE(exponent, d.parameters.end());
  // One interval of 95 % in twenty misses the truth, by little.
  const double wide = exponent->high - exponent->low;
  EXPECT_LE(exponent->low, 0.05 + 0.1 * wide);
  EXPECT_GE(exponent->high, 0.05 - 0.1 * wide);
  EXPECT_LT(wide, 0.07);  // 0.063 in a build under sanitizers, whose chaos takes another course
}

// Charged grains keep apart, and hardly damp. The arc of a short blade takes up a part of that and leaves
// four times the noise: it is no explanation, and none of it stays in the model.
TEST(SlowDiagnosis, WhatLeavesErrorsFarAboveTheNoiseIsNoExplanation) {
  const Experiment experiment = read_experiment(std::string(TEST_DATA) + "/charged_grains/experiment.toml");
  const std::unique_ptr<Engine> engine = engine_named("hard");
  DiagnoseOptions options;
  options.effects = {"blade_arc"};
  options.known = all_effects();
  options.execution.threads = 2;
  options.fixed = {"restitution.grain_grain", "restitution.grain_wall"};
  const Diagnosis d = diagnose(believed("5 s"), as_measured(experiment, believed("5 s")), *engine, options);
  EXPECT_EQ(d.verdict, Verdict::unknown) << d.sentence;
  EXPECT_TRUE(d.missing.empty());
  EXPECT_TRUE(d.amended.effects.empty());
  // What was tried is shown, and the errors told are those of the answer, without it.
  ASSERT_EQ(d.ladder.size(), 4u);
  EXPECT_EQ(d.ladder[2].step, "refitted + blade_arc");
  EXPECT_LT(d.ladder[2].scatter, 0.8 * d.ladder[1].scatter);  // seen: 0.72
  EXPECT_EQ(d.ladder.back().step, "refitted, the rest taken back");
  EXPECT_EQ(d.ladder.back().error_box, d.ladder[1].error_box);
}

TEST(SlowDiagnosis, TheAnswerDoesNotDependOnTheThreads) {
  const Hidden hidden{{}, {{"restitution.grain_grain", "0.6"}}};
  Diagnosis one = diagnosis_of(hidden, {"grain_friction"}, 1),
            three = diagnosis_of(hidden, {"grain_friction"}, 3);
  one.seconds = three.seconds = 0;
  EXPECT_EQ(diagnosis_json(one), diagnosis_json(three));
}

TEST(SlowDiagnosis, MeasurementsWithoutTheGrainsCentreConvictNobody) {
  RecordingSettings no_centre;
  no_centre.centre = false;
  const Diagnosis d = diagnosis_of({{}, {}, no_centre});
  EXPECT_TRUE(d.missing.empty()) << d.sentence;
  EXPECT_FALSE(d.momentum.possible);
}

}  // namespace
