// SPDX-License-Identifier: MIT
#include "effects.hpp"
#include "known_effects.hpp"

#include <array>

// The list of effects, in the order of the documentation. A new effect is one file that defines
// `shakedown::effect::its_name`, and one line here. An explicit list, because a linker drops what registers
// itself from a static library.
#define SHAKEDOWN_EFFECTS(EFFECT)        \
  EFFECT(grain_friction)                 \
  EFFECT(grain_rolling_resistance)       \
  EFFECT(velocity_dependent_restitution) \
  EFFECT(fluctuating_restitution)        \
  EFFECT(grain_cohesion)                 \
  EFFECT(side_wall_restitution)          \
  EFFECT(side_wall_friction)             \
  EFFECT(grain_polydispersity)           \
  EFFECT(blade_viscous_damping)          \
  EFFECT(blade_quadratic_drag)           \
  EFFECT(clamp_dry_friction)             \
  EFFECT(clamp_dahl_friction)            \
  EFFECT(spring_cubic)                   \
  EFFECT(spring_quadratic)               \
  EFFECT(pendulum)                       \
  EFFECT(second_mode)                    \
  EFFECT(blade_mass)                     \
  EFFECT(initial_box_velocity)           \
  EFFECT(initial_packing)                \
  EFFECT(constant_acceleration)          \
  EFFECT(oscillating_acceleration)       \
  EFFECT(base_motion)                    \
  EFFECT(grain_air_drag)                 \
  EFFECT(blade_arc)                      \
  EFFECT(camera_com_bias)                \
  EFFECT(camera_scale)                   \
  EFFECT(camera_time_offset)             \
  EFFECT(camera_drift)                   \
  EFFECT(camera_arc)                     \
  EFFECT(camera_lens)                    \
  EFFECT(camera_tilt)                    \
  EFFECT(camera_shutter)                 \
  EFFECT(camera_depth)                   \
  EFFECT(camera_origin)                  \
  EFFECT(user_force)                     \
  EFFECT(user_restitution)               \
  EFFECT(user_friction)

namespace shakedown {

namespace effect {
#define SHAKEDOWN_DECLARE(name) extern const EffectRecord name;
SHAKEDOWN_EFFECTS(SHAKEDOWN_DECLARE)
#undef SHAKEDOWN_DECLARE
}  // namespace effect

KnownEffects all_effects() {
#define SHAKEDOWN_ADDRESS(name) &effect::name,
  static constexpr std::array effects{SHAKEDOWN_EFFECTS(SHAKEDOWN_ADDRESS)};
#undef SHAKEDOWN_ADDRESS
  return effects;
}

const EffectRecord* find_effect(std::string_view name) { return all_effects().find(name); }

}  // namespace shakedown
