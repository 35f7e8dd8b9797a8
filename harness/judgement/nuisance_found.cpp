// SPDX-License-Identifier: MIT
#include "nuisance_found.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace shakedown {

std::string nuisances_text(const std::vector<NuisanceFound>& found) {
  std::string text;
  for (const NuisanceFound& n : found)
    text += fmt::format("    {:<44} {:>10.3g} +- {:<8.2g} {:<5} (known to {:.2g})\n", n.name, n.value,
                        n.error, n.unit, n.deviation);
  return text.empty() ? "" : "  camera and weights, as the data show them\n" + text;
}

nlohmann::ordered_json nuisances_json(const std::vector<NuisanceFound>& found) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const NuisanceFound& n : found)
    list.push_back({{"name", n.name},
                    {"value", n.value},
                    {"error", n.error},
                    {"known_to", n.deviation},
                    {"unit", n.unit}});
  return list;
}

}  // namespace shakedown
