// SPDX-License-Identifier: MIT
#include "known_effects.hpp"

#include <algorithm>
#include <iterator>

namespace shakedown {

namespace {

bool is_searched(const EffectRecord* record) {
  return !record->nuisance && record->search.not_searched.empty();
}

}  // namespace

const EffectRecord* KnownEffects::find(std::string_view name) const {
  const auto found = std::find_if(begin(), end(), [&](const EffectRecord* r) { return r->name == name; });
  return found == end() ? nullptr : *found;
}

const Parameter* KnownEffects::find_parameter(std::string_view key) const {
  const std::size_t dot = key.find('.');
  const EffectRecord* record = dot == key.npos ? nullptr : find(key.substr(0, dot));
  if (record == nullptr) return nullptr;
  const std::string_view rest = key.substr(dot + 1);
  return record->find(rest.substr(0, rest.find('.')));
}

std::string KnownEffects::key_of(double Camera::*number) const {
  const auto found =
      std::find_if(begin(), end(), [&](const EffectRecord* r) { return r->camera.field == number; });
  if (found == end()) return "";
  return std::string((*found)->name) + "." + std::string((*found)->parameters.front().name);
}

std::vector<const EffectRecord*> KnownEffects::oscillating() const {
  std::vector<const EffectRecord*> list;
  std::copy_if(begin(), end(), std::back_inserter(list),
               [](const EffectRecord* r) { return is_searched(r) && r->search.harmonic.has_value(); });
  return list;
}

std::size_t KnownEffects::searched() const {
  return static_cast<std::size_t>(std::count_if(begin(), end(), is_searched));
}

}  // namespace shakedown
