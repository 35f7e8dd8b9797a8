// SPDX-License-Identifier: MIT
// Linear damping of the box, whatever its cause: the blade, air at low speed, eddy currents.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_blade_viscous_damping(const EffectChoice& choice, int index, Physics& physics) {
  physics.box.viscous.add(choice.number("damping"), index);
}
}  // namespace

extern const EffectRecord blade_viscous_damping{
    .name = "blade_viscous_damping",
    .label = "linear damping of the box",
    .family = "drag",
    .acts_on = ActsOn::box,
    .sentence = "Linear damping of the box.",
    .formula = "F = -c v",
    .source = "L. D. Landau and E. M. Lifshitz, Mechanics, section 25",
    .limits =
        "Linear in the speed at all speeds; damping inside a steel blade depends on amplitude rather than "
        "frequency.",
    .parameters = {{.name = "damping",
                    .unit = "N s/m",
                    .required = true,
                    .low = 0,
                    .high = 10,
                    .neutral = 0,
                    .typical = 0.05,
                    .sentence = "Force divided by the speed of the box."}},
    .dissipative = true,
    .engines = {{"hard", {Fidelity::exact}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "Runge-Kutta within each time step, error below rounding; the ledger closes to 1e-9"}},
                {"lammps",
                 {Fidelity::to_stated_error,
                  "a variable of the velocity half a time step earlier: 6e-5 of the force at the default "
                  "step, out of phase with it"}}},
    .on_page = {.integrated = true},
    .apply = &apply_blade_viscous_damping};

}  // namespace shakedown::effect
