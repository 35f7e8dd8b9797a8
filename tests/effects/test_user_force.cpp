// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "effects.hpp"
#include "engine.hpp"
#include "formula.hpp"
#include "physics.hpp"
#include "scratch_folder.hpp"
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

namespace {

/// A table in a folder of its own.
struct Table {
  ScratchFolder folder;
  explicit Table(const std::string& text) { std::ofstream(folder.path() / "force.csv") << text; }
  shakedown::Setup setup(const std::string& more = "") const {
    return parse_setup("[[effect]]\nname = \"user_force\"\ntable = \"force.csv\"\n" + more, "s.toml",
                       all_effects(), {}, folder.path());
  }
  std::string complaint(const std::string& more = "") const {
    try {
      setup(more);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
};

}  // namespace

TEST(UserForce, IsACurveThroughTheTableThatItIsGiven) {
  const Table table("# of the third film\nx,force,error\n-0.1,0.2,0.01\n\n0, 0,0.01\n0.1,-0.4,0.02\n");
  const shakedown::Setup setup = table.setup();
  const Physics physics = physics_of(setup);
  EXPECT_DOUBLE_EQ(physics.box.free[0].newton(-0.1, 3, 3), 0.2);
  EXPECT_DOUBLE_EQ(physics.box.free[0].newton(0.1, 3, 3), -0.4);
  EXPECT_DOUBLE_EQ(physics.box.free[0].newton(0.3, 3, 3), -0.4);
  const double between = physics.box.free[0].newton(0.05, 3, 3);
  EXPECT_LT(between, -0.1);
  EXPECT_GT(between, -0.3);
  // The setup holds the points: it needs the table no more.
  const shakedown::Setup again = parse_setup(write_setup(setup), "again", all_effects());
  EXPECT_EQ(write_setup(again), write_setup(setup));
  EXPECT_EQ(digest(again), digest(setup));
}

TEST(UserForce, TakesTablesOfDampingStiffnessAndFriction) {
  const Physics rubbed = physics_of(Table("x,friction\n-0.1,2\n0.1,4\n").setup());
  EXPECT_DOUBLE_EQ(rubbed.box.free[0].newton(0, 0.5, 3), -3);
  EXPECT_DOUBLE_EQ(rubbed.box.free[0].newton(0.1, -0.5, 3), 4);
  const Physics brake = physics_of(Table("x,damping\n-0.1,2\n0.1,4\n").setup());
  EXPECT_DOUBLE_EQ(brake.box.free[0].newton(0, 0.5, 3), -1.5);
  const Physics spring = physics_of(Table("t,stiffness\n0,2\n4,4\n").setup());
  EXPECT_DOUBLE_EQ(spring.box.free[0].newton(0.1, 0.5, 2), -0.3);
}

TEST(UserForce, TakesAThousandPointsAndNoMore) {
  std::string text = "t,force\n";
  for (int i = 0; i < 1000; ++i) text += std::to_string(i) + "," + std::to_string(i % 7) + "\n";
  EXPECT_DOUBLE_EQ(physics_of(Table(text).setup()).box.free[0].newton(0, 0, 13), 6);
  EXPECT_NE(Table(text + "1000,1\n").complaint().find("force.csv:1002:1: has more than 1000 points"),
            std::string::npos)
      << Table(text + "1000,1\n").complaint();
}

TEST(UserForce, SaysWhatIsWrongWithATable) {
  const auto says = [](const std::string& text, const std::string& words) {
    const std::string complaint = Table(text).complaint();
    EXPECT_NE(complaint.find(words), std::string::npos) << complaint;
  };
  says("", "has fewer than two points");
  says("x,force\n0,1\n", "has fewer than two points");
  says("0,1\n1,2\n", "does not name its columns");
  says("x,newton\n0,1\n", "does not name its columns");
  says("x\n0\n", "has one column");
  says("x,force\n0,one\n", "holds one (a number is expected)");
  says("x,force\n0,nan\n1,2\n", "a number is expected");
  says("x,force\n1,1\n0,2\n", "does not ascend (0 after 1)");
  EXPECT_NE(Table("x,force\n0,1\n1,2\n").complaint("force = \"x\"\n").find("is given beside force"),
            std::string::npos);
  EXPECT_THROW(parse_setup("[[effect]]\nname = \"user_force\"\ntable = \"none.csv\"\n", "s", all_effects()),
               InputError);
  // A variable that a force does not have is found as in any formula.
  EXPECT_THROW(Table("w,force\n0,1\n1,2\n").setup(), InputError);
}
