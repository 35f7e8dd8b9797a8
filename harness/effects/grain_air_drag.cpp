// SPDX-License-Identifier: MIT
// Air inside the closed box moves with it.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_grain_air_drag(const EffectChoice& choice, int index, Physics& physics) {
  physics.grains.drag.add({choice.number("linear"), choice.number("quadratic")}, index);
}
}  // namespace

extern const EffectRecord grain_air_drag{
    .name = "grain_air_drag",
    .label = "drag of the grains in air",
    .family = "drag",
    .acts_on = ActsOn::grains,
    .sentence = "Drag of the grains against air that moves with the box, which feels the reaction.",
    .formula =
        "F = -(c1 + c2 |u|) u, u the velocity of the grain minus that of the box; the box feels -F along the "
        "axis",
    .source = "R. Clift, J. R. Grace and M. E. Weber, Bubbles, Drops, and Particles (Academic Press, 1978)",
    .limits =
        "Air at rest in the box, no wakes, no lubrication. Stokes: c1 = 6 pi eta R = 1.7e-6 N s/m for 10 mm "
        "in air; at 1 m/s the Reynolds number is 670 and c2 = 2.6e-5 N s^2/m^2.",
    .parameters = {{.name = "linear",
                    .unit = "N s/m",
                    .low = 0,
                    .high = 1,
                    .neutral = 0,
                    .typical = 0.001,
                    .sentence = "Force on a grain divided by its speed."},
                   {.name = "quadratic",
                    .unit = "N s^2/m^2",
                    .low = 0,
                    .high = 1,
                    .neutral = 0,
                    .typical = 0.001,
                    .sentence = "Force on a grain divided by the square of its speed."}},
    .dissipative = true,
    .engines = {{"hard",
                 {Fidelity::to_stated_error,
                  "drag applied in small impulses, second order in hard.kick_interval (2 ms)"}},
                {"soft",
                 {Fidelity::to_stated_error, "second order in the time step; the ledger closes to 1e-9"}},
                {"lammps",
                 {Fidelity::to_stated_error,
                  "variables of the velocities half a step earlier, first order in the step"}}},
    // Air of 1 bar drags a grain some hundred times less (see limits) than such data can show: exp(-5).
    .search = {.strengths = {{.parameters = "linear", .levels = {1e-3, 2e-3, 4e-3}, .strongest = 0.02}},
               .cost = Search::Cost::slow,
               .odds = 0.0067},
    .apply = &apply_grain_air_drag};

}  // namespace shakedown::effect
