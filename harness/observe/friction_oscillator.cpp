// SPDX-License-Identifier: MIT
#include "friction_oscillator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "errors.hpp"

namespace shakedown {

namespace {

/// The half period that a time lies in, by number, and the phase in it, rad; at the end of the motion the
/// phase stays 0.
struct Phase {
  int n = 0;
  double angle = 0;
};
Phase phase_at(const FrictionOscillator& oscillator, double time) {
  EXPECT(time >= 0);
  const double halves = time / oscillator.half_period();
  const int last = oscillator.last_extremum();
  if (halves >= last) return {last, 0};
  const int n = static_cast<int>(halves);
  return {n, std::numbers::pi * (halves - n)};
}

double centre(const FrictionOscillator& oscillator, int n) {
  return (n % 2 == 0 ? 1 : -1) * oscillator.friction / oscillator.stiffness;
}

}  // namespace

double FrictionOscillator::half_period() const {
  return std::numbers::pi * std::sqrt(total_mass / stiffness);
}

int FrictionOscillator::last_extremum() const {
  if (friction <= 0) return std::numeric_limits<int>::max();
  const double slip = friction / stiffness;
  return std::max(0, static_cast<int>(std::ceil((release - slip) / (2 * slip))));
}

Peak FrictionOscillator::extremum(int n) const {
  n = std::min(n, last_extremum());
  return {n * half_period(), (n % 2 == 0 ? 1 : -1) * (release - 2 * n * friction / stiffness)};
}

double FrictionOscillator::position_at(double time) const {
  const Phase phase = phase_at(*this, time);
  const double middle = centre(*this, phase.n);
  return middle + (extremum(phase.n).position - middle) * std::cos(phase.angle);
}

double FrictionOscillator::velocity_at(double time) const {
  const Phase phase = phase_at(*this, time);
  return -(extremum(phase.n).position - centre(*this, phase.n)) * std::sqrt(stiffness / total_mass) *
         std::sin(phase.angle);
}

double effective_friction(double stiffness, double release, double peak, int n) {
  return stiffness * (std::abs(release) - std::abs(peak)) / (2 * n);
}

}  // namespace shakedown
