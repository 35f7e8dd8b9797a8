// SPDX-License-Identifier: MIT
#include "engine_differences.hpp"

#include <array>
#include <cmath>

namespace shakedown {

namespace {

// From effects_crosscheck with 128 soft runs (plain model at 104 mm), 96 (friction), 48 (constant
// acceleration at 104 mm), 32 (plain model, cohesion, both restitutions), 20 (polydispersity,
// viscous damping) and 8 (the others).
constexpr auto measured = std::to_array<EngineDifference>({
    {"", 0.040, -0.0081809, -3.33e-05, 1.75e-05},
    {"", 0.104, -0.0269969, -0.0001742, 8.99e-05},
    {"grain_friction", 0.040, -0.008801, -2.24e-05, 1.09e-05},
    {"grain_friction", 0.104, -0.0302028, -0.0003495, 0.000191},
    {"velocity_dependent_restitution", 0.040, -0.007309, -2.15e-05, 1.97e-05},
    {"velocity_dependent_restitution", 0.104, -0.0276164, -2.93e-05, 0.0001318},
    {"grain_cohesion", 0.040, -0.0083297, -0.0001606, 6.76e-05},
    {"grain_cohesion", 0.104, -0.0273333, 0.0001657, 0.000216},
    {"side_wall_restitution", 0.040, -0.0083348, -6.03e-05, 1.73e-05},
    {"side_wall_restitution", 0.104, -0.0275807, -6.78e-05, 0.0001469},
    {"grain_polydispersity", 0.040, -0.0081485, -3.81e-05, 5.73e-05},
    {"grain_polydispersity", 0.104, -0.0270333, -0.0002003, 0.0002515},
    {"blade_viscous_damping", 0.040, -0.0106334, -3.49e-05, 2.69e-05},
    {"blade_viscous_damping", 0.104, -0.0283368, -0.0001322, 0.0003201},
    {"blade_quadratic_drag", 0.040, -0.0088891, -3.42e-05, 2.73e-05},
    {"blade_quadratic_drag", 0.104, -0.0272321, -0.0001051, 0.0003367},
    {"clamp_dry_friction", 0.040, -0.0113125, -4.14e-05, 5.05e-05},
    {"clamp_dry_friction", 0.104, -0.0297186, -0.0001619, 0.0003648},
    {"spring_cubic", 0.040, -0.0081887, -4.43e-05, 2.56e-05},
    {"spring_cubic", 0.104, -0.0270864, -1.87e-05, 0.0002791},
    {"blade_mass", 0.040, -0.0079836, -3.91e-05, 1.85e-05},
    {"blade_mass", 0.104, -0.0263628, 0.0003162, 0.0002525},
    {"initial_box_velocity", 0.040, -0.0081662, -3.92e-05, 5.87e-05},
    {"initial_box_velocity", 0.104, -0.0270147, -0.0002785, 0.0002082},
    {"initial_packing", 0.040, -0.0081792, -1.78e-05, 3.54e-05},
    {"initial_packing", 0.104, -0.0269884, -1.3e-05, 0.0005792},
    {"constant_acceleration", 0.040, -0.0080318, -2.9e-06, 5.41e-05},
    {"constant_acceleration", 0.104, -0.0258326, -0.0001785, 0.0002781},
    {"oscillating_acceleration", 0.040, -0.008965, -4.72e-05, 3e-05},
    {"oscillating_acceleration", 0.104, -0.0332593, -0.000122, 0.0003535},
    {"grain_air_drag", 0.040, -0.0082629, -5.26e-05, 3.84e-05},
    {"grain_air_drag", 0.104, -0.027465, -4.62e-05, 0.0003907},
    {"blade_arc", 0.040, -0.0080889, -5.45e-05, 4.82e-05},
    {"blade_arc", 0.104, -0.0271491, -0.000163, 0.000383},
    {"user_force", 0.040, -0.0100438, -8.2e-06, 4.6e-05},
    {"user_force", 0.104, -0.0276079, 1.93e-05, 0.0002223},
});

const EngineDifference* row_of(std::string_view effect, double box_length) {
  for (const EngineDifference& row : measured)
    if (row.effect == effect && std::abs(row.box_length - box_length) < 1e-6) return &row;
  return nullptr;
}

}  // namespace

std::span<const EngineDifference> engine_differences() { return measured; }

std::optional<AddedDifference> added_difference(std::string_view effect, double box_length) {
  const EngineDifference *plain = row_of("", box_length),
                         *with = effect.empty() ? nullptr : row_of(effect, box_length);
  if (plain == nullptr || with == nullptr) return std::nullopt;
  return AddedDifference{with->hard_slope - plain->hard_slope, with->hard_minus_soft - plain->hard_minus_soft,
                         std::hypot(with->half_width, plain->half_width)};
}

double strength_uncertainty(std::string_view effect) {
  double squares = 0, weights = 0;
  for (const EngineDifference& row : measured) {
    if (row.effect != effect) continue;
    const std::optional<AddedDifference> found = added_difference(effect, row.box_length);
    if (!found) continue;
    const double weight = std::pow(found->change / found->half_width, 2);
    weights += weight;
    if (std::abs(found->added) > found->half_width)
      squares += weight * std::pow(found->added / found->change, 2);
  }
  return weights > 0 ? std::sqrt(squares / weights) : 0;
}

}  // namespace shakedown
