// SPDX-License-Identifier: MIT
// A Duffing spring: stiffer or softer at large amplitude.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_spring_cubic(const EffectChoice& choice, int, Physics& physics) {
  const double given = choice.number("reference"),
               displacement = given > 0 ? given : physics.release_displacement;
  if (displacement == 0)
    throw InputError({{choice.place, "spring_cubic", "has no scale (release.displacement is 0)",
                       "give spring_cubic.reference"}});
  physics.spring_cubic = choice.number("coefficient") / (displacement * displacement);
}
}  // namespace

extern const EffectRecord spring_cubic{
    .name = "spring_cubic",
    .label = "cubic term of the spring",
    .family = "spring",
    .acts_on = ActsOn::box,
    .sentence = "Spring force with a cubic term.",
    .formula = "F = -k x (1 + b (x/Delta0)^2), Delta0 the reference, or else the release displacement",
    .source =
        "G. Duffing, Erzwungene Schwingungen bei veraenderlicher Eigenfrequenz (Vieweg, 1918); A. H. Nayfeh "
        "and D. T. Mook, Nonlinear Oscillations (Wiley, 1979)",
    .limits = "Symmetric in x; for b < 0 the force vanishes at x = Delta0/sqrt(-b), so b >= -0.5.",
    .parameters =
        {{.name = "coefficient",
          .required = true,
          .low = -0.5,
          .high = 10,
          .neutral = 0,
          .typical = 0.04,
          .sentence = "Relative change of the stiffness force at the reference; of either sign."},
         {.name = "reference",
          .unit = "m",
          .default_value = 0.0,
          .low = 0,
          .high = 10,
          .sentence = "Displacement of the coefficient; 0: the release displacement of the run. Runs of one "
                      "spring with other releases share one."}},
    .claims = "spring force",
    .engines = {{"hard",
                 {Fidelity::to_stated_error, "box motion dense to 1e-13 of the release displacement"}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "Runge-Kutta within each time step, error below rounding; the ledger closes to 1e-9"}},
                {"lammps",
                 {Fidelity::to_stated_error, "a variable of the place; Verlet's error, 1e-8 of the energy"}}},
    .search = {.strengths = {{.parameters = "coefficient", .strongest = 0.8}}},
    .on_page = {.integrated = true},
    .apply = &apply_spring_cubic};

}  // namespace shakedown::effect
