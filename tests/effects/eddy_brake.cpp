// SPDX-License-Identifier: MIT
// The README's example of a new effect: this file in harness/effects, and one line in effects.cpp. Setup
// keys, schema, listing, fit bounds, citation and the generic tests follow from the record.
#include <cmath>

#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_eddy_brake(const EffectChoice& choice, int index, Physics& physics) {
  const double damping = choice.number("damping"), centre = choice.number("centre"),
               width = choice.number("width");
  physics.box.free.push_back({[=](double x, double v, double) {
                                const double away = (x - centre) / width;
                                return -damping * v * std::exp(-away * away);
                              },
                              index});
}
}  // namespace

extern const EffectRecord eddy_brake{
    .name = "eddy_brake",
    .label = "eddy-current brake",
    .acts_on = ActsOn::box,
    .sentence = "A magnet beside the track brakes the box where it passes.",
    .formula = "F = -c v exp(-((x - x0)/w)^2)",
    .source = "J. D. Jackson, Classical Electrodynamics, section 5.18, on eddy currents",
    .limits = "Slow compared with the diffusion of the field into the metal.",
    .parameters = {{.name = "damping",
                    .unit = "N s/m",
                    .required = true,
                    .low = 0,
                    .high = 10,
                    .neutral = 0,
                    .typical = 0.2,
                    .sentence = "Force divided by the speed, at the centre."},
                   {.name = "centre",
                    .unit = "m",
                    .default_value = 0.045,
                    .low = -1,
                    .high = 1,
                    .typical = 0.045,
                    .sentence = "Position of the magnet."},
                   {.name = "width",
                    .unit = "m",
                    .default_value = 0.012,
                    .low = 1e-3,
                    .high = 1,
                    .typical = 0.012,
                    .sentence = "Reach of the magnet."}},
    .dissipative = true,
    .engines = {{"hard",
                 {Fidelity::to_stated_error, "box motion dense to 1e-13 of the release displacement"}},
                {"soft",
                 {Fidelity::to_stated_error, "second order in the time step; the ledger closes to 1e-9"}}},
    .apply = &apply_eddy_brake};

}  // namespace shakedown::effect
