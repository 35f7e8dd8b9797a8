// SPDX-License-Identifier: MIT
// What a fit makes small, on emulators written by hand.
#include "objective.hpp"
#include "within.hpp"

#include <gtest/gtest.h>

using namespace shakedown;

namespace {

constexpr double degrees = 300;

/// One knob; the sum is `at_centre` + slope z + curve z^2, the emulator's error grows with z^2.
struct OneKnob {
  std::vector<Knob> knobs{
      {.key = "restitution.grain_grain", .centre = 0.7, .width = 0.1, .low = 0, .high = 1}};
  Objective objective{&knobs, Eigen::MatrixXd::Zero(3, 3), Eigen::VectorXd::Zero(3)};

  OneKnob(double at_centre, double slope, double curve, double error) {
    objective.constant = at_centre;
    objective.cross[1] = -slope / 2;
    objective.square(1, 1) = curve;
    objective.degrees = degrees;
    objective.error = Eigen::MatrixXd::Zero(3, 3);
    objective.error(1, 1) = error * degrees;
  }
};

Eigen::VectorXd at(double z) { return Eigen::VectorXd::Constant(1, z); }

}  // namespace

// Where the emulator knows little a misfit of twenty times the degrees is no smaller: divided by what its
// error adds it would be least at the edge, and fits of a wrong model would run there.
TEST(Objective, AWrongModelIsNotRightWhereTheEmulatorKnowsLittle) {
  const OneKnob flat(20 * degrees, 0, 3 * degrees, 3);  // the error alone makes the sum grow
  WITHIN(flat.objective.chi2(at(1.5)), flat.objective.chi2(at(0)), 2e-11, 1.4e-12);
  const OneKnob valley(20 * degrees, 2 * degrees, 6 * degrees, 3);  // true minimum at -1/3
  const Minimum found = minimum_of(valley.objective, 1.5, 6);
  WITHIN(found.z[0], -1.0 / 3, 0.05, 0.016);  // the normalisation draws it to less error; seen: 0.016
}

TEST(Objective, ARightModelIsDividedByWhatTheErrorAdds) {
  const OneKnob right(0.9 * degrees, 0, 2.7 * degrees, 3);
  for (const double z : {0.0, 0.5, 1.0}) WITHIN(right.objective.chi2(at(z)), 0.9 * degrees, 1e-12, 6e-14);
}

// Half a million degrees from the minimum, as a frequency 0.3 % off is.
TEST(Objective, IsFollowedToItsMinimumFromFarAway) {
  const OneKnob far(3.5e3 * degrees, 7e3 * degrees, 3.5e3 * degrees, 1e-4);  // 3500 (z + 1)^2
  WITHIN(minimum_of(far.objective, 1.5, 1).z[0], -1, 5e-7, 2.9e-8);
}

TEST(Objective, GoesSmoothlyFromOneToTheOther) {
  const OneKnob edge(degrees, 1, 3 * degrees, 3);
  WITHIN(edge.objective.chi2(at(1e-6)), edge.objective.chi2(at(-1e-6)), 1e-5, 2.1e-6);
}
