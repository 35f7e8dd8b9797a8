// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "effects.hpp"
#include "physics.hpp"
#include "setup_file.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

struct Moments {
  double mean = 0, deviation = 0, fourth = 0;
};

/// Over speeds that are a rounding apart.
Moments moments(const Physics& physics, ContactClass kind, int count = 200000) {
  double speed = 0.3, sum = 0, squares = 0, fourths = 0;
  const double mean = physics.contact.restitution[static_cast<std::size_t>(kind)];
  for (int i = 0; i < count; ++i, speed = std::nextafter(speed, 1.0)) {
    const double off = physics.contact.restitution_at(kind, speed) - mean;
    sum += off, squares += off * off, fourths += off * off * off * off;
  }
  const double variance = squares / count;
  return {mean + sum / count, std::sqrt(variance), fourths / count / (variance * variance)};
}

Physics physics_with(const std::string& deviation, const std::string& restitution = "0.75") {
  const std::vector<Override> overrides{{"fluctuating_restitution.deviation", deviation},
                                        {"restitution.grain_grain", restitution}};
  return physics_of(parse_setup("", "s", all_effects(), overrides));
}

}  // namespace

TEST(FluctuatingRestitution, IsNormalAboutTheSetupsValue) {
  const Moments seen = moments(physics_with("0.05"), ContactClass::grain_grain);
  // Standard errors of 200000.
  WITHIN(seen.mean, 0.75, 5e-4, 1.1e-4);
  WITHIN(seen.deviation, 0.05, 4e-4, 8e-5);
  WITHIN(seen.fourth, 3, 0.05, 0.011);
}

TEST(FluctuatingRestitution, StaysBetweenNothingAndElastic) {
  const Physics physics = physics_with("0.3", "0.9");
  double speed = 0.3;
  for (int i = 0; i < 10000; ++i, speed = std::nextafter(speed, 1.0)) {
    const double restitution = physics.contact.restitution_at(ContactClass::grain_grain, speed);
    ASSERT_GE(restitution, 0);
    ASSERT_LE(restitution, 1);
  }
  // Half the draws lie above 0.9; one third of a deviation above it they are cut: E of the cut normal.
  const double z = 1.0 / 3, beyond = 0.5 * std::erfc(z / std::sqrt(2)),
               density = std::exp(-z * z / 2) / std::sqrt(2 * M_PI), low = 3;
  const double cut = 0.3 * (density - z * beyond),
               raised = 0.3 * (std::exp(-low * low / 2) / std::sqrt(2 * M_PI) -
                               low * 0.5 * std::erfc(low / std::sqrt(2)));
  WITHIN(moments(physics, ContactClass::grain_grain).mean, 0.9 - cut + raised, 2e-3, 4e-4);  // standard error
}

TEST(FluctuatingRestitution, IsTheSameForTheSameImpactAndAnotherForWallAndGrain) {
  const Physics physics = physics_with("0.05"), again = physics_with("0.05");
  const auto at = [](const Physics& one, ContactClass kind, double speed) {
    return one.contact.restitution_at(kind, speed) - one.contact.restitution[static_cast<std::size_t>(kind)];
  };
  EXPECT_EQ(at(physics, ContactClass::grain_grain, 0.4), at(again, ContactClass::grain_grain, 0.4));
  EXPECT_NE(at(physics, ContactClass::grain_grain, 0.4), at(physics, ContactClass::end_wall, 0.4));
}
