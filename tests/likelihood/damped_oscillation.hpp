// SPDX-License-Identifier: MIT
// A stand-in for the hard engine: a damped oscillation whose chaos is known, and what two box lengths show of
// it.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "effects.hpp"
#include "emulator.hpp"
#include "formula_engine.hpp"
#include "physics.hpp"
#include "random.hpp"

namespace shakedown {

/// Decay by the grains' restitution, frequency from the spring, chaos of half a millimetre in two shapes.
class DampedOscillation final : public FormulaEngine {
 public:
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    Random random(setup.run.seed, static_cast<std::uint64_t>(options.run), Stream::velocities);
    const double early = 5e-4 * random.normal(), late = 5e-4 * random.normal();
    const double w = 2 * std::numbers::pi * setup.spring.frequency,
                 rate = 0.3 * (1 - setup.restitution.grain_grain);
    const double drag = physics_of(setup).box.viscous.sum() / 2;
    return sampled(setup, 500, [&](double t) {
      const double x = 0.1 * std::exp(-(rate + drag * std::abs(std::sin(0.4 * t))) * t) * std::cos(w * t);
      return std::pair(x + early * std::sin(1.3 * t) + late * std::sin(0.7 * t + 1),
                       0.9 * x + 0.01 * setup.restitution.grain_wall + late * std::cos(2 * t));
    });
  }
};

/// Two box lengths measured on the stand-in with hidden values.
inline std::vector<MeasuredFeatures> measured_on(const Setup& truth, const Setup& believed, int run) {
  std::vector<MeasuredFeatures> measured;
  for (const double length : {0.040, 0.065}) {
    RunOptions options;
    options.run = run;
    Setup hidden = truth;
    hidden.run.seed = 99 + static_cast<std::uint64_t>(length * 1e3);
    const Trajectory trajectory = DampedOscillation{}.run(hidden, options);
    MeasuredRun table;
    table.name = length < 0.05 ? "short" : "long";
    table.frame_rate = 500;
    table.time = trajectory.time;
    table.x_box = trajectory.x_box;
    table.x_com = trajectory.x_com;
    Random noise(7, static_cast<std::uint64_t>(run * 2 + (length > 0.05)), Stream::camera);
    for (double& x : table.x_box) x += 2e-4 * noise.normal();
    for (double& x : table.x_com) x += 5e-4 * noise.normal();
    Setup setup = believed;
    setup.box.length = length;
    Experiment experiment;
    experiment.runs = {table};
    measured.push_back(features_of(measurement_of({setup}, experiment)).front());
  }
  return measured;
}

inline Setup believed_setup() {
  Setup setup;
  setup.run.duration = 8;
  return setup;
}

inline const std::vector<Knob> theta{{"restitution.grain_grain", 0.75, 0.15, 0.2, 0.999, true},
                                     {"restitution.grain_wall", 0.76, 0.15, 0.2, 0.999, true},
                                     {"spring.frequency", 1.23, 0.01, 1, 1.5, true}};

}  // namespace shakedown
