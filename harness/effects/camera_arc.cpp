// SPDX-License-Identifier: MIT
// The box tilts on the blade, and a camera above sees the grains foreshortened.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_arc(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.arc_length = choice.number("blade_length");
}
}  // namespace

extern const EffectRecord camera_arc{
    .name = "camera_arc",
    .label = "tilt of the box as the camera sees it",
    .family = "camera of the centre",
    .acts_on = ActsOn::camera,
    .sentence = "The recorded centre of the grains is foreshortened by the tilt of the box on its blade.",
    .formula = "x_recorded = x_box + (x_com - x_box) cos(1.5 x_box/l)",
    .source =
        "M. N. Bannerman et al., Movers and shakers: granular damping in microgravity, Phys. Rev. E 84, "
        "011301 (2011), its explanation of the misfit of x_COM; slope 1.5 x/l at the tip of a cantilever: S. "
        "P. Timoshenko and J. M. Gere, Mechanics of Materials",
    .limits =
        "Small deflection; the grains in the plane of the box's middle. Looks like camera_com_bias at one "
        "amplitude. As l grows the effect vanishes; there is no neutral value.",
    .parameters = {{.name = "blade_length",
                    .unit = "m",
                    .default_value = 0.59,
                    .low = 0.05,
                    .high = 1000,
                    .typical = 0.59,
                    .sentence = "Free length of the blade.",
                    .unit_shown = "mm"}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .search = {.strengths = {{.parameters = "blade_length",
                              .typical = 0.59,
                              .levels = {1.2, 0.59, 0.3},
                              .low = 0.2,
                              .high = 3,
                              .inverse = true,
                              .strongest = 0.12}}},
    .camera = {&Camera::arc_length, true},
    .apply = &apply_camera_arc};

}  // namespace shakedown::effect
