// SPDX-License-Identifier: MIT
#include "key_unit.hpp"

#include "setup_keys.hpp"

namespace shakedown {

std::string unit_of_key(std::string_view key, std::span<const EffectRecord* const> known) {
  key = key.substr(0, key.find('&'));
  if (const SetupKey* found = find_setup_key(key)) return std::string(found->unit);
  const std::size_t dot = key.find('.');
  if (dot == key.npos) return "";
  const std::string_view rest = key.substr(dot + 1), parameter = rest.substr(0, rest.find('.'));
  for (const EffectRecord* record : known)
    if (record->name == key.substr(0, dot))
      if (const Parameter* found = record->find(parameter)) return std::string(found->unit);
  return "";
}

}  // namespace shakedown
