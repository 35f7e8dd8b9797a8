// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "effects.hpp"
#include "engine.hpp"
#include "formula.hpp"
#include "physics.hpp"
#include "setup_file.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

std::string setup_text(const std::string& force, const std::string& rest = "") {
  return "[[effect]]\nname = \"user_force\"\nforce = \"" + force + "\"\n" + rest;
}

std::string complaint(const std::string& force, const std::string& rest = "") {
  try {
    parse_setup(setup_text(force, rest), "s.toml", all_effects());
    return "";
  } catch (const InputError& error) {
    std::string text = error.what();
    return text.substr(0, text.find("; use x (m)"));
  }
}

class Stub : public Engine {
 public:
  explicit Stub(std::string_view name) : name_(name) {}
  std::string_view name() const override { return name_; }
  Capability can_model(const EffectRecord& effect) const override { return effect.capability(name_); }
  Trajectory run(const shakedown::Setup&, const RunOptions&) const override { return {}; }

 private:
  std::string_view name_;
};

}  // namespace

TEST(UserForce, EvaluatesTheFormulaInSi) {
  const auto setup =
      parse_setup(setup_text("-c*v*exp(-((x-x0)/w)^2)",
                             "constants = {c = \"0.4 N s/m\", x0 = \"45 mm\", w = \"1.2 cm\"}\n"),
                  "s", all_effects());
  const Physics physics = physics_of(setup);
  ASSERT_EQ(physics.box.free.size(), 1u);
  EXPECT_EQ(physics.box.free[0].effect, 0);
  EXPECT_DOUBLE_EQ(physics.box.free[0].newton(0.05, 0.7, 3),
                   -0.4 * 0.7 * std::exp(-std::pow(0.005 / 0.012, 2)));
}

TEST(UserForce, CallsFunctionsThatTheProgramLends) {
  EXPECT_NE(complaint("lent_here(x, v, t)").find("neither x, v, t, a constant nor a function"),
            std::string::npos);
  lend_function("lent_here", [](double x, double v, double t) { return x + 10 * v + 100 * t; });
  const auto setup =
      parse_setup(setup_text("2*lent_here(x, v, t)-k", "constants = {k = \"3 N\"}\n"), "s", all_effects());
  EXPECT_DOUBLE_EQ(physics_of(setup).box.free[0].newton(1, 2, 3), 2 * 321 - 3);
  EXPECT_DOUBLE_EQ(Formula("lent_here(1, 2, 3)", {})(0, 0, 0), 321);
  EXPECT_THROW(lend_function("lent_here", [](double, double, double) { return 0.0; }), FormulaProblem);
  EXPECT_THROW(lend_function("not a name", [](double, double, double) { return 0.0; }), FormulaProblem);
  lend_function("lent_broken", [](double, double, double) -> double { throw PhysicsError("out of order"); });
  EXPECT_NE(complaint("lent_broken(x, v, t)").find("out of order"), std::string::npos);
}

TEST(UserForce, ActsOnGrainsWhenAsked) {
  const Physics physics =
      physics_of(parse_setup(setup_text("0.01*sin(2*_pi*t)", "on = \"grains\"\n"), "s", all_effects()));
  ASSERT_EQ(physics.grains.free.size(), 1u);
  EXPECT_TRUE(physics.box.free.empty());
  WITHIN(physics.grains.free[0].newton(0, 0, 0.25), 0.01, 1e-17, 2.3e-18);
}

