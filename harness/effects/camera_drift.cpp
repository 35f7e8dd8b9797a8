// SPDX-License-Identifier: MIT
// The camera, or the table, moves slowly.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_drift(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.drift = choice.number("drift");
}
}  // namespace

extern const EffectRecord camera_drift{
    .name = "camera_drift",
    .label = "drift of the camera",
    .acts_on = ActsOn::camera,
    .sentence = "Recorded positions drift at a constant speed.",
    .formula = "x_recorded = x + u t",
    .source = "Bookkeeping of the measurement: thermal or mechanical drift of the mount",
    .limits = "Linear in time.",
    .parameters = {{.name = "drift",
                    .unit = "m/s",
                    .required = true,
                    .low = -1,
                    .high = 1,
                    .neutral = 0,
                    .typical = 1e-4,
                    .sentence = "Speed of the drift.",
                    .unit_shown = "mm/s"}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .search = {.strengths = {{.parameters = "drift", .strongest = 5e-3}}},
    .camera = {&Camera::drift},
    .on_page = {.reach = 1e-3},
    .apply = &apply_camera_drift};

}  // namespace shakedown::effect
