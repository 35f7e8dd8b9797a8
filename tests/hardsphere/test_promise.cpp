// SPDX-License-Identifier: MIT
// A run that does not keep the engine's promise is no result: it stops with the reason.
#include "promise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "all_pairs.hpp"
#include "effects.hpp"
#include "errors.hpp"
#include "hard_engine.hpp"
#include "open_book.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

std::string complaint(double ledger, double overlap, double most = 1) {
  Health health;
  health.ledger_error = ledger;
  health.deepest_overlap = overlap;
  try {
    expect_kept(health, 0.25, most);
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

TEST(Promise, CountsWhatWentThroughBetweenTwoLooks) {
  OpenBook energy;
  Ledger lines;
  lines.contact_loss[2] = 20;
  lines.effect_loss = {-20};
  energy.see(1e-12, 0, lines);
  EXPECT_DOUBLE_EQ(energy.error(0), 5e-14);
  lines.contact_loss[2] = 30;  // 10 more: what long runs lose in all counts for nothing
  energy.see(0, 0, lines);
  EXPECT_DOUBLE_EQ(energy.error(0), 5e-14);
}

TEST(Promise, CountsWhatForcesPutIn) {
  OpenBook energy;
  energy.see(1e-6, 1);
  EXPECT_DOUBLE_EQ(energy.error(1), 1e-6);
  energy.see(0, 1e4);
  EXPECT_DOUBLE_EQ(energy.error(1), 1e-10);
  EXPECT_DOUBLE_EQ(energy.error(1e5), 1e-11);
  EXPECT_EQ(OpenBook().error(0), 0);
  energy.see(std::numeric_limits<double>::quiet_NaN(), 1);
  EXPECT_EQ(energy.error(1), std::numeric_limits<double>::infinity());
}

TEST(Promise, IsBrokenByWhatIsNoNumber) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  EXPECT_NE(complaint(nothing, 0), "");
  EXPECT_NE(complaint(infinity, 0), "");
  EXPECT_NE(complaint(0, nothing), "");
  EXPECT_NE(complaint(0, 0, nothing), "");
  EXPECT_NE(complaint(0, 0, infinity), "");
}

/// One run of the paper's damper with this force on the box, N.
Health health_under(const std::string& force, const std::string& grains = "") {
  return make_hard_engine()
      ->run(parse_setup("[run]\nduration = \"12 s\"\n" + grains +
                            "[[effect]]\nname = \"user_force\"\non = \"box\"\nforce = \"" + force + "\"\n",
                        "test.toml", all_effects()))
      .health;
}

// Seen: 3e-12 with the corner (1e-8 where pieces of the motion keep its position alone), 2e-12 with the jumps
// (4e-4 where nothing looks between the last node and the end of a piece).
TEST(Promise, IsKeptAtCornersAndJumpsOfAForce) {
  const std::string empty = "[grains]\ncount = 0\n";
  EXPECT_LE(health_under("63.5*max(0,-0.0701-x)+0.03*sign(v)*abs(v)^6").ledger_error, 3e-11);
  EXPECT_LE(health_under("0.3*(x>0.03)", empty).ledger_error, 3e-11);
  EXPECT_LE(health_under("0.02*(sin(60*t)>0)", empty).ledger_error, 3e-11);
}

TEST(Promise, StopsRunsThatAreNoResult) {
  // Dry friction written as a formula: the box comes to rest at the jump, and pieces without length follow.
  EXPECT_NE(complaint_of_run("[run]\nduration = \"12 s\"\n[grains]\ncount = 0\n[[effect]]\nname = "
                             "\"user_force\"\non = \"box\"\nforce = \"-0.3*(2*(v>0)-1)\"\n")
                .find("jumps to and fro"),
            std::string::npos);
  EXPECT_NE(complaint_of_run("[run]\nduration = \"0.1 s\"\n[[effect]]\nname = \"user_force\"\non = "
                             "\"grains\"\nforce = \"1e50\"\n")
                .find("beyond 1e6 m/s"),
            std::string::npos);
}

/// An index made of such a number would lead into memory that is nobody's.
TEST(Promise, PlacesBeyondAllMeasureEndInNoCrash) {
  shakedown::Setup setup;
  setup.release.displacement = 1e50;
  EXPECT_ANY_THROW(make_hard_engine()->run(setup));
  // What fills the vectors behind the last grain is met by none, however fast it is.
  State state;
  state.position = {Vec3::Zero()};
  state.velocity = {Vec3(1e12, 0, 0)};
  state.radius = {0.005};
  state.mass = {0.004};
  AllPairs grains(state, {0.025, 0.025});
  grains.predict_all();
  EXPECT_LT(grains.event(0).partner, 1);
}
