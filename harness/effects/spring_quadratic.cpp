// SPDX-License-Identifier: MIT
// A spring that is stiffer to one side: preloaded, or clamped on one side only.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_spring_quadratic(const EffectChoice& choice, int index, Physics& physics) {
  const double stiffness = physics.stiffness,
               per_metre = choice.number("coefficient") / choice.number("reference");
  physics.box.free.push_back(
      {[=](double x, double, double) { return -stiffness * per_metre * x * x; }, index});
}
}  // namespace

extern const EffectRecord spring_quadratic{
    .name = "spring_quadratic",
    .label = "spring stiffer to one side",
    .family = "even harmonics",
    .acts_on = ActsOn::box,
    .sentence = "Spring force with a term in the square of the displacement: even harmonics in the swing.",
    .formula = "F = -k x (1 + b x/x0), x0 the reference",
    .source =
        "A. H. Nayfeh and D. T. Mook, Nonlinear Oscillations (Wiley, 1979), section 2.3: quadratic "
        "nonlinearity",
    .limits = "The force vanishes at x = -x0/b; the swing stays nearer.",
    .parameters = {{.name = "coefficient",
                    .required = true,
                    .low = -0.5,
                    .high = 0.5,
                    .neutral = 0,
                    .typical = 0.01,
                    .sentence = "Relative change of the stiffness force at the reference; of either sign."},
                   {.name = "reference",
                    .unit = "m",
                    .default_value = 0.1,
                    .low = 1e-4,
                    .high = 10,
                    .typical = 0.1,
                    .sentence = "Displacement of the coefficient."}},
    .engines = {{"hard",
                 {Fidelity::to_stated_error, "box motion dense to 1e-13 of the release displacement"}},
                {"soft",
                 {Fidelity::to_stated_error, "second order in the time step; the ledger closes to 1e-9"}},
                {"lammps",
                 {Fidelity::to_stated_error, "a variable of the place; Verlet's error, 1e-8 of the energy"}}},
    .search = {.not_searched = "Only the waveform of an empty box tells it.", .in_waveform = true},
    .on_page = {.integrated = true},
    .apply = &apply_spring_quadratic};

}  // namespace shakedown::effect
