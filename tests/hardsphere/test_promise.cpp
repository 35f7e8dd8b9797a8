// SPDX-License-Identifier: MIT
// A run that does not keep the engine's promise is no result: it stops with the reason.
#include "promise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "effects.hpp"
#include "errors.hpp"
#include "hard_engine.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

std::string complaint(double ledger, double overlap, double initial = 1, double most = 1) {
  Health health;
  health.ledger_error = ledger;
  health.deepest_overlap = overlap;
  try {
    expect_kept(health, 0.25, initial, most);
  } catch (const PhysicsError& error) {
    return error.what();
  }
  return "";
}

std::string complaint_of_run(const std::string& setup) {
  try {
    make_hard_engine()->run(parse_setup(setup, "test.toml", all_effects()));
  } catch (const PhysicsError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(Promise, IsHeldToItsBounds) {
  EXPECT_EQ(complaint(0.9e-9, 0.9e-12), "");
  EXPECT_NE(complaint(1.1e-9, 0).find("at t = 0.25 s energy and losses do not balance"), std::string::npos);
  EXPECT_NE(complaint(0, 1.1e-12).find("overlap by 1.1e-12 m"), std::string::npos);
  for (const std::string& said : {complaint(1.1e-9, 0), complaint(0, 1.1e-12)})
    EXPECT_NE(said.find("--engine soft"), std::string::npos) << said;
}

TEST(Promise, CountsWhatForcesPutIn) {
  EXPECT_EQ(complaint(1e-6, 0, 1, 1e4), "");
  EXPECT_NE(complaint(1e-6, 0, 1, 1e2), "");
  EXPECT_EQ(complaint(0.9e-9, 0, 0, 0), "");
}

TEST(Promise, IsBrokenByWhatIsNoNumber) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  EXPECT_NE(complaint(nothing, 0), "");
  EXPECT_NE(complaint(infinity, 0), "");
  EXPECT_NE(complaint(0, nothing), "");
  EXPECT_NE(complaint(0, 0, 1, nothing), "");
  EXPECT_NE(complaint(0, 0, infinity, infinity), "");
}

TEST(Promise, StopsRunsThatAreNoResult) {
  // A force with a step has no expansion in time; without one the balance was off by 3e-4 of the energy.
  EXPECT_NE(complaint_of_run("[run]\nduration = \"1 s\"\n[[effect]]\nname = \"user_force\"\nforce = "
                             "\"-20*(x>0.1)\"\n")
                .find("do not balance"),
            std::string::npos);
}
