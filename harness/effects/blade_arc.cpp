// SPDX-License-Identifier: MIT
// The box follows the arc of the tip of a cantilever; the paper neglects it.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_blade_arc(const EffectChoice& choice, int index, Physics& physics) {
  physics.grains.arc_length = choice.number("blade_length");
  physics.grains.arc_effect = index;
}
}  // namespace

extern const EffectRecord blade_arc{
    .name = "blade_arc",
    .label = "arc of the box",
    .family = "spring",
    .acts_on = ActsOn::box,
    .sentence = "The box moves on the arc of the blade's tip, which throws the grains across.",
    .formula =
        "z_box = (3/5) x^2/l in the lab; transverse acceleration -(6/5)(v^2 + x a)/l of the grains in the "
        "frame of the box",
    .source =
        "M. N. Bannerman et al., Movers and shakers: granular damping in microgravity, Phys. Rev. E 84, "
        "011301 (2011), neglects it; the tip of a cantilever: S. P. Timoshenko and J. M. Gere, Mechanics of "
        "Materials",
    .limits =
        "Small deflection (x << l); the tilt of the box is left out. As l grows the effect vanishes; there "
        "is "
        "no neutral value.",
    .parameters = {{.name = "blade_length",
                    .unit = "m",
                    .default_value = 0.59,
                    .low = 0.05,
                    .high = 1000,
                    .typical = 0.59,
                    .sentence = "Free length of the blade.",
                    .unit_shown = "mm"}},
    .claims = "arc of the box",
    .engines = {{"hard", {Fidelity::exact}},
                {"soft",
                 {Fidelity::to_stated_error, "second order in the time step; the ledger closes to 1e-9"}}},
    .search = {.strengths = {{.parameters = "blade_length",
                              .typical = 0.59,
                              .levels = {1.2, 0.59, 0.3},
                              .low = 0.2,
                              .high = 3,
                              .inverse = true,
                              .strongest = 0.15}}},
    .apply = &apply_blade_arc};

}  // namespace shakedown::effect
