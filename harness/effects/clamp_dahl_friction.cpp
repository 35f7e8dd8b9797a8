// SPDX-License-Identifier: MIT
// Friction of the clamp that yields before it slips.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
/// m; below, no camera tells yielding from slipping at once, and steps of the motion would have to be as
/// short.
constexpr double rigid = 1e-5;

void apply_clamp_dahl_friction(const EffectChoice& choice, int index, Physics& physics) {
  const double force = choice.number("force"), travel = choice.number("travel");
  if (!(force > 0)) return;
  if (travel < rigid)
    physics.box.dry_friction.add(force, index);
  else
    physics.box.dahl.push_back({force, travel, index});
}
}  // namespace

extern const EffectRecord clamp_dahl_friction{
    .name = "clamp_dahl_friction",
    .label = "friction of the clamp that yields before it slips",
    .family = "drag",
    .acts_on = ActsOn::box,
    .sentence = "Friction that acts as a spring after each turning point and slips further on (Dahl).",
    .formula = "F = -f, df/dx = (F0/travel) (1 - f sgn(v)/F0); unloaded at the release",
    .source = "P. R. Dahl, Aerospace Corporation TOR-0158(3107-18)-1 (1968); AIAA J. 14, 1675 (1976)",
    .limits =
        "Depends on the path, not on the speed; the state at the release is taken for unloaded and is "
        "forgotten after a few travels. A travel below 10 microns is clamp_dry_friction.",
    .parameters = {{.name = "force",
                    .unit = "N",
                    .required = true,
                    .low = 0,
                    .high = 10,
                    .neutral = 0,
                    .typical = 0.02,
                    .sentence = "Resistance when it slips.",
                    .unit_shown = "mN"},
                   {.name = "travel",
                    .unit = "m",
                    .required = true,
                    .low = 0,
                    .high = 1,
                    .typical = 0.005,
                    .sentence = "Way on which it comes up to that: the force over the stiffness before "
                                "slipping.",
                    .unit_shown = "mm"}},
    .dissipative = true,
    .engines = {{"hard",
                 {Fidelity::to_stated_error, "box motion dense to 1e-13 of the release displacement"}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "Runge-Kutta within each time step, error below rounding; the ledger closes to 1e-9"}}},
    // Metal joints yield over 2 to 50 microns (B. Armstrong-Helouvry, P. Dupont and C. Canudas de Wit,
    // Automatica 30, 1083 (1994)), which a camera sees as dry friction. About 10 microns, with a decade and a
    // half as standard deviation for bearings and soft clamps, one in ten has the millimetre that is seen.
    // The travels tried are middles of eight parts of that tail that are as likely as each other.
    .search = {.besides = {{"travel", 0.005}},
               .shapes = {{"travel", {0.00098, 0.00128, 0.00174, 0.00247, 0.00375, 0.0063, 0.0135, 0.056}}},
               .odds = 0.1},
    .on_page = {.integrated = true},
    .apply = &apply_clamp_dahl_friction};

}  // namespace shakedown::effect
