// SPDX-License-Identifier: MIT
// Observables of motions known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "friction_oscillator.hpp"
#include "observables.hpp"
#include "sampled.hpp"
#include "within.hpp"

using namespace shakedown;
using std::numbers::pi;

namespace {

const FrictionOscillator paper_like{25.92, 0.58348, 0.05, 0.1075};

struct Viscous {
  double amplitude = 0.1075, rate = 0.3, angular = 2 * pi * 1.06;
  // x = A exp(-rt)(cos wt + r/w sin wt): released from rest.
  double position(double t) const {
    return amplitude * std::exp(-rate * t) * (std::cos(angular * t) + rate / angular * std::sin(angular * t));
  }
  double velocity(double t) const {
    return -amplitude * std::exp(-rate * t) * (angular + rate * rate / angular) * std::sin(angular * t);
  }
};

}  // namespace

TEST(ClosedForms, FrictionDampedOscillatorHasExactPeaksSlopeAndFrequency) {
  const Trajectory trajectory = sampled(
      12, 500, [](double t) { return paper_like.position_at(t); },
      [](double t) { return paper_like.velocity_at(t); });
  const Observables seen = observe(trajectory, shakedown::Setup{});
  const double half = paper_like.half_period(), drop = 2 * paper_like.friction / paper_like.stiffness;
  ASSERT_GE(seen.peaks.size(), 8u);
  // The friction's jump of 2F/M at each peak limits the cubic pieces to (F/M) h^2 / 8 there: 4e-8 m.
  for (int n = 1; n <= 8; ++n) {
    const Peak& peak = seen.peaks[static_cast<std::size_t>(n - 1)];
    WITHIN(peak.position, paper_like.extremum(n).position, 2e-8, 6.1e-9) << n;  // m
    WITHIN(peak.time, n * half, 2e-5, 7.8e-6) << n;                             // s
  }
  WITHIN(seen.slope, -drop / half, 1e-7, 9.5e-9);  // m/s
  EXPECT_EQ(seen.frequency, 4.5 / (seen.zero_crossings[9] - seen.zero_crossings[0]));
  // The crossings drift towards the peaks as the amplitude falls: half period n crosses at acos(-c_n / (x_n -
  // c_n)).
  const auto crossing = [&](int n) {
    const double slip = paper_like.friction / paper_like.stiffness,
                 swing = std::abs(paper_like.extremum(n).position) - slip;
    return half * (n + std::acos(-slip / swing) / pi);
  };
  WITHIN(seen.frequency, 4.5 / (crossing(9) - crossing(0)), 5e-13, 2.8e-14);  // Hz
  WITHIN(seen.decay.curvature, 0, 4e-8, 2.7e-9);                              // m/s^2
  EXPECT_LT(seen.decay.linear.rms, 2e-7);
  EXPECT_GT(seen.decay.exponential.rms, 1e-3);
}

TEST(ClosedForms, ViscousOscillatorHasExactRateAndDampingRatio) {
  const Viscous viscous;
  const Trajectory trajectory = sampled(
      10, 500, [&](double t) { return viscous.position(t); }, [&](double t) { return viscous.velocity(t); });
  const Observables seen = observe(trajectory, shakedown::Setup{});
  WITHIN(seen.frequency, 1.06, 7e-12, 3.8e-13);
  WITHIN(seen.decay.exponential.rate, viscous.rate, 3e-9, 1.9e-10);  // 1/s
  WITHIN(seen.decay.exponential.amplitude, viscous.amplitude, 1e-9, 6e-11);
  EXPECT_LT(seen.decay.exponential.rms, 1e-9);
  EXPECT_GT(seen.decay.curvature, 10 * seen.decay.curvature_error);
  const double ratio = viscous.rate / std::hypot(viscous.rate, viscous.angular);
  for (const HalfPeriodDamping& damping : seen.damping) {
    WITHIN(damping.equivalent_ratio, ratio, 2e-10, 1.2e-11);
    WITHIN(damping.loss_per_cycle, 1 - std::exp(-4 * pi * viscous.rate / viscous.angular), 1e-9, 8.4e-11);
  }
  WITHIN(seen.damping[0].amplitude, (0.1075 + std::abs(seen.peaks[0].position)) / 2, 4e-16, 2.3e-17);
}

