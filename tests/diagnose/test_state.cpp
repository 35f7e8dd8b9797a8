// SPDX-License-Identifier: MIT
// What a fit tells of an effect's strength.
#include <gtest/gtest.h>

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
