// SPDX-License-Identifier: MIT
#include "key_unit.hpp"

#include "known_effects.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {
constexpr char key_joint = '&';
}  // namespace

std::string unit_of_key(std::string_view key, KnownEffects known) {
  key = key.substr(0, key.find(key_joint));
  if (const SetupKey* found = find_setup_key(key)) return std::string(found->unit);
  const Parameter* parameter = known.find_parameter(key);
  if (parameter == nullptr) return "";
  return std::string(parameter->unit_shown.empty() ? parameter->unit : parameter->unit_shown);
}

std::string si_unit_of_key(std::string_view key, KnownEffects known) {
  if (find_setup_key(key.substr(0, key.find(key_joint))) == nullptr) {
    const Parameter* parameter = known.find_parameter(key.substr(0, key.find(key_joint)));
    return parameter == nullptr ? "" : std::string(parameter->unit);
  }
  const std::string shown = unit_of_key(key, known);
  if (shown == "g") return "kg";
  // a length or a time in thousandths; all other keys are shown in SI
  return shown == "mm" || shown == "ms" ? shown.substr(1) : shown;
}

std::vector<std::string> joined_keys(std::string_view keys) {
  std::vector<std::string> list;
  for (;;) {
    const std::size_t end = keys.find(key_joint);
    list.emplace_back(keys.substr(0, end));
    if (end == keys.npos) return list;
    keys.remove_prefix(end + 1);
  }
}

}  // namespace shakedown
