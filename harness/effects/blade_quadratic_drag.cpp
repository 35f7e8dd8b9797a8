// SPDX-License-Identifier: MIT
// Drag of the box and the blade in air at high Reynolds number.
#include <cmath>

#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_blade_quadratic_drag(const EffectChoice& choice, int index, Physics& physics) {
  const double drag = choice.number("drag");
  physics.box.free.push_back({[drag](double, double v, double) { return -drag * v * std::abs(v); }, index});
}
}  // namespace

extern const EffectRecord blade_quadratic_drag{
    .name = "blade_quadratic_drag",
    .label = "quadratic drag of the box",
    .family = "drag",
    .acts_on = ActsOn::box,
    .sentence = "Drag of the box that grows as the square of its speed.",
    .formula = "F = -c v |v|",
    .source = "A. H. Nayfeh and D. T. Mook, Nonlinear Oscillations (Wiley, 1979), chapter 3",
    .limits =
        "For air c = C_D rho A/2; a plate of 60 mm by 60 mm has about 0.0025 N s^2/m^2. An oscillating body "
        "sheds vortices, so C_D depends on the amplitude.",
    .parameters = {{.name = "drag",
                    .unit = "N s^2/m^2",
                    .required = true,
                    .low = 0,
                    .high = 10,
                    .neutral = 0,
                    .typical = 0.03,
                    .sentence = "Force divided by the square of the speed."}},
    .dissipative = true,
    .engines = {{"hard",
                 {Fidelity::to_stated_error, "box motion dense to 1e-13 of the release displacement"}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "Runge-Kutta within each time step, error below rounding; the ledger closes to 1e-9"}},
                {"lammps",
                 {Fidelity::to_stated_error,
                  "a variable of the velocity half a time step earlier: 6e-5 of the force at the default "
                  "step, out of phase with it"}}},
    .search = {.strengths = {{.parameters = "drag", .strongest = 0.6}}},
    .on_page = {.integrated = true},
    .apply = &apply_blade_quadratic_drag};

}  // namespace shakedown::effect
