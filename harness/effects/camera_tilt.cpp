// SPDX-License-Identifier: MIT
// A camera that does not look at the track at right angles.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_tilt(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.tilt = choice.number("tilt");
}
}  // namespace

extern const EffectRecord camera_tilt{
    .name = "camera_tilt",
    .label = "camera that does not look at right angles",
    .family = "even harmonics",
    .acts_on = ActsOn::camera,
    .sentence =
        "What is nearer to the camera looks larger: one side of the track is stretched, the other squeezed.",
    .formula = "x_recorded = x (1 + b x/0.2 m)",
    .source =
        "R. Hartley and A. Zisserman, Multiple View Geometry in Computer Vision (Cambridge, 2003), section "
        "2.3: the projective map of a line, x/(1 - b x/0.2 m), to first order",
    .limits = "To first order in the tilt; what a spring that is stiffer to one side does looks alike.",
    .parameters = {{.name = "tilt",
                    .required = true,
                    .low = -0.3,
                    .high = 0.3,
                    .neutral = 0,
                    .typical = 0.01,
                    .sentence = "Relative error of a position 0.2 m from the optical axis."}},
    .engines = {{every_engine, {Fidelity::exact}}},
    // A degree or two is usual: one film in ten is taken from clearly aside.
    .search = {.odds = 0.1,
               .not_searched = "Only the waveform of an empty box tells it.",
               .in_waveform = true},
    .camera = {&Camera::tilt, true},
    .on_page = {.reach = 0.03},
    .apply = &apply_camera_tilt};

}  // namespace shakedown::effect
