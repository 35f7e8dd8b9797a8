// SPDX-License-Identifier: MIT
// Rolling resistance: a torque against the relative rolling of two surfaces that press on each other.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply(const EffectChoice& choice, int, Physics& physics) {
  const double wall = choice.number("grain_wall");
  physics.contact.rolling_resistance = {choice.number("grain_grain"), wall, wall};
}
}  // namespace

extern const EffectRecord grain_rolling_resistance{
    .name = "grain_rolling_resistance",
    .label = "rolling resistance of the grains",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence = "A torque against the rolling of grains on each other and on the walls.",
    .formula =
        "T = -mu_r R F_n W/|W|, W the spin relative to the partner's across the normal, 1/R = 1/R_i + 1/R_j, "
        "at a "
        "wall R = R_i; hard spheres: an angular impulse of mu_r R J_n against W, or what stops it where that "
        "is "
        "less",
    .source =
        "J. Ai, J.-F. Chen, J. M. Rotter and J. Y. Ooi, Powder Technol. 206, 269 (2011), model A; Y. C. Zhou "
        "et "
        "al., Physica A 269, 536 (1999)",
    .limits =
        "Grains spin by friction alone: without grain_friction this does nothing. No torque against spin "
        "about "
        "the normal. No spring: what rests on a slope creeps, by less than friction turns it in a step.",
    .parameters = {{.name = "grain_grain",
                    .low = 0,
                    .high = 1,
                    .neutral = 0,
                    .typical = 0.1,
                    .sentence = "Coefficient of rolling resistance between grains."},
                   {.name = "grain_wall",
                    .low = 0,
                    .high = 1,
                    .neutral = 0,
                    .typical = 0.1,
                    .sentence = "Coefficient of rolling resistance of a grain and a wall of the box."}},
    .claims = "rolling of grains",
    .dissipative = true,
    .engines = {{"hard",
                 {Fidelity::to_stated_error,
                  "between like grains the torque's impulse; at walls and between unlike grains the soft "
                  "engine's springs "
                  "and torque, integrated over each impact in the limit of short contacts"}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "no half step takes more than a quarter of the rolling: it stops within half a contact; "
                  "the ledger "
                  "closes to 1e-9"}}},
    .search = {.strengths = {{.parameters = "grain_grain&grain_wall",
                              .typical = 0.1,
                              .levels = {0.03, 0.1, 0.3},
                              .strongest = 0.8}},
               .cost = Search::Cost::dear,
               .odds = 0.135},
    .needs = "grain_friction",
    .apply = &apply};

}  // namespace shakedown::effect
