// SPDX-License-Identifier: MIT
#include "shaken_box.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include "hard_engine.hpp"
#include "soft_engine.hpp"

namespace shakedown {

Setup setup_of(const ShakenBox& box) {
  constexpr double heavier = 1e6;
  Setup setup;
  setup.box.mass = heavier * box.grains * box.grain_mass;
  setup.box.length = box.thickness + box.clearance;
  setup.box.width = {box.width, box.width};
  setup.spring.frequency = box.frequency;
  setup.grains.count = box.grains;
  setup.grains.diameter = box.diameter;
  setup.grains.mass = box.grain_mass;
  setup.restitution.grain_grain = setup.restitution.grain_wall = box.restitution;
  setup.release.displacement = box.amplitude;
  setup.release.kinetic_energy_fraction = 2e-5 / heavier;
  setup.run.sample_rate = box.frequency;
  setup.run.duration = (box.settling + box.periods) / box.frequency;
  return setup;
}

ShakenLoss loss_of(const std::string& engine, const ShakenBox& box) {
  const Trajectory run = (engine == "hard" ? make_hard_engine() : make_soft_engine())->run(setup_of(box));
  const double speed = 2 * std::numbers::pi * box.frequency * box.amplitude,
               unit = box.grains * box.grain_mass * speed * speed;
  const auto lost_until = [&](int period) {
    const auto k = static_cast<std::size_t>(period);
    return (run.loss[0][k] + run.loss[1][k] + run.loss[2][k]) / unit;
  };
  double sum = 0, squares = 0;
  for (int k = box.settling; k < box.settling + box.periods; ++k) {
    const double lost = lost_until(k + 1) - lost_until(k);
    sum += lost;
    squares += lost * lost;
  }
  const double mean = sum / box.periods;
  return {mean, std::sqrt(std::max(0.0, squares / box.periods - mean * mean))};
}

double collected_loss(double clearance_over_amplitude) {
  double low = 0, high = 2 * std::numbers::pi;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (middle - std::sin(middle) < clearance_over_amplitude ? low : high) = middle;
  }
  return std::pow(1 - std::cos(low), 2);
}

}  // namespace shakedown
