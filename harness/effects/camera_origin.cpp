// SPDX-License-Identifier: MIT
// Recorded positions are not counted from where the spring is relaxed.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.origin = choice.number("origin");
}
}  // namespace

extern const EffectRecord camera_origin{
    .name = "camera_origin",
    .label = "origin of recorded positions",
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
                    .sentence = "Recorded position of the place where the spring is relaxed.",
                    .unit_shown = "mm"}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .search = {.strengths = {{.parameters = "origin", .strongest = 0.02}}},
    .apply = &apply};

}  // namespace shakedown::effect
