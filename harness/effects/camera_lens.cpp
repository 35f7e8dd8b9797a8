// SPDX-License-Identifier: MIT
// The picture is distorted towards its edges.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_lens(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.lens = choice.number("distortion");
}
}  // namespace

extern const EffectRecord camera_lens{
    .name = "camera_lens",
    .label = "distortion of the lens",
    .acts_on = ActsOn::camera,
    .sentence = "Recorded positions are stretched (or squeezed) with the distance from the optical axis.",
    .formula = "x_recorded = x (1 + d (x/0.2 m)^2)",
    .source =
        "D. C. Brown, Close-range camera calibration, Photogrammetric Engineering 37 (1971) 855: the first "
        "term of radial distortion",
    .limits =
        "The optical axis meets the track at x = 0; the next term, in the fourth power, is left out. Looks "
        "like camera_scale at one amplitude.",
    .parameters = {{.name = "distortion",
                    .required = true,
                    .low = -0.3,
                    .high = 0.3,
                    .neutral = 0,
                    .typical = 0.005,
                    .sentence =
                        "Relative error of a position 0.2 m from the optical axis; negative: barrel."}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .camera = {&Camera::lens, true},
    .camera_error = {.known_as = "camera.lens", .usual = 0.005},  // half a per cent: a phone, corrected
    .on_page = {.reach = 0.02},
    .apply = &apply_camera_lens};

}  // namespace shakedown::effect
