// SPDX-License-Identifier: MIT
// Grains of unequal size, drawn for each run from (seed, run).
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_grain_polydispersity(const EffectChoice& choice, int, Physics& physics) {
  physics.relative_diameter_deviation = choice.number("relative_deviation");
}
}  // namespace

extern const EffectRecord grain_polydispersity{
    .name = "grain_polydispersity",
    .label = "unequal sizes of the grains",
    .acts_on = ActsOn::grains,
    .sentence = "Diameters of the grains scatter, masses as the cube of the diameter.",
    .formula =
        "d_i = d (1 + s xi_i), xi standard normal, cut at 2.5; m_i proportional to d_i^3 with the total N m "
        "kept",
    .source = "Sampling of this project; balls of one grade by ISO 3290-1 scatter less than 0.1 %",
    .limits =
        "The release packing is relaxed until nothing overlaps; tight packings of very unequal grains may "
        "not "
        "fit.",
    .parameters = {{.name = "relative_deviation",
                    .low = 0,
                    .high = 0.2,
                    .neutral = 0,
                    .typical = 0.05,
                    .sentence = "Standard deviation of the diameter divided by its mean."}},
    .claims = "diameters of the grains",
    .engines =
        {{"lammps",
          {Fidelity::not_modelled,
           "its contacts have one set of constants, for grains of one size; use --engine hard or soft"}},
         {every_engine, {Fidelity::exact}}},
    .search = {.strengths = {{.parameters = "relative_deviation", .strongest = 0.1}}},
    .apply = &apply_grain_polydispersity};

}  // namespace shakedown::effect
