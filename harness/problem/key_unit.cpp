// SPDX-License-Identifier: MIT
#include "key_unit.hpp"

#include "setup_keys.hpp"

namespace shakedown {

namespace {
constexpr char key_joint = '&';
}

std::string unit_of_key(std::string_view key, std::span<const EffectRecord* const> known) {
  key = key.substr(0, key.find(key_joint));
  if (const SetupKey* found = find_setup_key(key)) return std::string(found->unit);
  const std::size_t dot = key.find('.');
  if (dot == key.npos) return "";
  const std::string_view rest = key.substr(dot + 1), parameter = rest.substr(0, rest.find('.'));
  for (const EffectRecord* record : known)
    if (record->name == key.substr(0, dot))
      if (const Parameter* found = record->find(parameter)) return std::string(found->unit);
  return "";
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
