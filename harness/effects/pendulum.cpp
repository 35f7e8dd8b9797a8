// SPDX-License-Identifier: MIT
// A box that hangs: gravity brings it back by the sine of its angle.
#include <cmath>

#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_pendulum(const EffectChoice& choice, int index, Physics& physics) {
  const double stiffness = physics.stiffness, length = choice.number("length");
  physics.box.free.push_back(
      {[=](double x, double, double) { return stiffness * (x - length * std::sin(x / length)); }, index});
}
}  // namespace

extern const EffectRecord pendulum{
    .name = "pendulum",
    .label = "pendulum: a sine brings the box back",
    .family = "spring",
    .acts_on = ActsOn::box,
    .sentence = "The restoring force is that of a pendulum, softer at large angles.",
    .formula = "F = -k l sin(x/l) in place of -k x, x along the arc, l the length",
    .source =
        "C. Huygens, Horologium oscillatorium (1673); L. D. Landau and E. M. Lifshitz, Mechanics, section "
        "11, problem 1",
    .limits = "The whole restoring force is gravity's; a spring beside it makes l longer than the pendulum.",
    .parameters = {{.name = "length",
                    .unit = "m",
                    .default_value = 0.5,
                    .required = true,
                    .low = 1e-3,
                    .high = 1e3,
                    .typical = 0.5,
                    .sentence = "Length from the axis to where x is measured: x/l is the angle."}},
    .engines = {{"hard",
                 {Fidelity::to_stated_error, "box motion dense to 1e-13 of the release displacement"}},
                {"soft",
                 {Fidelity::to_stated_error, "second order in the time step; the ledger closes to 1e-9"}},
                {"lammps", {Fidelity::to_stated_error, "a variable, second order in the step"}}},
    .search = {.strengths = {{.parameters = "length", .typical = 0.5, .inverse = true}},
               .not_searched = "Only the waveform of an empty box tells it from a softening spring.",
               .in_waveform = true},
    .on_page = {.integrated = true},
    .apply = &apply_pendulum};

}  // namespace shakedown::effect
