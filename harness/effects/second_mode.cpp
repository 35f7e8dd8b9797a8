// SPDX-License-Identifier: MIT
// A wobble: something else of the rig swings and drags the box along until it has died away.
#include <cmath>
#include <numbers>

#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_second_mode(const EffectChoice& choice, int index, Physics& physics) {
  const double force = physics.box_mass * choice.number("amplitude"), rate = choice.number("rate"),
               omega = 2 * std::numbers::pi * choice.number("frequency"), phase = choice.number("phase");
  physics.box.free.push_back(
      {[=](double, double, double t) { return force * std::exp(-rate * t) * std::sin(omega * t + phase); },
       index});
}
}  // namespace

extern const EffectRecord second_mode{
    .name = "second_mode",
    .label = "wobble: a second swing of the rig",
    .acts_on = ActsOn::box,
    .sentence = "Another part of the rig swings too and accelerates the box until it has died away.",
    .formula = "F = +M a exp(-g t) sin(2 pi f t + phi) on the box",
    .source =
        "L. Meirovitch, Elements of Vibration Analysis (McGraw-Hill, 1986), chapter 4: normal modes of two "
        "degrees of freedom",
    .limits =
        "The box does not drive it back: both frequencies are those that are seen, and a swing at nearly the "
        "box's own frequency (beats) is left unexplained.",
    .parameters = {{.name = "amplitude",
                    .unit = "m/s^2",
                    .required = true,
                    .low = 0,
                    .high = 100,
                    .neutral = 0,
                    .typical = 0.1,
                    .sentence = "Acceleration of the box at t = 0."},
                   {.name = "frequency",
                    .unit = "Hz",
                    .default_value = 1.0,
                    .low = 1e-3,
                    .high = 1e3,
                    .typical = 1,
                    .sentence = "Frequency of the second swing."},
                   {.name = "rate",
                    .unit = "1/s",
                    .default_value = 0.0,
                    .low = 0,
                    .high = 100,
                    .sentence = "How fast it dies away: to 1/e in the inverse of it."},
                   {.name = "phase",
                    .unit = "rad",
                    .default_value = 0.0,
                    .low = -10,
                    .high = 10,
                    .sentence = "Phase at t = 0."}},
    .engines = {{"hard",
                 {Fidelity::to_stated_error, "box motion dense to 1e-13 of the release displacement"}},
                {"soft",
                 {Fidelity::to_stated_error, "second order in the time step; the ledger closes to 1e-9"}},
                {"lammps", {Fidelity::to_stated_error, "a variable, second order in the step"}}},
    .search = {.harmonic = SearchedHarmonic{"amplitude", "frequency", "phase", "rate"},
               .not_searched = "Only the waveform of an empty box tells it.",
               .in_waveform = true},
    .on_page = {.integrated = true},
    .apply = &apply_second_mode,
    .applied_last = true};

}  // namespace shakedown::effect
