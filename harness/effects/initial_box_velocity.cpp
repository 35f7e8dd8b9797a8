// SPDX-License-Identifier: MIT
// A hand that lets go with a push.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_initial_box_velocity(const EffectChoice& choice, int, Physics& physics) {
  physics.initial_box_velocity = choice.number("velocity");
}
}  // namespace

extern const EffectRecord initial_box_velocity{
    .name = "initial_box_velocity",
    .label = "push at the release",
    .family = "release",
    .acts_on = ActsOn::box,
    .sentence = "Velocity of the box at release.",
    .formula = "v_box(0) = v",
    .source =
        "M. N. Bannerman et al., Movers and shakers: granular damping in microgravity, Phys. Rev. E 84, "
        "011301 (2011), assumes release at rest",
    .limits = "The grains start at rest in the lab (up to their small random velocities), not with the box.",
    .parameters = {{.name = "velocity",
                    .unit = "m/s",
                    .required = true,
                    .low = -10,
                    .high = 10,
                    .neutral = 0,
                    .typical = 0.02,
                    .sentence = "Velocity of the box at release, along +x.",
                    .unit_shown = "mm/s"}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .apply = &apply_initial_box_velocity};

}  // namespace shakedown::effect
