// SPDX-License-Identifier: MIT
// A setup as plain numbers. Effects are known by the names and parameters of their records, their laws are
// written down here a second time.
#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "impact_law.hpp"
#include "physics.hpp"
#include "setup.hpp"

namespace shakedown::apart {

/// One thing that pushes the box along x.
struct BoxPush {
  enum class Kind { viscous, quadratic, dry, steady, wave, pendulum, lopsided };
  Kind kind = Kind::steady;
  double strength = 0;  ///< N s/m, N s^2/m^2, N, N, N, N/m, N/m^2
  double frequency = 0, phase = 0, rate = 0;
  double length = 0;  ///< m
  int effect = -1;    ///< line in Setup::effects
};

/// One thing that accelerates all grains alike.
struct Field {
  Vec3 strength = Vec3::Zero();  ///< m/s^2
  double frequency = 0, phase = 0;
  bool wave = false;
  int effect = -1;
};

struct Model {
  bool held = false;
  double box_mass = 0, stiffness = 0, cubic = 0;  ///< kg, N/m, 1/m^2
  Vec3 half = Vec3::Zero();                       ///< m, inner half sizes
  double contact_time = 0;                        ///< s
  std::array<RestitutionLaw, contact_classes> restitution;
  std::array<double, contact_classes> friction{};
  double pull = 0, pull_of_walls = 0, reach = 0;  ///< N, N, m
  double air_linear = 0, air_quadratic = 0;       ///< N s/m, N s^2/m^2
  int air_effect = -1;
  double arc_length = 0;  ///< m; 0: straight
  int arc_effect = -1;
  std::vector<BoxPush> pushes;
  std::vector<Field> fields;
  std::uint64_t seed = 0;
};

/// Returns what this coding does differently of an effect that it knows; empty: it does not know it.
std::string_view known_effect(std::string_view name);

/// Returns a parameter, of an effect that this coding knows, which is neither at its default nor read here;
/// empty: there is none.
std::string_view unknown_parameter(const EffectChoice& choice);

/// Returns the model of a setup all of whose effects are known. `run` is the number of the run.
Model model_of(const Setup& setup, int run);

}  // namespace shakedown::apart
