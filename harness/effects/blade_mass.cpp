// SPDX-License-Identifier: MIT
// The blade moves too, and its mass with the box.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_blade_mass(const EffectChoice& choice, int, Physics& physics) {
  physics.box_mass += choice.number("mass");
}
}  // namespace

extern const EffectRecord blade_mass{
    .name = "blade_mass",
    .label = "moving mass of the blade",
    .family = "camera of the centre",
    .acts_on = ActsOn::box,
    .sentence = "Moving mass added to the box while the spring constant stays.",
    .formula = "M -> M + dM, k unchanged",
    .source =
        "R. D. Blevins, Formulas for Natural Frequency and Mode Shape (1979): 33/140 of the mass of a "
        "uniform "
        "cantilever moves with its tip",
    .limits =
        "One rigid mass: higher modes of the blade are not described. When spring.frequency was measured on "
        "the real empty box it holds the blade already.",
    .parameters = {{.name = "mass",
                    .unit = "kg",
                    .required = true,
                    .low = 0,
                    .high = 10,
                    .neutral = 0,
                    .typical = 0.01,
                    .sentence = "Mass added to the box.",
                    .unit_shown = "g"}},
    .engines = {{every_engine, {Fidelity::exact}}},
    .on_page = {.integrated = true},
    .apply = &apply_blade_mass};

}  // namespace shakedown::effect
