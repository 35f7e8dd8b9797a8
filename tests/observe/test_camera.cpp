// SPDX-License-Identifier: MIT
// The camera forth and back, and its derivatives against differences.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "camera.hpp"
#include "effects.hpp"
#include "random.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double omega = 2 * std::numbers::pi * 1.23;

double box_at(double t) { return (0.1075 - 0.008 * t) * std::cos(omega * t); }
double centre_at(double t) { return box_at(t) + 0.012 * std::sin(1.7 * omega * t + 0.4); }

/// The paper's swing and a centre that moves in the box, `rate` frames a second.
Recording swing(double rate, double seconds = 4) {
  Recording recording;
  for (int k = 0; k <= static_cast<int>(seconds * rate); ++k) {
    const double t = k / rate;
    recording.time.push_back(t);
    recording.x_box.push_back(box_at(t));
    recording.x_com.push_back(centre_at(t));
  }
  return recording;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// A bad camera: every error at once, each several times what a laboratory has.
constexpr Camera bad{.shutter = 6e-3,
                     .centre_bias = 0.02,
                     .arc_length = 0.59,
                     .depth = 0.01,
                     .lens = 0.02,
                     .scale = -0.01,
                     .drift = 1e-4,
                     .origin = 2e-3,
                     .time_offset = 3e-3};

TEST(Camera, EachErrorActsAsStated) {
  const Recording truth{{0, 2}, {0.1, 0.1}, {0.12, 0.12}};
  EXPECT_DOUBLE_EQ(seen_through({.lens = 0.01}, truth).x_box[1], 0.1 * (1 + 0.01 / 4));
  EXPECT_DOUBLE_EQ(seen_through({.lens = 0.01}, truth).x_com[1], 0.12 * (1 + 0.01 * 0.36));
  EXPECT_DOUBLE_EQ(seen_through({.depth = 0.01}, truth).x_com[1], 0.1212);
  EXPECT_DOUBLE_EQ(seen_through({.depth = 0.01}, truth).x_box[1], 0.1);
  EXPECT_DOUBLE_EQ(seen_through({.origin = 1e-3}, truth).x_box[1], 0.101);
  EXPECT_DOUBLE_EQ(seen_through({.origin = 1e-3}, truth).x_com[1], 0.121);
}

TEST(Camera, AShutterReadsEachThingAtItsOwnTime) {
  constexpr double shutter = 2e-3;
  for (const double rate : {240.0, 500.0}) {
    const Recording seen = seen_through({.shutter = shutter}, swing(rate));
    double most = 0;
    for (std::size_t i = 0; i < seen.time.size(); ++i) {
      // The place is where the thing is when its row is read.
      most = std::max(most, std::abs(seen.x_box[i] - box_at(seen.time[i] + shutter * seen.x_box[i] / 0.4)));
      most =
          std::max(most, std::abs(seen.x_com[i] - centre_at(seen.time[i] + shutter * seen.x_com[i] / 0.4)));
    }
    EXPECT_LT(most, rate < 300 ? 1e-7 : 1e-8) << rate;  // seen: 4.3e-8, 4.0e-9
  }
}

TEST(Camera, WhatACameraDidIsUndone) {
  for (const double rate : {60.0, 240.0, 500.0, 1000.0}) {
    const Recording truth = swing(rate), back = undone(bad, seen_through(bad, truth));
    EXPECT_LT(farthest(back.time, truth.time), 1e-15) << rate;
    EXPECT_LT(farthest(back.x_box, truth.x_box), 1e-12) << rate;
    EXPECT_LT(farthest(back.x_com, truth.x_com), 1e-12) << rate;
  }
}

TEST(Camera, NoiseAndLostFramesAreUndoneToo) {
  Recording truth = swing(500);
  Random random(1, 0, Stream::other);
  for (double& x : truth.x_box) x += 0.2e-3 * random.normal();
  for (double& x : truth.x_com) x += 0.5e-3 * random.normal();
  for (const std::size_t lost : {0, 1, 2, 3, 700, 701, 1500}) {
    truth.x_box[lost] = std::numeric_limits<double>::quiet_NaN();
    truth.x_com[lost] = truth.x_com[lost + 40] = std::numeric_limits<double>::quiet_NaN();
  }
  const Recording back = undone(bad, seen_through(bad, truth));
  for (std::size_t i = 0; i < truth.time.size(); ++i) {
    ASSERT_EQ(std::isnan(back.x_box[i]), std::isnan(truth.x_box[i])) << i;
    if (std::isnan(truth.x_box[i])) continue;
    WITHIN(back.x_box[i], truth.x_box[i], 5e-13, 2.6e-14) << i;
    ASSERT_EQ(std::isnan(back.x_com[i]), std::isnan(truth.x_com[i])) << i;
    if (std::isfinite(truth.x_com[i])) {
      WITHIN(back.x_com[i], truth.x_com[i], 5e-13, 2.8e-14) << i;
    }
  }
}

TEST(Camera, NoiseKeepsItsSizeThroughTheShutter) {
  Recording noisy = swing(500);
  const Recording smooth = noisy;
  Random random(2, 0, Stream::other);
  for (double& x : noisy.x_box) x += 0.2e-3 * random.normal();
  const Recording one = undone({.shutter = 1e-3}, noisy), other = undone({.shutter = 1e-3}, smooth);
  double sum = 0;
  for (std::size_t i = 0; i < one.time.size(); ++i) sum += std::pow(one.x_box[i] - other.x_box[i], 2);
  WITHIN(std::sqrt(sum / static_cast<double>(one.time.size())), 0.2e-3, 0.01e-3, 4e-6);
}

TEST(Camera, WithoutGrainsOrTrackedGrainsTheBoxIsSeen) {
  Recording empty = swing(500), untracked = empty;
  const std::vector<double> box = seen_through(bad, empty).x_box;
  empty.x_com.assign(empty.time.size(), std::numeric_limits<double>::quiet_NaN());
  untracked.x_com.clear();
  EXPECT_EQ(seen_through(bad, empty).x_box, box);
  EXPECT_EQ(seen_through(bad, untracked).x_box, box);
  EXPECT_TRUE(undone(bad, untracked).x_com.empty());
}

TEST(Camera, DerivativesAreThoseOfTheCamera) {
  const Recording truth = swing(500);
  for (const CameraParameter& parameter : camera_parameters(all_effects())) {
    const Recording slope = derivative(truth, parameter);
    const double small = 1e-3 * parameter.typical;
    const auto with = [&](double strength) {
      Camera camera;
      camera.*parameter.field = parameter.inverse_square ? 1 / std::sqrt(strength) : strength;
      return seen_through(camera, truth);
    };
    // 1 / l^2 of a blade of 20 m: the same order as the others' changes.
    const double step = parameter.inverse_square ? 1 / 400.0 : small;
    const Recording more = with(step);
    double most = 0, size = 0;
    for (std::size_t i = 0; i < truth.time.size(); ++i) {
      // A clock that is late by `step` shows at one recorded time where the thing was before.
      const double late = more.time[i] - truth.time[i], t = truth.time[i];
      const double box = late == 0 ? more.x_box[i] - truth.x_box[i] : box_at(t - late) - box_at(t);
      const double centre = late == 0 ? more.x_com[i] - truth.x_com[i] : centre_at(t - late) - centre_at(t);
      most =
          std::max({most, std::abs(box - step * slope.x_box[i]), std::abs(centre - step * slope.x_com[i])});
      size = std::max({size, std::abs(box), std::abs(centre)});
    }
    EXPECT_GT(size, 0) << parameter.path;
    EXPECT_LT(most, 1e-3 * size) << parameter.path;  // seen: 3e-4, what the step leaves of second order
  }
}

struct Told {
  const char* path;
  double Camera::*field;
  bool optical, inverse_square;
};

TEST(Camera, EachNumberIsSetByTheEffectThatSaysSo) {
  const Told told[] = {{"camera_scale.scale", &Camera::scale, false, false},
                       {"camera_lens.distortion", &Camera::lens, true, false},
                       {"camera_tilt.tilt", &Camera::tilt, true, false},
                       {"camera_depth.depth", &Camera::depth, true, false},
                       {"camera_shutter.time", &Camera::shutter, true, false},
                       {"camera_origin.origin", &Camera::origin, false, false},
                       {"camera_drift.drift", &Camera::drift, false, false},
                       {"camera_time_offset.offset", &Camera::time_offset, false, false},
                       {"camera_com_bias.bias", &Camera::centre_bias, true, false},
                       {"camera_arc.blade_length", &Camera::arc_length, true, true}};
  EXPECT_EQ(camera_parameters(all_effects()).size(), std::size(told));
  for (const Told& one : told) {
    const std::optional<CameraParameter> parameter = find_camera_parameter(all_effects(), one.path);
    ASSERT_TRUE(parameter) << one.path;
    EXPECT_EQ(parameter->field, one.field) << one.path;
    EXPECT_EQ(parameter->optical, one.optical) << one.path;
    EXPECT_EQ(parameter->inverse_square, one.inverse_square) << one.path;
    // The record writes what it says.
    EffectChoice choice = with_defaults(*all_effects().find(effect_of(one.path)));
    choice.values[std::string(choice.record->parameters.front().name)] = 0.125;
    Physics physics;
    choice.record->apply(choice, 0, physics);
    EXPECT_EQ(physics.camera.*one.field, 0.125) << one.path;
  }
  EXPECT_FALSE(find_camera_parameter(all_effects(), "camera_lens.nothing"));
  EXPECT_FALSE(find_camera_parameter(all_effects(), "grain_friction.grain_grain"));
}

}  // namespace
