// SPDX-License-Identifier: MIT
#include "nuisance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "effect_strength.hpp"
#include "experiment.hpp"
#include "key_unit.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

/// Returns what is known of this key in one run: of the run itself, else of all; null: nothing.
const KnownValue* known_in(const Measurement& measurement, const Measurement::Run& run,
                           std::string_view key) {
  const KnownValue* own = find_known(run.recorded.known, key);
  return own != nullptr ? own : find_known(measurement.known, key);
}

bool is_said_of_a_run(const Measurement& measurement, std::string_view key) {
  return std::any_of(measurement.runs.begin(), measurement.runs.end(), [&](const Measurement::Run& run) {
    return find_known(run.recorded.known, key) != nullptr;
  });
}

CameraNuisance nuisance_of(const EffectRecord& record, const SearchedStrength& strength,
                           const Measurement& measurement) {
  const CameraError& error = record.camera_error;
  CameraNuisance nuisance{keys_of(record, strength),
                          std::string(error.known_as),
                          std::string(parameter_of(record, strength).unit),
                          {},
                          error.each_run || is_said_of_a_run(measurement, error.known_as)};
  for (const Measurement::Run& run : measurement.runs) {
    const KnownValue* said = known_in(measurement, run, error.known_as);
    const bool anywhere = error.unknown > 0 && starts_anywhere(run.recorded, run.setup);
    nuisance.deviation_of.push_back(said ? said->error : anywhere ? error.unknown : error.usual);
  }
  return nuisance;
}

// Kitchen balances read to 1 g of some 400; grains are weighed by the dozen.
struct Weighed {
  std::string_view key;
  double usual;  // relative
};
constexpr std::array<Weighed, 2> weighed{{{"box.mass", 0.003}, {"grains.mass", 0.003}}};

double usual_error(std::string_view key, double value) {
  for (const Weighed& one : weighed)
    if (one.key == key) return one.usual * value;
  return 0;
}

}  // namespace

double CameraNuisance::deviation() const {
  return deviation_of.empty() ? 0 : *std::max_element(deviation_of.begin(), deviation_of.end());
}

std::vector<CameraNuisance> camera_nuisances(const Measurement& measurement, KnownEffects known) {
  std::vector<CameraNuisance> list;
  for (const EffectRecord* record : known) {
    if (record->camera_error.known_as.empty()) continue;
    const Search search = search_of(*record);
    if (search.strengths.empty()) continue;
    if (measurement.sensor != Sensor::camera && record->camera.optical) continue;
    CameraNuisance nuisance = nuisance_of(*record, search.strengths.front(), measurement);
    if (nuisance.deviation() > 0) list.push_back(std::move(nuisance));
  }
  return list;
}

std::vector<WeighedNuisance> weighed_nuisances(const Measurement& measurement) {
  std::vector<WeighedNuisance> list;
  if (std::none_of(measurement.runs.begin(), measurement.runs.end(),
                   [](const Measurement::Run& run) { return run.setup.grains.count > 0; }))
    return list;
  for (const auto& [key, usual] : weighed) {
    WeighedNuisance of_all{std::string(key), si_unit_of_key(key, {})};
    for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
      const Measurement::Run& run = measurement.runs[r];
      const KnownValue* said = known_in(measurement, run, key);
      const double deviation = said ? said->error : usual * get_number(run.setup, key);
      if (find_known(run.recorded.known, key) != nullptr) {
        if (deviation > 0) list.push_back({of_all.key, of_all.unit, deviation, {r}, true});
        continue;
      }
      of_all.deviation = deviation;
      of_all.runs.push_back(r);
    }
    if (of_all.deviation > 0) list.push_back(std::move(of_all));
  }
  return list;
}

ValueWithError known_mass(const Measurement& measurement, std::string_view key) {
  if (measurement.runs.empty()) return {};
  const Measurement::Run& first = measurement.runs.front();
  const double value = get_number(first.setup, key);
  const KnownValue* said = known_in(measurement, first, key);
  return {value, said ? said->error : usual_error(key, value)};
}

std::optional<ValueWithError> known_frequency(const Measurement& measurement) {
  const KnownValue* said = find_known(measurement.known, "spring.frequency");
  if (said == nullptr) return std::nullopt;
  const KnownValue* clock = find_known(measurement.known, "clock");
  return ValueWithError{said->value, std::hypot(said->error, clock ? clock->error * said->value : 0)};
}

std::optional<KnownWander> known_wander(const Measurement& measurement) {
  const KnownValue* said = find_known(measurement.known, "camera.wander");
  if (said == nullptr) return std::nullopt;
  KnownWander wander;
  wander.deviation = said->value;
  if (const KnownValue* time = find_known(measurement.known, "camera.wander_time")) wander.time = time->value;
  return wander;
}

std::vector<std::string> exactly_known(const Measurement& measurement, KnownEffects known) {
  std::vector<std::string> names;
  for (const EffectRecord* record : known) {
    const Search search = search_of(*record);
    if (measurement.sensor != Sensor::camera && !search.strengths.empty() && record->camera.optical) {
      names.emplace_back(record->name);
      continue;
    }
    const KnownValue* said = record->camera_error.known_as.empty()
                                 ? nullptr
                                 : find_known(measurement.known, record->camera_error.known_as);
    if (said != nullptr && said->error == 0 && !is_said_of_a_run(measurement, said->key))
      names.emplace_back(record->name);
  }
  return names;
}

}  // namespace shakedown
