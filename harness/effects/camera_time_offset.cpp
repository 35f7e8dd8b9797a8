// SPDX-License-Identifier: MIT
// The clock of the camera does not start at the release.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_time_offset(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.time_offset = choice.number("offset");
}
}  // namespace

extern const EffectRecord camera_time_offset{
    .name = "camera_time_offset",
    .label = "offset of the camera's clock",
    .family = "release",
    .acts_on = ActsOn::camera,
    .sentence = "Recorded times are shifted.",
    .formula = "t_recorded = t + t0",
    .source = "Bookkeeping of the measurement: the frame of the release is known to about one frame",
    .limits = "Constant; a wrong frame rate is not described.",
    .parameters = {{.name = "offset",
                    .unit = "s",
                    .required = true,
                    .low = -10,
                    .high = 10,
                    .neutral = 0,
                    .typical = 0.002,
                    .sentence = "Recorded time minus time since release.",
                    .unit_shown = "ms"}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .search = {.strengths = {{.parameters = "offset", .strongest = 0.04}}},
    .camera = {&Camera::time_offset},
    .camera_error = {.known_as = "camera.trigger", .usual = 0.001, .each_run = true},  // s; half a frame
    .apply = &apply_camera_time_offset};

}  // namespace shakedown::effect
