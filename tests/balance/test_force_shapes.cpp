// SPDX-License-Identifier: MIT
// Families of formulas: the values from which their search starts, and what a map of forces gains by one.
#include <gtest/gtest.h>

#include <cmath>

#include "balance_problem.hpp"
#include "effects.hpp"
#include "force_map.hpp"
#include "force_shapes.hpp"
#include "pushed_box.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

/// A place or a moment, in parts of the largest excursion or of the duration; all else is a scale.
bool is_place(const ShapeParameter& parameter) { return parameter.name == "x0" || parameter.name == "t0"; }

TEST(ForceShapes, PlacesAreTriedEvenlyAndWithinTheMotion) {
  for (const ForceShape& shape : force_shapes())
    for (const ShapeParameter& parameter : shape.parameters) {
      if (!is_place(parameter)) continue;
      ASSERT_GE(parameter.start.size(), 9u) << shape.formula;
      EXPECT_GT(parameter.start.front(), -1) << shape.formula;
      EXPECT_LT(parameter.start.back(), 1) << shape.formula;
      for (std::size_t i = 1; i < parameter.start.size(); ++i) {
        const double step = parameter.start[i] - parameter.start[i - 1];
        EXPECT_GT(step, 0) << shape.formula << " " << parameter.start[i];
        EXPECT_LT(step, 0.1 + 1e-12) << shape.formula << " " << parameter.start[i];
      }
    }
}

TEST(ForceShapes, ScalesAreTriedInAscendingSteps) {
  for (const ForceShape& shape : force_shapes())
    for (const ShapeParameter& parameter : shape.parameters) {
      if (is_place(parameter) || parameter.name == "q") continue;
      ASSERT_GE(parameter.start.size(), 4u) << shape.formula;
      for (std::size_t i = 1; i < parameter.start.size(); ++i) {
        const double before = parameter.start[i - 1], after = parameter.start[i];
        EXPECT_GT(after, before) << shape.formula << " " << parameter.name;
        // From one to the next the best fit must not be jumped over; a width of either sign may be narrower.
        const double most = shape.formula.ends_with("/(1+exp(-(x-x0)/w))") ? 5.1 : 2.6;
        EXPECT_TRUE(before <= 0 || after / before < most) << shape.formula << " " << parameter.name;
      }
    }
}

TEST(ForceShapes, PhasesGoEvenlyThroughHalfATurn) {
  for (const ForceShape& shape : force_shapes())
    for (const ShapeParameter& parameter : shape.parameters) {
      if (parameter.name != "q") continue;
      ASSERT_EQ(parameter.start.size(), 4u);
      for (std::size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(parameter.start[i], 0.8 * static_cast<double>(i));
    }
}

/// A shape that is no family: of position alone, times its first value.
ForceShape of_position(double (*value)(double, const ShapeValues&)) {
  ForceShape shape;
  shape.of = ShapeOf::position;
  shape.value = value;
  return shape;
}

// Noise of a position enters by the slope of a force, and by that of a damping's potential.
TEST(ForceMap, SlopesAreThoseOfTheirForces) {
  PushedBox what;
  what.duration = 4;
  const Experiment experiment = pushed_box(what, 3);
  const MomentumRun run = momentum_run(measurement_of(pushed_setups(experiment), experiment).runs.front());
  MomentumRun moved = run;
  constexpr double step = 1e-5;  // m
  moved.x_box += step, moved.x_smooth += step;
  ForceShape shape = of_position([](double x, const ShapeValues&) { return 1 + 30 * x + 400 * x * x; });
  const ForceSamples force = shape_samples(shape, {}, run), force_beside = shape_samples(shape, {}, moved);
  WITHIN(((force_beside.force - force.force) / step - force.force_dx).abs().maxCoeff(), 400 * step, 5e-9,
         2.5e-10);
  shape.of = ShapeOf::damping_at_x;
  const ForceSamples damping = shape_samples(shape, {}, run);
  // The potential begins at the left end of the motion, so that two places of one run are compared.
  Eigen::Index low = 0, high = 0;
  run.x_box.minCoeff(&low), run.x_box.maxCoeff(&high);
  const double a = run.x_box[low], b = run.x_box[high];
  const auto integral = [](double x) { return x + 15 * x * x + 400.0 / 3 * x * x * x; };
  WITHIN(damping.potential[high] - damping.potential[low], integral(b) - integral(a), 7e-7, 3.9e-8);
  for (Eigen::Index i = 0; i < run.x_box.size(); ++i)
    EXPECT_EQ(damping.potential_dx[i], shape.value(run.x_box[i], {}));
}

TEST(ForceMap, ACurveReachesOverWhatTheRunsShow) {
  PushedBox what;
  what.duration = 4;
  const Experiment experiment = pushed_box(what, 3);
  const Measurement measurement = measurement_of(pushed_setups(experiment), experiment);
  const BalanceProblem balance(measurement, all_effects());
  const SelectionProblem p = balance.windows_of(0.5, 0.125);
  ForceMap map(p.problem, balance.runs());
  map.project_out(p.problem.impulse(), Eigen::MatrixXd(p.problem.size(), 0));
  double farthest = 0;
  for (const MomentumRun& run : balance.runs()) farthest = std::max(farthest, run.x_box.abs().maxCoeff());
  const ForceCurve curve = map.curve(ShapeOf::position);
  constexpr double beyond = 1.05;  // of the farthest, so that no place lies on the edge
  WITHIN(curve.argument.front() / farthest, -beyond, 4e-15, 2.2e-16);
  WITHIN(curve.argument.back() / farthest, beyond, 4e-15, 2.2e-16);
}

TEST(ForceMap, WhatTheFitHasGainsNothingAndTheUnitOfAStrengthIsNoMatter) {
  PushedBox what;
  what.cubic = -0.03, what.duration = 4, what.box_noise = 1e-7, what.com_noise = 1e-5;
  const Experiment experiment = pushed_box(what, 3);
  const Measurement measurement = measurement_of(pushed_setups(experiment), experiment);
  const BalanceProblem balance(measurement, all_effects());
  SelectionProblem p = balance.windows_of(0.5, 0.125);
  p.problem.set_nuisances({});
  p.problem.set_spring(0, 0);
  p.problem.set_covariance({});
  ForceMap map(p.problem, balance.runs());
  const Eigen::MatrixXd columns = columns_of(p, {{0, 0}});
  map.project_out(regress(p.problem.impulse(), columns).residual, orthonormal_basis(columns));

  const ForceShape spring = of_position([](double x, const ShapeValues& s) { return s[0] * x; });
  for (const double unit : {1e-9, 1.0, 1e9}) EXPECT_EQ(map.gain(spring, {unit}), 0) << unit;
  const ForceShape cubic = of_position([](double x, const ShapeValues& s) { return s[0] * x * x * x; });
  const double gain = map.gain(cubic, {1});
  EXPECT_GT(gain, 1000);
  for (const double unit : {1e-9, 1e9}) WITHIN(map.gain(cubic, {unit}) / gain, 1, 5e-13, 2.6e-14);
}

}  // namespace
}  // namespace shakedown
