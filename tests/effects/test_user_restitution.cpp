// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "effects.hpp"
#include "formula.hpp"
#include "physics.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

std::string setup_text(const std::string& restitution, const std::string& rest = "") {
  return "[[effect]]\nname = \"user_restitution\"\nrestitution = \"" + restitution + "\"\n" + rest;
}

ContactLaw law_of(const std::string& restitution, const std::string& rest = "") {
  return physics_of(parse_setup(setup_text(restitution, rest), "s", all_effects())).contact;
}

std::string complaint(const std::string& restitution, const std::string& rest = "") {
  try {
    parse_setup(setup_text(restitution, rest), "s.toml", all_effects());
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST(UserRestitution, IsAFormulaOfSpeedAndOfTheSetupsValue) {
  const ContactLaw law = law_of("1-(1-e)*(v/v0)^0.2", "constants = {v0 = \"30 cm/s\"}\n");
  EXPECT_DOUBLE_EQ(law.restitution_of(ContactClass::grain_grain, 0.3), 0.75);
  EXPECT_DOUBLE_EQ(law.restitution_of(ContactClass::end_wall, 0.1), 1 - 0.24 * std::pow(0.1 / 0.3, 0.2));
  EXPECT_DOUBLE_EQ(law.restitution_of(ContactClass::side_wall, 0), 1);
}

TEST(UserRestitution, IsKeptBetweenNoneAndOne) {
  const ContactLaw law = law_of("1.2-2*v");
  EXPECT_EQ(law.restitution_of(ContactClass::grain_grain, 0.01), 1);
  EXPECT_EQ(law.restitution_of(ContactClass::grain_grain, 0.7), 0);
  EXPECT_DOUBLE_EQ(law.restitution_of(ContactClass::grain_grain, 0.3), 0.6);
}

TEST(UserRestitution, IsOfTheContactsThatItIsSaidToBeOf) {
  const ContactLaw grains = law_of("0.5", "on = \"grains\"\n"), walls = law_of("0.5", "on = \"walls\"\n");
  EXPECT_EQ(grains.restitution_of(ContactClass::grain_grain, 1), 0.5);
  EXPECT_EQ(grains.restitution_of(ContactClass::end_wall, 1), 0.76);
  EXPECT_EQ(grains.restitution_of(ContactClass::side_wall, 1), 0.76);
  EXPECT_EQ(walls.restitution_of(ContactClass::grain_grain, 1), 0.75);
  EXPECT_EQ(walls.restitution_of(ContactClass::end_wall, 1), 0.5);
  EXPECT_EQ(walls.restitution_of(ContactClass::side_wall, 1), 0.5);
}

TEST(UserRestitution, GoesThroughThePointsOfACurve) {
  const ContactLaw law = law_of("e*curve(ln(v/0.1), -2, a, 0, 1, 2, b)", "constants = {a = 1.2, b = 0.8}\n");
  EXPECT_DOUBLE_EQ(law.restitution_of(ContactClass::grain_grain, 0.1), 0.75);
  EXPECT_DOUBLE_EQ(law.restitution_of(ContactClass::grain_grain, 0.1 * std::exp(2.0)), 0.6);
  EXPECT_DOUBLE_EQ(law.restitution_of(ContactClass::grain_grain, 0), 0.9);
}

TEST(UserRestitution, SaysWhatIsWrongWithAFormula) {
  EXPECT_EQ(
      complaint("e*x"),
      "s.toml:3:15: user_restitution.restitution: \"e*x\" cannot be read at character 3 of the formula "
      "('x' is neither v, e, a constant nor a function); use v (m/s), e (the setup's restitution of the "
      "contact), the names in constants, + - * / ^, and functions such as abs, sin, exp, sqrt, min, max, "
      "curve");
  EXPECT_NE(complaint("e*ln(v)").find("is not a finite number at v = 0 m/s"), std::string::npos);
  EXPECT_NE(complaint("e*curve(v, 1, 1)").find("two points or more"), std::string::npos);
  EXPECT_NE(complaint("e*curve(v, 0, 1, 0, 2)").find("must ascend"), std::string::npos)
      << complaint("e*curve(v, 0, 1, 0, 2)");
  EXPECT_NE(complaint("e*curve(v, v-v, 1, v, 2)").find("must ascend"), std::string::npos);
  EXPECT_NE(complaint("e", "constants = {e = 3}\n").find("has the name of a variable"), std::string::npos);
}

TEST(FormulaConstants, AreNumbersOfTheSetup) {
  auto setup = parse_setup(setup_text("e*a", "constants = {a = 0.9, b = 2}\n"), "s", all_effects());
  EXPECT_EQ(get_number(setup, "user_restitution.constants.a", all_effects()), 0.9);
  set_number(setup, "user_restitution.constants.a", 0.8, all_effects());
  EXPECT_DOUBLE_EQ(physics_of(setup).contact.restitution_of(ContactClass::grain_grain, 1), 0.6);
  EXPECT_EQ(get_number(setup, "user_restitution.constants.b", all_effects()), 2);
  const auto refused = [&](const shakedown::Setup& of, const std::string& key) -> std::string {
    try {
      get_number(of, key, all_effects());
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refused(setup, "user_restitution.constants.c"),
            "user_restitution.constants.c: is no constant that the setup gives this formula; it has a, b");
  EXPECT_NE(refused({}, "user_force.constants.c").find("give it in the setup"), std::string::npos);
  EXPECT_NE(refused(setup, "user_restitution.constants").find("is not a numeric key"), std::string::npos);
}
