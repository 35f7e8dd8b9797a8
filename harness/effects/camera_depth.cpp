// SPDX-License-Identifier: MIT
// The grains are not as far from the lens as the marker on the box.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_depth(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.depth = choice.number("depth");
}
}  // namespace

extern const EffectRecord camera_depth{
    .name = "camera_depth",
    .label = "depth of the grains behind the marker",
    .acts_on = ActsOn::camera,
    .sentence = "The recorded centre of the grains is enlarged about the optical axis.",
    .formula = "x_recorded = (1 + d) x_com",
    .source =
        "C. Tropea, A. L. Yarin and J. F. Foss (eds.), Springer Handbook of Experimental Fluid Mechanics "
        "(2007), on the calibration of cameras",
    .limits =
        "A pinhole far away: d = distance of the marker over that of the grains, minus one. The optical axis "
        "meets the track at x = 0.",
    .parameters =
        {{.name = "depth",
          .required = true,
          .low = -0.5,
          .high = 0.5,
          .neutral = 0,
          .typical = 0.005,
          .sentence =
              "Relative enlargement of the grains against the marker; positive: the grains are nearer."}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .camera = {&Camera::depth, true},
    .camera_error = {.known_as = "camera.depth", .usual = 0.005},  // 5 mm behind the marker at 1 m
    .apply = &apply_camera_depth};

}  // namespace shakedown::effect
