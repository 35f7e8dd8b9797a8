// SPDX-License-Identifier: MIT
#include "contact_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "distributions.hpp"
#include "effects.hpp"
#include "errors.hpp"
#include "fit.hpp"
#include "free_parameters.hpp"
#include "physics.hpp"
#include "setup_file.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr const char* fall_1 = "user_restitution.constants.fall_1";
constexpr const char* fall_3 = "user_restitution.constants.fall_3";

shakedown::Setup with_curve(const std::string& contacts = "all") {
  return with_contact_curve(restitution_against_speed(), {}, contacts, all_effects());
}

double restitution(const shakedown::Setup& setup, double speed,
                   ContactClass kind = ContactClass::grain_grain) {
  return physics_of(setup).contact.restitution_of(kind, speed);
}

FittedValue value(const std::string& key, double at, double error = 0.1) {
  return {key, at, at - normal_95 * error, at + normal_95 * error, error, false};
}

}  // namespace

TEST(ContactCurve, ReachesOverTheSpeedsOfTheDamper) {
  const std::vector<double> speeds = speeds_of_curve({});
  const double top = 2 * std::numbers::pi * 1.23 * 0.1075;
  ASSERT_EQ(speeds.size(), 5u);
  EXPECT_DOUBLE_EQ(speeds.front(), 0.032 * top);
  EXPECT_DOUBLE_EQ(speeds.back(), 1.25 * top);
  shakedown::Setup empty, held;
  empty.grains.count = 0;
  held.release.displacement = 0;
  EXPECT_THROW(speeds_of_curve(empty), InputError);
  EXPECT_THROW(speeds_of_curve(held), InputError);
}

TEST(ContactCurve, BeginsLevel) {
  for (const double speed : {0.0, 0.02, 0.3, 1.0, 5.0}) {
    EXPECT_DOUBLE_EQ(restitution(with_curve(), speed), 0.75);
    EXPECT_DOUBLE_EQ(restitution(with_curve("walls"), speed, ContactClass::end_wall), 0.76);
  }
  EXPECT_THROW(with_curve("floors"), InputError);
}

TEST(ContactCurve, FallsFromOnePointToTheNext) {
  shakedown::Setup setup = with_curve();
  const std::vector<double> speeds = speeds_of_curve(setup);
  set_number(setup, fall_1, 0.1, all_effects());
  set_number(setup, fall_3, 0.2, all_effects());
  // Speeds stand in the formula with four digits.
  const double expected[] = {1.3, 1.2, 1.2, 1.0, 1.0};
  for (std::size_t i = 0; i < speeds.size(); ++i)
    WITHIN(restitution(setup, speeds[i]), 0.75 * expected[i], 2e-4, 1.5e-5) << i;
}

TEST(ContactCurve, TakesThePlaceOfAnotherLawOfRestitution) {
  const auto viscoelastic = parse_setup(
      "[[effect]]\nname = \"velocity_dependent_restitution\"\n[[effect]]\nname = "
      "\"grain_friction\"\ngrain_grain = "
      "0.2\n",
      "s", all_effects());
  const shakedown::Setup setup =
      with_contact_curve(restitution_against_speed(), viscoelastic, "grains", all_effects());
  ASSERT_EQ(setup.effects.size(), 2u);
  EXPECT_EQ(setup.effects[0].record->name, "grain_friction");
  EXPECT_EQ(setup.effects[1].record->name, "user_restitution");
  EXPECT_TRUE(curve_as_toml(restitution_against_speed(), setup)
                  .starts_with("[[effect]]\nname = \"user_restitution\"\n"));
  EXPECT_EQ(curve_as_toml(restitution_against_speed(), viscoelastic), "");
}

TEST(ContactCurve, IsHeldToTheSideToWhichItGoesMore) {
  const std::vector<Knob> knobs = knobs_of_curve(restitution_against_speed(), with_curve(), all_effects());
  ASSERT_EQ(knobs.size(), 4u);
  const std::vector<Knob> falling =
      held_to_one_side(restitution_against_speed(), knobs, {value(fall_1, -0.05), value(fall_3, 0.2)},
                       all_effects())
          .value();
  for (const Knob& knob : falling) EXPECT_EQ(knob.low, 0) << knob.key;
  EXPECT_EQ(falling[0].centre, 0);
  EXPECT_EQ(falling[2].centre, 0.2);
  const std::vector<Knob> rising = held_to_one_side(restitution_against_speed(), knobs,
                                                    {value(fall_1, -0.3), value(fall_3, 0.2)}, all_effects())
                                       .value();
  for (const Knob& knob : rising) EXPECT_EQ(knob.high, 0) << knob.key;
  EXPECT_FALSE(held_to_one_side(restitution_against_speed(), knobs, {value(fall_1, 0.3), value(fall_3, 0.2)},
                                all_effects()));
}

