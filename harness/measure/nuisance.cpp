// SPDX-License-Identifier: MIT
#include "nuisance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "effect_strength.hpp"
#include "experiment_file.hpp"
#include "key_unit.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

/// What the experiment says of this key, of all its runs or (the first that does) of one; null: nothing.
const KnownValue* find_in(const Measurement& measurement, std::string_view key) {
  if (const KnownValue* found = find_known(measurement.known, key)) return found;
  for (const Measurement::Run& run : measurement.runs)
    if (const KnownValue* found = find_known(run.recorded.known, key)) return found;
  return nullptr;
}

}  // namespace

std::vector<CameraNuisance> camera_nuisances(const Measurement& measurement,
                                             std::span<const EffectRecord* const> known) {
  std::vector<CameraNuisance> list;
  for (const EffectRecord* record : known) {
    const CameraError& error = record->camera_error;
    if (error.known_as.empty()) continue;
    const Search search = search_of(*record);
    if (search.strengths.empty()) continue;
    CameraNuisance nuisance{keys_of(*record, search.strengths.front()),
                            std::string(error.known_as),
                            std::string(parameter_of(*record, search.strengths.front()).unit),
                            error.usual,
                            error.each_run,
                            true};
    if (const KnownValue* said = find_in(measurement, error.known_as))
      nuisance.deviation = said->error, nuisance.assumed = false;
    if (error.unknown > 0)
      for (const Measurement::Run& run : measurement.runs)
        if (starts_anywhere(run.recorded, run.setup)) nuisance.deviation = error.unknown;
    if (nuisance.deviation > 0) list.push_back(std::move(nuisance));
  }
  return list;
}

std::vector<WeighedNuisance> weighed_nuisances(const Measurement& measurement) {
  struct Weighed {
    std::string_view key;
    double usual;  // relative
  };
  // Kitchen balances read to 1 g of some 400; grains are weighed by the dozen.
  constexpr std::array<Weighed, 2> weighed{{{"box.mass", 0.003}, {"grains.mass", 0.003}}};
  std::vector<WeighedNuisance> list;
  if (measurement.runs.empty()) return list;
  const Setup& setup = measurement.runs.front().setup;
  for (const auto& [key, usual] : weighed) {
    const KnownValue* said = find_in(measurement, key);
    const double deviation = said ? said->error : usual * get_number(setup, key);
    if (setup.grains.count > 0 && deviation > 0)  // alone a mass is a stiffness
      list.push_back({std::string(key), si_unit_of_key(key, {}), deviation, said == nullptr});
  }
  return list;
}

}  // namespace shakedown
