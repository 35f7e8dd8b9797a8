// SPDX-License-Identifier: MIT
// Dry friction where the blade is clamped.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_clamp_dry_friction(const EffectChoice& choice, int index, Physics& physics) {
  physics.box.dry_friction.add(choice.number("force"), index);
}
}  // namespace

extern const EffectRecord clamp_dry_friction{
    .name = "clamp_dry_friction",
    .label = "dry friction of the clamp",
    .family = "drag",
    .acts_on = ActsOn::box,
    .sentence = "Coulomb friction on the box that opposes its motion and can hold it still.",
    .formula = "F = -F0 sgn(v); at rest as much as balances spring and grains, up to F0",
    .source = "J. P. den Hartog, Trans. ASME 53, 107 (1931)",
    .limits =
        "One force for rest and motion; real joints slip bit by bit and lose energy at every amplitude.",
    .parameters = {{.name = "force",
                    .unit = "N",
                    .required = true,
                    .low = 0,
                    .high = 10,
                    .neutral = 0,
                    .typical = 0.02,
                    .sentence = "Friction force.",
                    .unit_shown = "mN"}},
    .dissipative = true,
    .engines = {{"hard", {Fidelity::exact}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "Runge-Kutta within each time step, error below rounding; the ledger closes to 1e-9"}},
                {"lammps",
                 {Fidelity::to_stated_error,
                  "smooth below 10 um/s or 10 F h/M (h the step): the box creeps instead of sticking"}}},
    .on_page = {.integrated = true},
    .apply = &apply_clamp_dry_friction};

}  // namespace shakedown::effect