TEST(ClosedForms, PeaksBetweenSamplesAreGoodToAMicrometre) {
  // 60 samples a second, and phases that never hit a sample; with and without velocities.
  const double angular = 2 * pi * 1.0313;
  const auto position = [&](double t) { return 0.1 * std::cos(angular * t + 0.1); };
  const auto velocity = [&](double t) { return -0.1 * angular * std::sin(angular * t + 0.1); };
  for (const bool with_velocity : {true, false}) {
    const Observables seen =
        observe(with_velocity ? sampled(20, 60, position, velocity) : sampled(20, 60, position, {}),
                shakedown::Setup{});
    ASSERT_GE(seen.peaks.size(), 39u);
    for (const Peak& peak : seen.peaks) WITHIN(std::abs(peak.position), 0.1, 1e-6, 3.2e-7);  // m
  }
}

TEST(ClosedForms, DoubleExtremaAndWigglesAtZeroCountOnce) {
  // A landing makes a notch at the top of each half period and a wiggle in every third passage through zero.
  const double angular = 2 * pi * 1.0;
  const auto notch = [&](double t) {
    const double s = std::sin(angular * t), c = std::cos(angular * t);
    const double top = 0.1 * c - 0.02 * c * std::exp(-400 * s * s);
    const double phase = std::remainder(t - 0.25, 1.5);
    return top + 0.008 * std::sin(phase * 300) * std::exp(-phase * phase * 1e4);
  };
  const Observables seen = observe(sampled(8.2, 2000, notch, {}), shakedown::Setup{});
  ASSERT_EQ(seen.peaks.size(), 15u);
  for (std::size_t n = 1; n < seen.peaks.size(); ++n)
    EXPECT_LT(seen.peaks[n].position * seen.peaks[n - 1].position, 0);
  WITHIN(seen.frequency, 1.0, 0.01, 1.6e-3);
}

TEST(ClosedForms, ASmallReleaseIsReadAsALargeOne) {
  const auto seen_of = [](double scale) {
    shakedown::Setup setup;
    setup.release.displacement *= scale;
    const auto swing = [scale](double t) { return scale * (0.1075 - 0.008 * t) * std::cos(2 * pi * t); };
    return observe(sampled(13, 500, swing, {}), setup);
  };
  const Observables paper = seen_of(1), small = seen_of(0.125);
  EXPECT_EQ(paper.small_peak, 0.01);
  EXPECT_EQ(small.small_peak, 0.00125);
  EXPECT_EQ(small.decay.peaks, paper.decay.peaks);
  EXPECT_GT(paper.first_small_peak, 12);
  EXPECT_EQ(small.first_small_peak, paper.first_small_peak);  // powers of two scale without rounding
  WITHIN(small.slope, 0.125 * paper.slope, 3e-17, 1.7e-18);
}

TEST(ClosedForms, WhatARunDoesNotHaveIsAbsent) {
  const Observables still = observe(sampled(3, 100, [](double) { return 0.1; }, {}), shakedown::Setup{});
  EXPECT_TRUE(still.peaks.empty());
  EXPECT_TRUE(std::isnan(still.frequency));
  EXPECT_TRUE(std::isnan(still.slope));
  EXPECT_TRUE(std::isnan(still.first_small_peak));
  const Observables nothing = observe(Trajectory{}, shakedown::Setup{});
  EXPECT_TRUE(nothing.peaks.empty());
  EXPECT_TRUE(std::isnan(nothing.seconds_to_energy_fraction[0]));
}
