// SPDX-License-Identifier: MIT
// The side walls rub with a coefficient of their own.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_side_wall_friction(const EffectChoice& choice, int, Physics& physics) {
  physics.contact.friction[static_cast<std::size_t>(ContactClass::side_wall)] = choice.number("coefficient");
}
}  // namespace

extern const EffectRecord side_wall_friction{
    .name = "side_wall_friction",
    .label = "friction of the side walls",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence = "Coulomb friction of the side walls, apart from that of the end walls.",
    .formula =
        "|J_t| <= mu J_n at the side walls; all else as in grain_friction, which end walls and grains keep",
    .source = "O. R. Walton and R. L. Braun, J. Rheol. 30, 949 (1986)",
    .limits =
        "Friction of the side walls pulls the box along its axis. Tangential restitution and stiffness are "
        "those "
        "of grain_friction, or its defaults.",
    .parameters = {{.name = "coefficient",
                    .required = true,
                    .low = 0,
                    .high = 1,
                    .typical = 0.4,
                    .sentence = "Coefficient of friction of a grain and a side wall.",
                    .example = "0.4"}},
    .claims = "friction of the side walls",
    .dissipative = true,
    .engines = {{"hard", {Fidelity::exact}},
                {"soft", {Fidelity::to_stated_error, "tangential spring as in grain_friction"}},
                {"lammps", {Fidelity::to_stated_error, "tangential spring as in grain_friction"}}},
    .search = {.not_searched = "A diagnosis looks for friction as one number, of grains and walls alike."},
    .apply = &apply_side_wall_friction,
    .applied_last = true};

}  // namespace shakedown::effect
