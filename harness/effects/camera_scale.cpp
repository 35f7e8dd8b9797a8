// SPDX-License-Identifier: MIT
// A wrong number of millimetres per pixel.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_scale(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.scale = choice.number("scale");
}
}  // namespace

extern const EffectRecord camera_scale{
    .name = "camera_scale",
    .label = "scale of the camera",
    .acts_on = ActsOn::camera,
    .sentence = "All recorded lengths are too long by a factor.",
    .formula = "x_recorded = (1 + s) x",
    .source =
        "C. Tropea, A. L. Yarin and J. F. Foss (eds.), Springer Handbook of Experimental Fluid Mechanics "
        "(2007), on the calibration of cameras",
    .limits = "One factor over the whole picture: no distortion by the lens.",
    .parameters = {{.name = "scale",
                    .required = true,
                    .low = -0.5,
                    .high = 0.5,
                    .neutral = 0,
                    .typical = 0.01,
                    .sentence = "Relative error of recorded lengths."}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .search = {.strengths = {{.parameters = "scale", .strongest = 0.2}}},
    .camera = {&Camera::scale},
    .camera_error = {.known_as = "camera.scale", .usual = 0.005},  // a ruler filmed by eye
    .on_page = {.reach = 0.03},
    .apply = &apply_camera_scale};

}  // namespace shakedown::effect
