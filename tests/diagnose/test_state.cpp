// SPDX-License-Identifier: MIT
// What a fit tells of an effect's strength.
#include <gtest/gtest.h>

#include "effects.hpp"
#include "engines.hpp"
#include "hidden_measurements.hpp"
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

// Where a fit begins: what shapes an effect must be there from the start, though setups forget effects at no
// strength.
TEST(Rivals, BeginWithTheShapeOfTheirCandidate) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const Experiment experiment = measured({{}, {}, {}, {0.104}});
  const Measurement measurement = measurement_of(believed(), experiment, all_effects());
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