TEST(UserForce, ErrorsHaveTheirPlaceInTheFormula) {
  EXPECT_EQ(complaint("-c*v"),
            "s.toml:3:9: user_force.force: \"-c*v\" cannot be read at character 2 of the formula ('c' is "
            "neither x, v, t, a constant nor a function)");
  EXPECT_EQ(complaint("-spring*x", "constants = {sprig = 3}\n"),
            "s.toml:3:9: user_force.force: \"-spring*x\" cannot be read at character 2 of the formula "
            "('spring' is neither x, v, t, a constant nor a function; did you mean "
            "sprig?)");
  EXPECT_TRUE(complaint("-2*(v").starts_with(
      "s.toml:3:9: user_force.force: \"-2*(v\" cannot be read at character 6 of the formula"))
      << complaint("-2*(v");
  EXPECT_TRUE(complaint("").starts_with("s.toml:3:9: user_force.force: \"\" cannot be read"))
      << complaint("");
  EXPECT_TRUE(
      complaint("x=3").starts_with("s.toml:3:9: user_force.force: \"x=3\" cannot be read at character 2"))
      << complaint("x=3");
  EXPECT_TRUE(complaint("1,5*x").starts_with(
      "s.toml:3:9: user_force.force: \"1,5*x\" cannot be read (gives 2 values"))
      << complaint("1,5*x");
  EXPECT_TRUE(complaint("c*x", "constants = {c = \"3 wombats\"}\n").find("has the unknown unit 'wombats'") !=
              std::string::npos);
  EXPECT_TRUE(complaint("v*x", "constants = {v = 3}\n").find("has the name of a variable") !=
              std::string::npos);
  EXPECT_TRUE(complaint("2*a b*x", "constants = {\"a b\" = 3}\n").find("cannot be read") !=
              std::string::npos);
  for (const char* name : {"1c", "a b", "", "c-d"})
    EXPECT_NE(complaint("-0.1*v", "constants = {\"" + std::string(name) + "\" = 3}\n")
                  .find("the constant '" + std::string(name) + "' has a name"),
              std::string::npos)
        << complaint("-0.1*v", "constants = {\"" + std::string(name) + "\" = 3}\n");
  EXPECT_TRUE(
      complaint("v*sqr(x)").find("'sqr' is neither x, v, t, a constant nor a function; did you mean sqrt?") !=
      std::string::npos)
      << complaint("v*sqr(x)");
}

TEST(UserForce, ValuesThatAreNotFiniteAreFoundByProbing) {
  EXPECT_EQ(complaint("1/x"),
            "s.toml:3:9: user_force.force: is not a finite number at x = 0 m, v = 0 m/s, t = 0 s; write it "
            "so that it has a value for every x, v and t");
  EXPECT_NE(complaint("sqrt(v)"), "");
  EXPECT_NE(complaint("exp(x*1e5)"), "");
  EXPECT_EQ(complaint("sqrt(abs(v))"), "");
  const Physics physics = physics_of(parse_setup(setup_text("1/(x-0.0123)"), "s", all_effects()));
  EXPECT_THROW(physics.box.free[0].newton(0.0123, 0, 0), PhysicsError)
      << "what the probing missed is caught in the run";
}

TEST(UserForce, CopiesOfThePhysicsHaveTheirOwnParser) {
  const Physics physics = physics_of(parse_setup(setup_text("x + 10*v"), "s", all_effects()));
  const auto sum = [](Physics own, double x) {
    double wrong = 0;
    for (int i = 0; i < 20000; ++i) wrong += std::abs(own.box.free[0].newton(x, 1, 0) - (x + 10));
    return wrong;
  };
  double first = -1, second = -1;
  std::thread one([&, own = physics] { first = sum(own, 1); }),
      other([&, own = physics] { second = sum(own, 2); });
  one.join();
  other.join();
  EXPECT_EQ(first, 0);
  EXPECT_EQ(second, 0);
}

TEST(UserForce, TheHardEngineRefusesFormulasThatFollowAGrain) {
  const auto refused = [](std::string_view engine, const std::string& force, const std::string& on) {
    const auto setup = parse_setup(setup_text(force, "on = \"" + on + "\"\n"), "s.toml", all_effects());
    try {
      refuse_what_is_not_modelled(Stub(engine), setup);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refused("hard", "-v", "box"), "");
  EXPECT_EQ(refused("hard", "sin(t)", "grains"), "");
  EXPECT_EQ(refused("soft", "-v", "grains"), "");
  EXPECT_EQ(refused("hard", "-v", "grains"),
            "s.toml:2:8: user_force: is not modelled by engine 'hard'; on grains the hard engine takes "
            "formulas of t alone; use --engine soft");
}
