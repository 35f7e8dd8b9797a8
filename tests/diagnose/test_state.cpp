// SPDX-License-Identifier: MIT
// What a fit tells of an effect's strength.
#include <gtest/gtest.h>

#include "effects.hpp"
#include "engines.hpp"
#include "hidden_measurements.hpp"
#include "parameter_knobs.hpp"
#include "rival.hpp"
#include "setup_file.hpp"
#include "state.hpp"

using namespace shakedown;

namespace {

/// Two strengths of one effect and one whose absence is another parameter, which goes with it.
Refit fitted() {
  Refit fit;
  const auto add = [&](const std::string& key, double value, double error, const std::string& absent_key) {
    Knob knob;
    knob.key = key;
    knob.absent_key = absent_key;
    fit.knobs.push_back(knob);
    fit.values.push_back({key, value, 0, 0, error, false});
  };
  add("grain_friction.grain_grain", 0.1, 0.2, "");
  add("grain_friction.grain_wall", 0.3, 0.1, "");
  add("restitution.grain_wall", 0.75, 0.1, "");
  add("side_wall_restitution.restitution", 0.65, 0.1, "restitution.grain_wall");
  fit.covariance = Eigen::Vector4d(0.04, 0.01, 0.01, 0.01).asDiagonal();
  fit.covariance(2, 3) = fit.covariance(3, 2) = 0.008;
  return fit;
}

}  // namespace

TEST(Told, ByAnyOfAnEffectsStrengths) {
  EXPECT_TRUE(is_told(fitted(), "grain_friction", 2.9));
  EXPECT_FALSE(is_told(fitted(), "grain_friction", 3.1));
  EXPECT_FALSE(is_told(fitted(), "grain_cohesion", 0));
}

// The difference of the two is known better than either: 0.1 by sqrt(0.004).
TEST(Told, FromWhereItsAbsenceIs) {
  EXPECT_TRUE(is_told(fitted(), "side_wall_restitution", 1.5));
  EXPECT_FALSE(is_told(fitted(), "side_wall_restitution", 1.7));
}

TEST(HardlyTold, OneOfTwoThatWereAddedAtOnceMayBeNothing) {
  DiagnosisState state;
  state.fit = fitted();
  state.missing = {"grain_friction", "side_wall_restitution"};  // by 3 and by 1.6 standard errors
  using Names = std::vector<std::string>;
  EXPECT_EQ(hardly_told(state, {}, 2), Names{"side_wall_restitution"});
  EXPECT_EQ(hardly_told(state, {}, 1), Names{});  // weighed by itself
  EXPECT_EQ(hardly_told(state, {"side_wall_restitution"}, 2), Names{});
  state.missing = {"side_wall_restitution", "grain_cohesion"};  // of which the fit says nothing
  EXPECT_EQ(hardly_told(state, {}, 2), (Names{"grain_cohesion", "side_wall_restitution"}));
  EXPECT_EQ(hardly_told(state, {}, 1), Names{"side_wall_restitution"});
}

namespace {

DiagnosisState at_restitutions(double grains, double walls, double p_value, double scatter) {
  DiagnosisState state;
  state.theta = state.before_fits = free_parameters(shakedown::Setup{});
  state.theta[0].centre = grains, state.theta[1].centre = walls;
  state.fit.p_value = p_value, state.fit.scatter = scatter;
  return state;
}

}  // namespace

TEST(LedAstray, IsAPoorModelFarFromWhatIsBelieved) {
  EXPECT_TRUE(is_led_astray(at_restitutions(0.345, 0.999, 0.0025, 6)));
  EXPECT_TRUE(is_led_astray(at_restitutions(0.75, 0.97, 0.0025, 6)));  // believed: 0.76 +- 0.1
  EXPECT_FALSE(is_led_astray(at_restitutions(0.75, 0.95, 0.0025, 6)));
  EXPECT_FALSE(is_led_astray(at_restitutions(0.345, 0.999, 0.2, 1)));  // the data accept it
  // An effect of signal 8 makes 64 of chi2: a tenth of what 650 features have.
  EXPECT_TRUE(is_led_astray(at_restitutions(0.96, 0.42, 0.0025, 1.18)));
  EXPECT_TRUE(is_led_astray(at_restitutions(0.96, 0.42, 0.03, 1.18)));
  EXPECT_FALSE(is_led_astray(at_restitutions(0.96, 0.42, 0.06, 1.18)));
}

TEST(LedAstray, GoesBackToWhatWasBelieved) {
  const DiagnosisState back = as_believed(at_restitutions(0.345, 0.999, 0.0025, 6));
  EXPECT_EQ(back.theta[0].centre, 0.75);
  EXPECT_EQ(back.theta[1].centre, 0.76);
  for (std::size_t k = 0; k < back.theta.size(); ++k)
    EXPECT_LT(back.theta[k].width, back.before_fits[k].width);
}

// A misfit of 2 rejects a model, and not one with an effect that two codes make so differently.
TEST(Rejected, LessEasilyWhereCodesDiffer) {
  Refit fit;
  fit.p_value = 0.0025, fit.scatter = 2;
  EXPECT_TRUE(is_rejected(fit));
  fit.codes_differ = 2.5;
  EXPECT_FALSE(is_rejected(fit));
  EXPECT_EQ(fit.test().undecided_below, 2.5);
}

// Where a fit begins: what shapes an effect must be there from the start, though setups forget effects at no
// strength.
TEST(Rivals, BeginWithTheShapeOfTheirCandidate) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const Experiment experiment = measured({{}, {}, {}, {0.104}});
  const Measurement measurement = as_measured(experiment);
  DiagnoseOptions options;
  options.known = all_effects();
  DiagnosisTools tools(measurement, *engine, options);
  const std::vector<Candidate> candidates =
      candidates_for(believed(), {"grain_cohesion"}, all_effects(), *engine);
  for (const Candidate& candidate : candidates) {
    Rival rival{&candidate, {}};
    rival.screened.value = candidate.levels.front().value;
    DiagnosisState before;
    before.setup = believed();
    const DiagnosisState state = with_rival(before, rival, tools);
    for (const MeasuredFeatures& measured : tools.features(state.setup))
      for (const auto& [key, value] : candidate.fixed)
        EXPECT_EQ(get_number(measured.setup, key, all_effects()), value) << key;
  }
}
