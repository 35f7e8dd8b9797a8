// SPDX-License-Identifier: MIT
// A contact effect as a user would add it: felt on the end walls.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply(const EffectChoice& choice, int, Physics& physics) {
  physics.contact.restitution[static_cast<std::size_t>(ContactClass::end_wall)] *= 1 - choice.number("loss");
}
}  // namespace

extern const EffectRecord felt_end_walls{
    .name = "felt_end_walls",
    .label = "felt on the end walls",
    .acts_on = ActsOn::contact,
    .sentence = "Felt on the end walls takes a share of the speed of rebound.",
    .formula = "eps of grain and end wall = restitution.grain_wall (1 - loss)",
    .source = "Written for this test",
    .limits = "One share at all speeds.",
    .parameters = {{.name = "loss",
                    .required = true,
                    .low = 0,
                    .high = 0.95,
                    .neutral = 0,
                    .typical = 0.3,
                    .sentence = "Share of the speed of rebound."}},
    .dissipative = true,
    .engines = {{"hard", {Fidelity::exact}}, {"soft", {Fidelity::exact}}},
    .apply = &apply,
    .applied_last = true};

}  // namespace shakedown::effect
