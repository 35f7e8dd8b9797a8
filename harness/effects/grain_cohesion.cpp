// SPDX-License-Identifier: MIT
// A constant attraction up to a gap: the simplest sticky grain, the same in both engines.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_grain_cohesion(const EffectChoice& choice, int index, Physics& physics) {
  physics.contact.attraction_force = choice.number("force");
  physics.contact.attraction_range = choice.number("range");
  physics.contact.attraction_of_walls = choice.number("walls");
  physics.contact.attraction_effect = index;
}
}  // namespace

extern const EffectRecord grain_cohesion{
    .name = "grain_cohesion",
    .label = "attraction of the grains",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence = "Grains attract each other, and the walls them, with a constant force up to a small gap.",
    .formula =
        "F towards each other for 0 <= gap <= d; hard spheres see a square well of depth F d and width d, "
        "entered with v_n^2 + 2 F d/mu and left only with more than F d",
    .source = "B. J. Alder and T. E. Wainwright, J. Chem. Phys. 31, 459 (1959), square wells",
    .limits =
        "The force has no memory of the contact (no hysteresis, no liquid volume). The range should stay "
        "small against the diameter. Bonds that hang at the edge of their well give way to a mean pull above "
        "F. Forces above the grain's mass times the box's top acceleration (26 mN for the paper's damper) "
        "glue grains together, and the engines part.",
    .parameters = {{.name = "force",
                    .unit = "N",
                    .low = 0,
                    .high = 10,
                    .neutral = 0,
                    .typical = 8e-3,
                    .sentence = "Attraction of two grains within the range.",
                    .unit_shown = "mN"},
                   {.name = "range",
                    .unit = "m",
                    .default_value = 2e-5,
                    .low = 1e-7,
                    .high = 2e-3,
                    .typical = 2e-5,
                    .sentence = "Gap between the surfaces up to which it acts.",
                    .unit_shown = "mm"},
                   {.name = "walls",
                    .default_value = 1.0,
                    .low = 0,
                    .high = 10,
                    .sentence =
                        "Attraction of a grain and a wall, of that of two grains; 0: the walls do not "
                        "attract (another material; magnetised grains in a box that is not)."}},
    .claims = "attraction of grains",
    .engines = {{"hard", {Fidelity::exact}},
                {"soft",
                 {Fidelity::to_stated_error, "second order in the time step; the ledger closes to 1e-9"}},
                {"lammps",
                 {Fidelity::to_stated_error,
                  "pair_style table beside granular, fix addforce at the walls; begins and ends at whole "
                  "steps, so that the well of one passage is too deep or too shallow by up to the way of a "
                  "step over the range, right on the average"}}},
    // What matters to moving grains is force times range, and to resting ones the force. Dry and electrified
    // grains attract each other over their roughness, some hundredths of a millimetre; a bridge of liquid
    // reaches to about the cube root of its volume (G. Lian, C. Thornton and M. J. Adams, J. Colloid
    // Interface Sci. 161, 138 (1993)), 0.2 mm for 0.01 mm^3. Walls that attract hold the layer from some 60
    // mN on, so that nothing is lost; walls that do not leave a clump that still falls from end to end (the
    // slope of the decay changes by 10 % up to 0.3 N). What 20 mN over 0.02 mm does is as much as hard wells
    // and soft contacts differ by (README.md): less is not looked for, it would be found in recordings of the
    // other kind. Over 0.2 mm that is 2 mN. Dry grains of some millimetres rarely stick: exp(-2).
    .search = {.strengths = {{.parameters = "force",
                              .typical = 8e-3,
                              .levels = {4e-3, 8e-3, 24e-3, 0.08, 0.24},
                              .low = 4e-3,
                              .high = 0.3,
                              .strongest = 64e-3}},
               .besides = {{"range", 2e-5}, {"walls", 1}},
               .shapes = {{"range", {2e-5, 2e-4}, {20e-3, 4e-3}}, {"walls", {0, 1}}},
               .cost = Search::Cost::slow,
               .odds = 0.135},
    // Films by the soft engine judged by the hard one with the same numbers, 0.2 mm: README.md.
    .codes_differ = 2.5,
    .apply = &apply_grain_cohesion};

}  // namespace shakedown::effect
