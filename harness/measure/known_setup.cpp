// SPDX-License-Identifier: MIT
#include "known_setup.hpp"

#include <algorithm>
#include <cmath>

#include "effect_strength.hpp"
#include "key_unit.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"
#include "toml_string.hpp"

namespace shakedown {

namespace {

const EffectRecord* camera_record(std::string_view known_as, KnownEffects known) {
  for (const EffectRecord* record : known)
    if (!record->camera_error.known_as.empty() && record->camera_error.known_as == known_as) return record;
  return nullptr;
}

/// Returns key and value for every number that this sets, other parameters that it needs first.
std::vector<std::pair<std::string, double>> numbers_set_by(const KnownValue& value, KnownEffects known) {
  const std::string key = setup_key_of(value, known);
  if (key.empty()) return {};
  const EffectRecord* camera = camera_record(value.key, known);
  if (camera != nullptr && value.value == 0) return {};
  std::vector<std::pair<std::string, double>> numbers;
  if (camera != nullptr)
    for (const auto& [parameter, beside] : search_of(*camera).besides)
      numbers.emplace_back(std::string(camera->name) + "." + std::string(parameter), beside);
  numbers.emplace_back(key, value.value);
  return numbers;
}

}  // namespace

std::string setup_key_of(const KnownValue& value, KnownEffects known) {
  if (find_setup_key(value.key) != nullptr || find_component_number(known, value.key) != nullptr)
    return value.key;
  const EffectRecord* record = camera_record(value.key, known);
  if (record == nullptr) return "";
  const Search search = search_of(*record);
  return search.strengths.empty() ? "" : keys_of(*record, search.strengths.front());
}

Setup with_known(Setup setup, const std::vector<KnownValue>& values, KnownEffects known) {
  for (const KnownValue& value : values)
    for (const auto& [key, number] : numbers_set_by(value, known))
      if (find_setup_key(key) == nullptr || get_number(setup, key, known) != number)
        set_number(setup, key, number, known);
  return setup;
}

Experiment with_known(Experiment experiment, KnownEffects known) {
  for (MeasuredRun& run : experiment.runs)
    for (const KnownValue& value : run.known)
      for (const auto& [key, number] : numbers_set_by(value, known)) {
        std::erase_if(run.overrides, [&key = key](const Override& one) { return one.key == key; });
        run.overrides.push_back({key, toml_string(write_quantity(number, unit_of_key(key, known))),
                                 value.place.file + ":" + std::to_string(value.place.line)});
        run.places[key] = value.place;
      }
  return experiment;
}

std::vector<std::string> notes_on_known(const Setup& setup, const std::vector<KnownValue>& values) {
  std::vector<std::string> notes;
  for (const KnownValue& known : values) {
    const SetupKey* key = find_setup_key(known.key);
    if (key == nullptr) continue;
    const double set = numbers_of(*key, setup).front();
    constexpr double rounding = 1e-9;
    if (std::abs(set - known.value) <= rounding * std::abs(known.value)) continue;
    notes.push_back(known.key + " is " + write_quantity(set, key->unit) + " in the setup; the measured " +
                    write_quantity(known.value, key->unit) + " +- " + write_quantity(known.error, key->unit) +
                    " of [known] is used instead");
  }
  return notes;
}

}  // namespace shakedown
