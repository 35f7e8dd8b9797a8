// SPDX-License-Identifier: MIT
#include "packed_json.hpp"

namespace shakedown {

nlohmann::ordered_json packed_json(const std::vector<double>& values, double parts) {
  using Json = nlohmann::ordered_json;
  const PackedNumbers numbers = packed(values, parts);
  Json steps = Json::array();
  for (const auto& step : numbers.steps) steps.push_back(step ? Json(*step) : Json(nullptr));
  return {{"q", numbers.quantum}, {"d", std::move(steps)}};
}

}  // namespace shakedown
