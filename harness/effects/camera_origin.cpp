// SPDX-License-Identifier: MIT
// Recorded positions are not counted from where the spring is relaxed.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_origin(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.origin = choice.number("origin");
}
}  // namespace

extern const EffectRecord camera_origin{
    .name = "camera_origin",
    .label = "origin of the recorded positions",
    .acts_on = ActsOn::camera,
    .sentence = "All recorded positions are shifted.",
    .formula = "x_recorded = x + x0",
    .source =
        "C. Tropea, A. L. Yarin and J. F. Foss (eds.), Springer Handbook of Experimental Fluid Mechanics "
        "(2007), on the calibration of cameras",
    .limits = "Constant; see camera_drift for a mount that moves.",
    .parameters = {{.name = "origin",
                    .unit = "m",
                    .required = true,
                    .low = -1,
                    .high = 1,
                    .neutral = 0,
                    .typical = 0.0005,
                    .sentence = "Recorded position of the place where the spring is relaxed."}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .camera = {&Camera::origin},
    .camera_error = {.known_as = "camera.origin",
                     .usual = 0.0003,
                     .each_run = true,
                     .unknown = 0.1},  // m; a pixel or two
    .on_page = {.reach = 5e-3},
    .apply = &apply_camera_origin};

}  // namespace shakedown::effect
