// SPDX-License-Identifier: MIT
// The rows of a picture are read one after the other (rolling shutter).
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_shutter(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.shutter = choice.number("time");
}
}  // namespace

extern const EffectRecord camera_shutter{
    .name = "camera_shutter",
    .label = "rolling shutter",
    .acts_on = ActsOn::camera,
    .sentence = "Each thing is seen the later the farther along the track it is.",
    .formula = "x_recorded(t) = x(t + s x/0.4 m)",
    .source =
        "C. K. Liang, L. W. Chang and H. H. Chen, Analysis and compensation of rolling shutter effect, IEEE "
        "Transactions on Image Processing 17 (2008) 1323",
    .limits =
        "Rows across the track, read along it at an even rate; the centre of the grains is taken for one "
        "thing at its own place.",
    .parameters = {{.name = "time",
                    .unit = "s",
                    .required = true,
                    .low = -0.05,
                    .high = 0.05,
                    .neutral = 0,
                    .typical = 0.001,
                    .sentence = "Time to read 0.4 m of the track; negative: read against +x."}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .camera = {&Camera::shutter, true},
    .camera_error = {.known_as = "camera.shutter",
                     .usual = 0.003},  // s; a frame of 10 to 30 ms seen to a part
    .apply = &apply_camera_shutter};

}  // namespace shakedown::effect
