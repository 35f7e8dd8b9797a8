// SPDX-License-Identifier: MIT
#include "theory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics.hpp"

namespace shakedown {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

LandingPhase landing_phase(double to_peak, double through_box) {
  const auto fraction = [](double x) { return x - std::floor(x); };
  if (fraction(to_peak) < 0.25) return LandingPhase::outward;
  return fraction(through_box) < 0.5 ? LandingPhase::inward : LandingPhase::unfavourable;
}

void expect_a_released_spring(const Setup& setup) {
  const auto place = [&](const char* key) {
    return setup.places.contains(key) ? setup.places.at(key) : SourcePlace{};
  };
  if (setup.domain != Domain::damper)
    throw InputError({{place("domain.kind"), "domain.kind",
                       "has no spring, so the theory of the damper does not apply", "use \"damper\""}});
  if (setup.release.displacement == 0)
    throw InputError(
        {{place("release.displacement"), "release.displacement",
          "is zero, so there is no stroke to estimate from", "give the distance of the release"}});
}

}  // namespace

const char* to_string(LandingPhase phase) {
  switch (phase) {
    case LandingPhase::outward: return "outward stroke";
    case LandingPhase::inward: return "inward stroke";
    case LandingPhase::unfavourable: return "neither";
  }
  return "";
}

double layer_thickness(const Setup& setup) {
  const double half_constant =
      0.71 * setup.grains.diameter;  // of fcc layers: every other site of a square grid of a/2
  const auto sites = [&](double width) {
    return std::floor((width - setup.grains.diameter) / half_constant * (1 + 1e-12)) + 1;
  };
  const double in_a_layer =
      std::max(1.0, std::ceil(sites(setup.box.width[0]) * sites(setup.box.width[1]) / 2));
  if (setup.grains.count == 0) return 0;
  return setup.grains.diameter * std::max(1.0, std::round(setup.grains.count / in_a_layer));
}

Theory theory_of(const Setup& setup) {
  expect_a_released_spring(setup);
  const Physics physics = physics_of(setup);
  const Setup::Blade& blade = setup.blade;
  const double release = std::abs(setup.release.displacement), length = setup.box.length;
  Theory theory;
  theory.beam_stiffness =
      blade.youngs_modulus * blade.width * std::pow(blade.thickness, 3) / (4 * std::pow(blade.length, 3));
  theory.beam_frequency = std::sqrt(theory.beam_stiffness / physics.box_mass) / two_pi;
  theory.stiffness = physics.stiffness;
  theory.frequency = std::sqrt(physics.stiffness / physics.box_mass) / two_pi;
  theory.total_mass = physics.box_mass + setup.grains.count * setup.grains.mass;
  theory.loaded_frequency = theory.frequency * std::sqrt(physics.box_mass / theory.total_mass);
  theory.layer_thickness = layer_thickness(setup);
  theory.top_speed = two_pi * theory.loaded_frequency * release;
  theory.time_to_peak = (length + release - theory.layer_thickness) / theory.top_speed;
  theory.time_through_box = (length - theory.layer_thickness) / theory.top_speed;
  theory.phase_to_peak = theory.frequency * theory.time_to_peak;
  theory.phase_through_box = theory.frequency * theory.time_through_box;
  theory.landing = landing_phase(theory.phase_to_peak, theory.phase_through_box);
  theory.optimal_length =
      std::numbers::pi * release * std::sqrt(physics.box_mass / theory.total_mass) + theory.layer_thickness;
  return theory;
}

}  // namespace shakedown
