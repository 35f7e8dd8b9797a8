// SPDX-License-Identifier: MIT
#include "initial_state.hpp"

#include <algorithm>
#include <cmath>

#include "grain_file.hpp"
#include "packing.hpp"
#include "random.hpp"
#include "text.hpp"

namespace shakedown {

namespace {

/// Draws relative diameters from a Gaussian cut at 2.5 standard deviations.
std::vector<double> relative_diameters(const Setup& setup, double deviation, int run) {
  std::vector<double> relative(static_cast<std::size_t>(setup.grains.count), 1.0);
  if (deviation == 0) return relative;
  Random random(setup.run.seed, static_cast<std::uint64_t>(run), Stream::diameters);
  for (double& diameter : relative) {
    double deviate = random.normal();
    while (std::abs(deviate) > 2.5) deviate = random.normal();
    diameter = 1 + deviation * deviate;
  }
  return relative;
}

void set_sizes(const Setup& setup, double deviation, int run, State& state) {
  const std::vector<double> relative = relative_diameters(setup, deviation, run);
  double volume = 0;
  for (const double diameter : relative) volume += diameter * diameter * diameter;
  // Masses go as d^3 and keep the total N m.
  const double mass =
      relative.empty() ? 0 : setup.grains.mass * static_cast<double>(relative.size()) / volume;
  for (const double diameter : relative) {
    expect_packing_goes_on();
    state.radius.push_back(setup.grains.diameter / 2 * diameter);
    state.mass.push_back(deviation == 0 ? setup.grains.mass : mass * diameter * diameter * diameter);
  }
}

/// Draws Gaussian velocities and scales them to a total kinetic energy, J; in a periodic cell the total
/// momentum is removed first.
void set_velocities(const Setup& setup, double energy, int run, State& state) {
  Random random(setup.run.seed, static_cast<std::uint64_t>(run), Stream::velocities);
  state.velocity.resize(state.size());
  for (Vec3& velocity : state.velocity) {
    expect_packing_goes_on();
    for (double& component : velocity) component = random.normal();
  }
  if (setup.domain == Domain::periodic) {
    Vec3 momentum = Vec3::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
      momentum += state.mass[i] * state.velocity[i];
      mass += state.mass[i];
    }
    if (state.size() > 1)
      for (Vec3& velocity : state.velocity) velocity -= momentum / mass;
  }
  const double now = kinetic_energy(state, 0);
  const double factor = now > 0 ? std::sqrt(energy / now) : 0;
  for (Vec3& velocity : state.velocity) velocity *= factor;
}

/// Changes measured velocities by a thousandth, by which they err at least: enough for chaos to grow from.
void set_apart(const Setup& setup, int run, State& state) {
  constexpr double error = 1e-3;
  Random random(setup.run.seed, static_cast<std::uint64_t>(run), Stream::velocities);
  for (Vec3& velocity : state.velocity)
    for (double& component : velocity) component *= 1 + error * random.normal();
}

}  // namespace

State initial_state(const Setup& setup, int run) {
  const Physics physics = physics_of(setup);
  State state;
  const bool damper = setup.domain == Domain::damper;
  if (damper) {
    state.x_box = setup.release.displacement;
  }
  set_sizes(setup, physics.relative_diameter_deviation, run, state);
  const bool measured = !setup.release.initial_grains.empty();
  if (measured) {
    read_grains(setup, state);
  } else {
    state.position = packed_centres(setup, physics.packing, state.radius, run);
    for (Vec3& position : state.position) position.x() += state.x_box;
  }
  const bool at_rest = std::all_of(state.velocity.begin(), state.velocity.end(),
                                   [](const Vec3& velocity) { return velocity.isZero(0); });
  if (measured && !at_rest && setup.release.grains_measured_at) set_apart(setup, run, state);
  if (!measured || (setup.release.grains_measured_at && at_rest)) {
    double mass = 0;
    for (const double m : state.mass) mass += m;
    const double spring_energy = physics.stiffness * state.x_box * state.x_box / 2;
    const double speed = setup.release.grain_speed;
    set_velocities(setup,
                   damper ? setup.release.kinetic_energy_fraction * spring_energy : mass * speed * speed / 2,
                   run, state);
  }
  if (damper) state.v_box = physics.initial_box_velocity;
  return state;
}

std::string note_on_measured_grains(const Setup& setup) {
  if (setup.release.initial_grains.empty()) return "";
  const double moved = initial_state(setup).pushed_apart;
  return moved > 0 ? setup.release.initial_grains + ": grains overlap by less than " +
                         millimetres(most_measured_overlap) + " and are pushed apart, none by more than " +
                         millimetres(moved)
                   : "";
}

}  // namespace shakedown
