// SPDX-License-Identifier: MIT
#include "rules.hpp"

#include <array>

namespace shakedown {

std::span<const Rule> diagnosis_rules() {
  using namespace rules;
  static constexpr std::array all{adds_effect,         answer_set,    expected_effects, something_else,
                                  emulator_noise,      doubtful,      holds_well,       holds,
                                  rules::codes_differ, stands_out,    explains,         most_effects,
                                  most_tried,          for_the_search};
  return all;
}

}  // namespace shakedown
