// SPDX-License-Identifier: MIT
#include "summary_file.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "paper_values.hpp"
#include "provenance.hpp"
#include "setup_file.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

/// Returns null for what is not finite, as JSON has no NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json decay_json(const Decay& decay) {
  return {{"peaks", decay.peaks},
          {"linear",
           {{"intercept_mm", number(1e3 * decay.linear.intercept)},
            {"intercept_error_mm", number(1e3 * decay.linear.intercept_error)},
            {"slope_mm_per_s", number(1e3 * decay.linear.slope)},
            {"slope_error_mm_per_s", number(1e3 * decay.linear.slope_error)},
            {"rms_mm", number(1e3 * decay.linear.rms)}}},
          {"exponential",
           {{"amplitude_mm", number(1e3 * decay.exponential.amplitude)},
            {"amplitude_error_mm", number(1e3 * decay.exponential.amplitude_error)},
            {"rate_per_s", number(decay.exponential.rate)},
            {"rate_error_per_s", number(decay.exponential.rate_error)},
            {"rms_mm", number(1e3 * decay.exponential.rms)}}},
          {"curvature_mm_per_s2", number(1e3 * decay.curvature)},
          {"curvature_error_mm_per_s2", number(1e3 * decay.curvature_error)}};
}

void add_motion(const Observables& seen, Json& json) {
  json["peaks_mm"] = json["peak_times_s"] = json["damping"] = Json::array();
  for (const Peak& peak : seen.peaks) {
    json["peaks_mm"].push_back(1e3 * peak.position);
    json["peak_times_s"].push_back(peak.time);
  }
  json["slope_mm_per_s"] = number(1e3 * seen.slope);
  json["frequency_hz"] = number(seen.frequency);
  json["small_peak_mm"] = number(1e3 * seen.small_peak);
  json["first_small_peak_s"] = number(seen.first_small_peak);
  json["decay"] = decay_json(seen.decay);
  for (const HalfPeriodDamping& damping : seen.damping)
    json["damping"].push_back({{"amplitude_mm", 1e3 * damping.amplitude},
                               {"loss_per_cycle_fraction", number(damping.loss_per_cycle)},
                               {"equivalent_damping_ratio", number(damping.equivalent_ratio)}});
}

/// Adds the state under forcing, only where the damper is forced.
void add_forced(const Observables& seen, Json& json) {
  if (!seen.steady) return;
  json["forced"] = {{"amplitude_mm", number(1e3 * seen.steady->amplitude)},
                    {"variation", number(seen.steady->variation)},
                    {"phase_lag_rad", number(seen.steady->phase_lag)},
                    {"loss_factor", number(seen.steady->loss_factor)},
                    {"effective_mass_g", number(1e3 * seen.steady->effective_mass)}};
}

std::string fraction_name(double fraction) {
  std::ostringstream text;
  text << fraction;
  return text.str();
}

/// Returns the losses to effects by name; a second one of the same name gets a number.
Json effect_loss_json(const std::vector<double>& loss, const Setup& setup) {
  Json json = Json::object();
  for (std::size_t i = 0; i < loss.size() && i < setup.effects.size(); ++i) {
    const std::string name(setup.effects[i].record->name);
    std::string key = name;
    for (int again = 2; json.contains(key); ++again) key = name + "_" + std::to_string(again);
    json[key] = number(loss[i]);
  }
  return json;
}

void add_energy(const RunResult& run, const Setup& setup, Json& json) {
  const Observables& seen = run.observables;
  json["initial_energy_J"] = number(run.trajectory.initial_energy);
  for (std::size_t i = 0; i < energy_fractions.size(); ++i)
    json["seconds_to_energy_fraction"][fraction_name(energy_fractions[i])] =
        number(seen.seconds_to_energy_fraction[i]);
  for (std::size_t i = 0; i < contact_classes; ++i)
    json["energy_loss"][contact_class_names[i]] = number(seen.energy_loss[i]);
  json["effect_energy_loss"] = effect_loss_json(seen.effect_loss, setup);
}

Json health_json(const Health& health) {
  return {{"ledger_error", number(health.ledger_error)},
          {"momentum_error", number(health.momentum_error)},
          {"deepest_overlap_m", number(health.deepest_overlap)},
          {"elastic_rescues", health.elastic_rescues},
          {"elastic_pair_rescues", health.elastic_pair_rescues},
          {"refused_events", health.refused_events},
          {"notes", health.notes}};
}

