// SPDX-License-Identifier: MIT
// A nuisance to rule out, listed like an effect.
#include "physics.hpp"
#include "setup_keys.hpp"

namespace shakedown::effect {

namespace {
void apply_initial_packing(const EffectChoice& choice, int, Physics& physics) {
  physics.packing = packing_of(choice.text("packing"));
}
}  // namespace

extern const EffectRecord initial_packing{
    .name = "initial_packing",
    .label = "arrangement of the grains at release",
    .acts_on = ActsOn::grains,
    .sentence = "Another arrangement of the grains at release.",
    .formula = "fcc or square layers on the outer wall, random in a layer, spread over the box",
    .source =
        "M. N. Bannerman et al., Movers and shakers: granular damping in microgravity, Phys. Rev. E 84, "
        "011301 (2011), does not publish its lattice",
    .limits = "Another packing moves peaks by 1 to 4 mm, late ones most.",
    .parameters = {{.name = "packing",
                    .kind = ParameterKind::choice,
                    .default_value = std::string("square"),
                    .required = true,
                    .sentence = "The arrangement.",
                    .choices = {"fcc", "square", "random", "spread"}}},
    .claims = "release.packing",
    .engines = {{every_engine, {Fidelity::exact}}},
    .search = {.not_searched = "How a run was released is not a law of physics; every fit allows for it."},
    .nuisance = true,
    .apply = &apply_initial_packing};

}  // namespace shakedown::effect
