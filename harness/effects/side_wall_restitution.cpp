// SPDX-License-Identifier: MIT
// The side walls apart from the end walls.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_side_wall_restitution(const EffectChoice& choice, int, Physics& physics) {
  physics.contact.restitution[static_cast<std::size_t>(ContactClass::side_wall)] =
      choice.number("restitution");
}
}  // namespace

extern const EffectRecord side_wall_restitution{
    .name = "side_wall_restitution",
    .label = "restitution of the side walls",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence = "Normal restitution of the side walls, apart from that of the end walls.",
    .formula = "eps of grain and side wall = restitution; end walls keep restitution.grain_wall",
    .source =
        "M. N. Bannerman et al., Movers and shakers: granular damping in microgravity, Phys. Rev. E 84, "
        "011301 (2011); it uses one value for all walls",
    .limits = "Constant in the speed unless velocity_dependent_restitution is on as well.",
    .parameters = {{.name = "restitution",
                    .default_value = 0.76,
                    .required = true,
                    .low = 0,
                    .high = 1,
                    .typical = 0.6,
                    .sentence = "Coefficient of normal restitution of a grain and a side wall."}},
    .claims = "restitution of the side walls",
    .engines =
        {{"hard", {Fidelity::exact}},
         {"soft",
          {Fidelity::to_stated_error, "restitution to second order in the time step, as at the other walls"}},
         {"bullet", {Fidelity::exact}},
         {"lammps",
          {Fidelity::to_stated_error, "restitution to first order in the time step, as at the other walls"}}},
    // Known to 0.2 of that of the end walls; below 0.05 grains stay at the wall.
    .search = {.strengths = {{.parameters = "restitution",
                              .typical = -0.2,
                              .levels = {-0.1, 0.15, -0.2, -0.4, -0.6},
                              .low = 0.05,
                              .high = 0.999,
                              .absent_key = "restitution.grain_wall",
                              .strongest = -0.66}}},
    .apply = &apply_side_wall_restitution};

}  // namespace shakedown::effect
