// SPDX-License-Identifier: MIT
#include "pushed_box.hpp"

#include <cmath>
#include <numbers>

#include "random.hpp"

namespace shakedown {

namespace {

/// Distance of the mass from the box's middle: to and fro between the walls with about the box's own rhythm,
/// in flight at constant speed for a third of each half period, packed in between. Packed at the outer wall
/// at release.
struct Path {
  double reach = 0, half_period = 0.48;
  double speed_at(double t) const {
    const double phase = std::fmod(t + 1.5 * half_period, 2 * half_period);
    const double flight = 0.35 * half_period;
    const bool forth = phase < half_period;
    const double within = forth ? phase : phase - half_period;
    return within < flight ? (forth ? -1 : 1) * 2 * reach / flight : 0;
  }
};

MeasuredRun push(const PushedBox& what, double length, std::uint64_t seed, std::uint64_t number) {
  const Setup setup;
  const double box = setup.box.mass + what.extra_mass,
               grains = what.grains ? setup.grains.count * setup.grains.mass : 0;
  const double stiffness = setup.box.mass * std::pow(2 * std::numbers::pi * setup.spring.frequency, 2);
  const double delta0 = setup.release.displacement, total = box + grains;
  const Path path{length / 2 - 0.009};
  Random random(seed, number, Stream::camera);
  MeasuredRun run;
  run.name = "L" + std::to_string(static_cast<int>(std::lround(length * 1e3)));
  run.box_length = length;
  run.frame_rate = what.rate;
  const int steps = static_cast<int>(std::lround(25000 / what.rate));  // a frame
  const double step = 1 / (what.rate * steps);
  double x = delta0, v = 0, distance = path.reach, speed = path.speed_at(0), box_error = 0, com_error = 0;
  const double kept = std::sqrt(1 - what.colour * what.colour);
  for (int frame = 0; frame < static_cast<int>(what.duration * what.rate); ++frame) {
    box_error = what.colour * box_error + kept * what.box_noise * random.normal();
    com_error = what.colour * com_error + kept * what.com_noise * random.normal();
    run.time.push_back(frame / what.rate);
    run.x_box.push_back(x + box_error);
    if (what.grains) run.x_com.push_back(x + distance + com_error);
    for (int i = 0; i < steps; ++i) {  // leapfrog: second order, and impulses stay exact
      const double t = frame / what.rate + i * step;
      double force = -stiffness * x * (1 + what.cubic * (x / delta0) * (x / delta0)) - what.viscous * v +
                     total * what.acceleration - what.extra_mass * what.acceleration;
      if (what.force) force += what.force(x, v, t);
      v += force / total * step;
      const double kick = path.speed_at(t + step) - speed;
      v -= grains / total * kick;
      speed += kick;
      const double friction = what.dry_friction / total * step;
      v = std::abs(v) < friction ? 0 : v - std::copysign(friction, v);
      x += v * step;
      distance += speed * step;
    }
  }
  return run;
}

}  // namespace

Experiment pushed_box(const PushedBox& what, std::uint64_t seed) {
  Experiment experiment;
  std::uint64_t number = 0;
  for (const double length : {0.04, 0.065, 0.104})
    experiment.runs.push_back(push(what, length, seed, number++));
  return experiment;
}

std::vector<Setup> pushed_setups(const Experiment& experiment) {
  std::vector<Setup> setups(experiment.runs.size());
  for (std::size_t i = 0; i < setups.size(); ++i) {
    setups[i].box.length = experiment.runs[i].box_length;
    if (!experiment.runs[i].has_com()) setups[i].grains.count = 0;
  }
  return setups;
}

}  // namespace shakedown