void add_work(const Trajectory& trajectory, Json& json) {
  std::int64_t total = 0;
  const bool told = trajectory.collisions[0] >= 0;  // other people's programs do not tell them
  for (std::size_t i = 0; i < contact_classes; ++i) {
    json["collisions"][contact_class_names[i]] = told ? Json(trajectory.collisions[i]) : Json(nullptr);
    total += trajectory.collisions[i];
  }
  json["collisions"]["total"] = told ? Json(total) : Json(nullptr);
  json["events"] = trajectory.events;
  json["end_time_s"] = number(trajectory.end_time);
  json["ledger_error"] = number(trajectory.health.ledger_error);
  json["momentum_error"] = number(trajectory.health.momentum_error);
  json["deepest_overlap_m"] = number(trajectory.health.deepest_overlap);
  json["health"] = health_json(trajectory.health);
  json["wall_seconds"] = number(trajectory.wall_seconds);
  json["collisions_per_second"] =
      told ? number(static_cast<double>(total) / trajectory.wall_seconds) : Json(nullptr);
}

Json run_json(const RunResult& run, const Setup& setup) {
  Json json;
  add_motion(run.observables, json);
  add_forced(run.observables, json);
  add_energy(run, setup, json);
  add_work(run.trajectory, json);
  return json;
}

/// Joins many trees of the same shape to one: numbers become {mean, sd, n}, lists are joined place by place
/// up to the longest, texts are collected. `extremes` adds the largest value.
Json joined(const std::vector<const Json*>& trees, bool extremes) {
  const Json* shape = nullptr;
  for (const Json* tree : trees)
    if (!tree->is_null() && (shape == nullptr || tree->size() > shape->size())) shape = tree;
  if (shape == nullptr) return {{"mean", nullptr}, {"sd", nullptr}, {"n", 0}};
  const auto at_place = [&](const auto& key) {
    std::vector<const Json*> parts;
    for (const Json* tree : trees) {
      if constexpr (std::is_same_v<std::decay_t<decltype(key)>, std::string>) {
        if (tree->contains(key)) parts.push_back(&tree->at(key));
      } else {
        if (key < tree->size()) parts.push_back(&tree->at(key));
      }
    }
    return parts;
  };
  if (shape->is_object()) {
    Json result = Json::object();
    for (const auto& [key, value] : shape->items()) {
      if (key == "notes") {
        std::set<std::string> notes;
        for (const Json* part : at_place(key)) notes.insert(part->begin(), part->end());
        result[key] = notes;
      } else {
        result[key] = joined(at_place(key), extremes || key == "health");
      }
    }
    return result;
  }
  if (shape->is_array()) {
    Json result = Json::array();
    for (std::size_t i = 0; i < shape->size(); ++i) result.push_back(joined(at_place(i), extremes));
    return result;
  }
  std::vector<double> values;
  for (const Json* tree : trees)
    if (tree->is_number()) values.push_back(tree->get<double>());
  const Statistic statistic = statistic_of(values);
  Json result{{"mean", number(statistic.mean)}, {"sd", number(statistic.sd)}, {"n", statistic.n}};
  if (extremes && !values.empty()) result["max"] = *std::max_element(values.begin(), values.end());
  return result;
}

/// Returns a TOML value as JSON, keys in the order of the alphabet, which this kind of JSON keeps by itself.
nlohmann::json json_of(const TomlValue& value) {
  using Kind = TomlValue::Kind;
  nlohmann::json json;
  switch (value.kind) {
    case Kind::text:
    case Kind::date: return value.text;
    case Kind::integer: return value.integer;
    case Kind::number: return value.number;
    case Kind::boolean: return value.boolean;
    case Kind::array:
      json = nlohmann::json::array();
      for (const TomlValue& item : value.items) json.push_back(json_of(item));
      return json;
    case Kind::table:
      json = nlohmann::json::object();
      for (const TomlEntry& entry : value.entries) json[entry.key] = json_of(entry.value);
      return json;
  }
  EXPECT(false && "a kind of value");
  return json;
}

/// Returns the setup as the setup file has it, quantities with their units.
Json setup_json(const Setup& setup) { return json_of(parse_toml(write_setup(setup), "setup")); }

}  // namespace

std::string summary_json(const Ensemble& ensemble, const Setup& setup) {
  const Provenance program = provenance_of_this_program();
  Json json{{"schema_version", summary_schema_version},
            {"program", {{"name", "shakedown"}, {"version", program.version}, {"commit", program.commit}}},
            {"engine", ensemble.engine},
            {"setup", setup_json(setup)},
            {"taken_from_paper", taken_from_paper(setup)},
            {"seed", setup.run.seed},
            {"runs", {{"requested", ensemble.requested}, {"finished", ensemble.runs.size()}}},
            {"interrupted", ensemble.interrupted}};
  std::vector<Json> runs;
  for (const RunResult& run : ensemble.runs) runs.push_back(run_json(run, setup));
  if (ensemble.requested == 1 && !runs.empty()) {
    json.update(runs[0]);
  } else if (!runs.empty()) {
    std::vector<const Json*> trees;
    for (const Json& run : runs) trees.push_back(&run);
    json.update(joined(trees, false));
  }
  return json.dump(2) + "\n";
}

}  // namespace shakedown
