// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "effects.hpp"
#include "physics.hpp"
#include "scratch_folder.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

std::string frictional(const std::string& friction, const std::string& rest = "") {
  return "[[effect]]\nname = \"user_friction\"\nfriction = \"" + friction + "\"\n" + rest;
}

ContactLaw friction_law(const std::string& friction, const std::string& rest = "") {
  return physics_of(parse_setup(frictional(friction, rest), "s", all_effects())).contact;
}

double coefficient(const ContactLaw& law, ContactClass kind, double slip) {
  return law.friction_of(kind, Vec3(0, 0.6 * slip, -0.8 * slip));
}

constexpr const char* constant =
    "[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.2\ngrain_wall = 0.3\n";

}  // namespace

TEST(UserFriction, IsAFormulaOfTheSlipAndOfTheSetupsCoefficient) {
  for (const std::string& text :
       {frictional("mu*(1+exp(-v/v0))/2", "constants = {v0 = \"10 cm/s\"}\n") + constant,
        constant + frictional("mu*(1+exp(-v/v0))/2", "constants = {v0 = 0.1}\n")}) {
    const ContactLaw law = physics_of(parse_setup(text, "s", all_effects())).contact;
    EXPECT_DOUBLE_EQ(coefficient(law, ContactClass::grain_grain, 0), 0.2);
    EXPECT_DOUBLE_EQ(coefficient(law, ContactClass::grain_grain, 0.1), 0.1 * (1 + std::exp(-1.0)));
    EXPECT_DOUBLE_EQ(coefficient(law, ContactClass::end_wall, 0.2), 0.15 * (1 + std::exp(-2.0)));
    EXPECT_DOUBLE_EQ(coefficient(law, ContactClass::side_wall, 0.2), 0.15 * (1 + std::exp(-2.0)));
  }
}

TEST(UserFriction, NeedsNoCoefficientBesideIt) {
  const ContactLaw law = friction_law("0.3-0.5*v");
  EXPECT_TRUE(law.has_friction());
  for (const ContactClass kind :
       {ContactClass::grain_grain, ContactClass::end_wall, ContactClass::side_wall}) {
    EXPECT_TRUE(law.rubs(kind));
    EXPECT_DOUBLE_EQ(coefficient(law, kind, 0.2), 0.2);
    EXPECT_EQ(coefficient(law, kind, 2), 0);  // never a push
  }
}

TEST(UserFriction, IsOfTheContactsThatItIsSaidToBeOf) {
  const ContactLaw grains = friction_law("0.5", std::string("on = \"grains\"\n") + constant),
                   walls = friction_law("0.5", std::string("on = \"walls\"\n") + constant);
  EXPECT_EQ(coefficient(grains, ContactClass::grain_grain, 1), 0.5);
  EXPECT_EQ(coefficient(grains, ContactClass::end_wall, 1), 0.3);
  EXPECT_EQ(coefficient(walls, ContactClass::grain_grain, 1), 0.2);
  EXPECT_EQ(coefficient(walls, ContactClass::side_wall, 1), 0.5);
}

TEST(UserFriction, TakesATable) {
  const ScratchFolder folder;
  std::ofstream(folder / "friction.csv") << "v,friction,error\n0.01,0.4,0.1\n1,0.1,0.1\n";
  const shakedown::Setup setup =
      parse_setup("[[effect]]\nname = \"user_friction\"\ntable = \"friction.csv\"\n", "s", all_effects(), {},
                  folder.path());
  const ContactLaw law = physics_of(setup).contact;
  EXPECT_DOUBLE_EQ(coefficient(law, ContactClass::grain_grain, 0.01), 0.4);
  EXPECT_DOUBLE_EQ(coefficient(law, ContactClass::end_wall, 2), 0.1);
}

TEST(UserFriction, NextToNothingIsNothing) {
  EXPECT_EQ(coefficient(friction_law("exp(-v/0.001)"), ContactClass::grain_grain, 0.5), 0);
}

TEST(UserFriction, SaysWhatIsWrongWithAFormula) {
  try {
    friction_law("mu*ln(v)");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is not a finite number at v = 0 m/s, mu = 0"),
              std::string::npos)
        << error.what();
  }
}
