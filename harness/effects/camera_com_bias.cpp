// SPDX-License-Identifier: MIT
// The centre of mass of what a camera sees is drawn towards the middle of the box.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_camera_com_bias(const EffectChoice& choice, int, Physics& physics) {
  physics.camera.centre_bias = choice.number("bias");
}
}  // namespace

extern const EffectRecord camera_com_bias{
    .name = "camera_com_bias",
    .label = "bias of the grains' recorded centre",
    .family = "camera of the centre",
    .acts_on = ActsOn::camera,
    .sentence = "The recorded centre of the grains lies too near to the middle of the box.",
    .formula = "x_recorded = x_box + (1 - b)(x_com - x_box)",
    .source =
        "M. N. Bannerman et al., Movers and shakers: granular damping in microgravity, Phys. Rev. E 84, "
        "011301 (2011), on its own images",
    .limits = "One factor at all amplitudes; see camera_arc for a bias that grows with the displacement.",
    .parameters = {{.name = "bias",
                    .required = true,
                    .low = -1,
                    .high = 1,
                    .neutral = 0,
                    .typical = 0.05,
                    .sentence = "Share of the distance to the middle that is lost."}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .camera = {&Camera::centre_bias, true},
    .apply = &apply_camera_com_bias};

}  // namespace shakedown::effect