TEST(ContactCurve, BandIsThatOfItsParametersAndOfWhatAStepBetweenPointsWouldMake) {
  const shakedown::Setup setup = with_curve();
  Eigen::Matrix2d covariance;
  covariance << 4e-4, -1e-4, -1e-4, 9e-4;
  const ContactCurve level = contact_curve(
      restitution_against_speed(), setup,
      {value("restitution.grain_grain", 0.75, 0.02), value("restitution.grain_wall", 0.76, 0.03)}, covariance,
      all_effects());
  for (std::size_t i = 0; i < level.speed.size(); ++i) {
    WITHIN(level.grains.error[i], 0.02, 3e-16, 1.8e-17);
    WITHIN(level.walls.error[i], 0.03, 4e-16, 2.5e-17);
    EXPECT_DOUBLE_EQ(level.low(level.grains, i), 0.75 - normal_95 * level.grains.error[i]);
  }
  EXPECT_EQ(words_of(level), "stays at 0.75 (grains), stays at 0.76 (walls)");
  shakedown::Setup falling = setup;
  set_number(falling, fall_1, 0.2, all_effects());
  const ContactCurve known = contact_curve(restitution_against_speed(), falling, {value(fall_1, 0.2, 0)},
                                           Eigen::MatrixXd::Zero(1, 1), all_effects());
  // Known at its points; half-way between the first two by a quarter of the step, which is 0.15.
  EXPECT_EQ(known.grains.error.front(), 0);
  WITHIN(*std::max_element(known.grains.error.begin(), known.grains.error.end()), 0.0375, 4e-4, 5.6e-5);
  EXPECT_EQ(words_of(known),
            "falls from 0.90 at 0.027 m/s to 0.75 at 1.038 m/s (grains), falls from 0.91 at "
            "0.027 m/s to 0.76 at 1.038 m/s (walls)");
}

TEST(ContactCurve, OfFrictionScalesTheSetupsCoefficient) {
  const CurveLaw& law = friction_against_slip();
  EXPECT_THROW(with_contact_curve(law, {}, "all", all_effects()), InputError);  // nothing to scale
  const auto rubbing = parse_setup(
      "[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.2\ngrain_wall = 0.4\n", "s", all_effects());
  shakedown::Setup setup = with_contact_curve(law, rubbing, "all", all_effects());
  ASSERT_EQ(setup.effects.size(), 2u);  // the curve stands beside the coefficient
  const std::vector<Knob> knobs = knobs_of_curve(law, setup, all_effects());
  ASSERT_EQ(knobs.size(), 4u);
  EXPECT_EQ(knobs[0].key, "user_friction.constants.fall_1");
  EXPECT_EQ(knobs[0].believed_error, law.believed);
  for (const Knob& knob : knobs) set_number(setup, knob.key, 0.5, all_effects());
  const std::vector<double> speeds = speeds_of_curve(setup);
  const double expected[] = {2.5, 2, 1.5, 1, 0.5};
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const ContactLaw contact = physics_of(setup).contact;
    WITHIN(law.of(contact, ContactClass::grain_grain, speeds[i]), 0.2 * expected[i], 2e-4, 4.5e-5) << i;
    WITHIN(law.of(contact, ContactClass::side_wall, speeds[i]), 0.4 * expected[i], 4e-4, 9e-5) << i;
  }
}

TEST(ContactCurve, IsToldBesideAConstantByTheSameTest) {
  Fit fit;
  EXPECT_EQ(words_of_constant(fit), "");
  fit.curves.emplace_back().law = &friction_against_slip();
  const auto told = [&](Standing constant, Standing curve) {
    fit.constant = {0.004, 1.53, constant, curve};
    return words_of_constant(fit);
  };
  EXPECT_EQ(told(Standing::holds, Standing::holds),
            "the measurements do not tell whether friction depends on the slip speed: a constant holds too "
            "(1.53 times the misfit of its own runs, p = 0.004)");
  EXPECT_EQ(told(Standing::holds, Standing::fails), told(Standing::holds, Standing::holds));
  EXPECT_NE(told(Standing::fails, Standing::holds).find("tell that friction depends on the slip speed: a"),
            std::string::npos);
  for (const Standing curve : {Standing::holds, Standing::undecided, Standing::fails})
    EXPECT_NE(told(Standing::undecided, curve).find("is undecided: a constant neither holds nor fails"),
              std::string::npos);
  EXPECT_NE(told(Standing::fails, Standing::undecided).find("is undecided: a constant fails"),
            std::string::npos);
  EXPECT_NE(told(Standing::fails, Standing::fails).find("more is missing than friction that depends"),
            std::string::npos);
}

TEST(ContactCurve, OfFrictionAsksWhetherItsContactsHaveAny) {
  const CurveLaw& law = friction_against_slip();
  const auto grains =
      parse_setup("[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.2\n", "s", all_effects());
  EXPECT_NO_THROW(with_contact_curve(law, grains, "grains", all_effects()));
  EXPECT_THROW(with_contact_curve(law, grains, "walls", all_effects()), InputError);
  const auto sides =
      parse_setup("[[effect]]\nname = \"side_wall_friction\"\ncoefficient = 0.2\n", "s", all_effects());
  EXPECT_NO_THROW(with_contact_curve(law, sides, "walls", all_effects()));
}

TEST(ContactCurve, AsksWhetherItsLevelIsFree) {
  const auto rubbing = parse_setup(
      "[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.2\ngrain_wall = 0.2\n[[effect]]\nname = "
      "\"clamp_dry_friction\"\nforce = \"10 mN\"\n",
      "s", all_effects());
  const CurveLaw& law = friction_against_slip();
  const shakedown::Setup setup = with_contact_curve(law, rubbing, "all", all_effects());
  const auto moves = [&](const std::string& keys) {
    return moves_the_level(law, setup, free_parameters(keys, setup, all_effects()), all_effects());
  };
  EXPECT_TRUE(moves("spring.frequency,grain_friction.grain_grain&grain_friction.grain_wall"));
  EXPECT_TRUE(moves("grain_friction.grain_wall"));
  EXPECT_FALSE(moves("restitution.grain_grain,clamp_dry_friction.force"));
}
