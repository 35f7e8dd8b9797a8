// SPDX-License-Identifier: MIT
#include "rules.hpp"

#include <array>

namespace shakedown {

std::span<const Rule> diagnosis_rules() {
  static constexpr std::array all{rules::adds_effect,    rules::answer_set,     rules::expected_effects,
                                  rules::something_else, rules::emulator_noise, rules::doubtful,
                                  rules::holds_well,     rules::holds,          rules::codes_differ,
                                  rules::stands_out,     rules::explains,       rules::most_effects,
                                  rules::most_tried,     rules::for_the_search};
  return all;
}

}  // namespace shakedown
