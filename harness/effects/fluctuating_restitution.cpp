// SPDX-License-Identifier: MIT
// Restitution that differs from impact to impact, as that of rough grains does.
#include <algorithm>
#include <bit>
#include <cstdint>

#include "physics.hpp"
#include "random.hpp"

namespace shakedown::effect {

namespace {
/// Draws a normal deviate from the bits of the closing speed, which no two impacts share: both engines call
/// the law with that number alone, a run repeats to the last bit, and threads need no generator.
double deviate(ContactClass kind, double closing_speed) {
  return Random(std::bit_cast<std::uint64_t>(closing_speed), static_cast<std::uint64_t>(kind), Stream::other)
      .normal();
}

void apply_fluctuating_restitution(const EffectChoice& choice, int, Physics& physics) {
  const double deviation = choice.number("deviation");
  physics.contact.restitution_at = [mean = physics.contact.restitution, deviation](ContactClass kind,
                                                                                   double speed) {
    const double drawn = mean[static_cast<std::size_t>(kind)] + deviation * deviate(kind, speed);
    return std::clamp(drawn, 0.0, 1.0);
  };
}
}  // namespace

extern const EffectRecord fluctuating_restitution{
    .name = "fluctuating_restitution",
    .label = "scatter of the restitution",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence = "Normal restitution that scatters from impact to impact about the setup's values.",
    .formula = "eps = restitution + s xi, xi standard normal for each impact, kept between 0 and 1",
    .source = "M. Montaine et al., Phys. Rev. E 84, 041306 (2011)",
    .limits =
        "Impacts are independent of each other; the measured distribution is not normal but falls on each "
        "side as an exponential. Where the mean is within two deviations of 1 the cut lowers it.",
    .parameters = {{.name = "deviation",
                    .required = true,
                    .low = 0,
                    .high = 0.3,
                    .neutral = 0,
                    .typical = 0.05,
                    .sentence = "Standard deviation of the restitution."}},
    .claims = "normal restitution",
    .engines = {{"hard", {Fidelity::exact}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "linear spring-dashpot of the restitution drawn at first touch; the draws are others than "
                  "the hard engine's"}}},
    // Energy is lost as with the root mean square of the restitution, which 0.05 raises from 0.75 by 0.0017.
    .search = {.not_searched = "Refitted restitutions take up all of it but the scatter of single impacts."},
    .apply = &apply_fluctuating_restitution,
    .applied_last = true};

}  // namespace shakedown::effect
