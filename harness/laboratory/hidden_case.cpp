// SPDX-License-Identifier: MIT
#include "hidden_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "comma_list.hpp"
#include "effect_strength.hpp"
#include "effects.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "quantity.hpp"
#include "setup_keys.hpp"
#include "suggestion.hpp"
#include "text.hpp"
#include "toml_document.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

const EffectRecord& effect_named(const std::string& name, const std::string& origin) {
  if (const EffectRecord* record = find_effect(name)) return *record;
  std::vector<std::string_view> names;
  for (const EffectRecord* record : all_effects()) names.push_back(record->name);
  throw InputError({{{origin, 0, 0},
                     name,
                     "is not an effect",
                     did_you_mean(name, names) + "`shakedown effects` lists them"}});
}

/// Returns values for the parameters that must be given: their examples or defaults.
std::vector<Override> examples(const EffectRecord& record, const std::string& origin) {
  std::vector<Override> overrides;
  for (const Parameter& parameter : record.parameters) {
    const std::string key = std::string(record.name) + "." + std::string(parameter.name);
    if (!parameter.example.empty() && parameter.becomes.empty())
      overrides.push_back({key, std::string(parameter.example), origin});
    else if (parameter.kind == ParameterKind::choice && parameter.required)
      overrides.push_back({key, std::get<std::string>(parameter.default_value), origin});
  }
  return overrides;
}

/// Returns the effect at the typical value of its first strength; an effect without strengths at its example.
std::vector<Override> typical(const EffectRecord& record, const Setup& believed, const std::string& origin) {
  const Search search = search_of(record);
  if (search.strengths.empty()) return examples(record, origin);
  const SearchedStrength& strength = search.strengths.front();
  return overrides_of_strength(record, strength, strength.typical, believed, origin);
}

/// Tells whether a key says how a run was made, or what nobody can know of a real one.
bool is_nuisance(const SetupKey& key) {
  constexpr std::array<std::string_view, 4> sections{"run", "hard", "soft", "bullet"};
  return std::find(sections.begin(), sections.end(), key.section()) != sections.end() ||
         key.path == "release.packing" || key.path == "release.initial_grains" ||
         key.path == "release.kinetic_energy_fraction";
}

bool differs(const SetupKey& key, const HiddenCase& hidden) {
  return toml_of(key, hidden.believed) != toml_of(key, hidden.truth);
}

nlohmann::ordered_json differences(const HiddenCase& hidden, bool nuisances) {
  nlohmann::ordered_json found = nlohmann::ordered_json::object();
  for (const SetupKey& key : setup_keys()) {
    if (key.section() == "run" || is_nuisance(key) != nuisances || !differs(key, hidden)) continue;
    const std::vector<double> numbers = numbers_of(key, hidden.truth);
    if (numbers.empty())
      found[std::string(key.path)] = toml_of(key, hidden.truth);
    else
      found[std::string(key.path)] = numbers.front();
  }
  return found;
}

/// Returns the parameters of the hidden effects, SI, under their path.
nlohmann::ordered_json strengths(const HiddenCase& hidden) {
  nlohmann::ordered_json found = nlohmann::ordered_json::object();
  for (const EffectChoice& choice : hidden.truth.effects) {
    if (const EffectChoice* same = find_choice(hidden.believed, choice.record->name);
        same != nullptr && same->values == choice.values)
      continue;
    for (const auto& [name, value] : choice.values) {
      const std::string path = std::string(choice.record->name) + "." + name;
      if (const double* number = std::get_if<double>(&value)) found[path] = *number;
      if (const std::string* text = std::get_if<std::string>(&value)) found[path] = *text;
      if (const Vec3* vector = std::get_if<Vec3>(&value))
        found[path] = {(*vector)[0], (*vector)[1], (*vector)[2]};
    }
  }
  return found;
}

struct RecordingKey {
  std::string_view name, unit;
  double RecordingSettings::*field;
  double low, high;
};
constexpr std::array<RecordingKey, 17> recording_keys{
    {{"noise.box", "mm", &RecordingSettings::box_noise, 0, 1},
     {"noise.centre", "mm", &RecordingSettings::centre_noise, 0, 1},
     {"fps", "Hz", &RecordingSettings::frame_rate, 5, 1e5},
     {"missing", "", &RecordingSettings::missing, 0, 0.9},
     {"outliers", "", &RecordingSettings::outliers, 0, 0.5},
     {"jump", "mm", &RecordingSettings::jump, 0, 10},
     {"lens", "", &RecordingSettings::lens, -0.3, 0.3},
     {"shutter", "ms", &RecordingSettings::shutter, -0.05, 0.05},
     {"near", "", &RecordingSettings::near, -0.5, 0.5},
     {"wander", "mm", &RecordingSettings::wander, 0, 0.1},
     {"trigger", "ms", &RecordingSettings::trigger, 0, 1},
     {"release", "mm", &RecordingSettings::release, 0, 0.1},
     {"rounding", "mm", &RecordingSettings::rounding, 1e-9, 0.1},
     {"edge", "mm", &RecordingSettings::edge, 0, 0.1},
     {"jitter", "ms", &RecordingSettings::jitter, 0, 1},
     {"start", "s", &RecordingSettings::start, 0, 1e4},
     {"origin", "mm", &RecordingSettings::origin, -10, 10}}};

struct RecordingFlag {
  std::string_view name;
  bool RecordingSettings::*field;
  std::string_view remedy;
};
constexpr std::array<RecordingFlag, 3> recording_flags{
    {{"centre", &RecordingSettings::centre, "centre=false when the grains are not tracked"},
     {"stamped", &RecordingSettings::stamped, "stamped=true when the table has each frame's true instant"},
     {"declared", &RecordingSettings::declared, "declared=false when nobody knows the noise"}}};

/// Returns a bare number of frames per second, a quantity, or what is wrong.
ValueOrProblem<double> recording_value(const RecordingKey& key, std::string text) {
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  if (key.name == "fps" && text.find_first_not_of("0123456789.eE+") == text.npos) text += " Hz";
  TomlValue value;
  value.kind = TomlValue::Kind::text;
  value.text = text;
  const ValueOrProblem<double> read = number_in(value, key.unit);
  if (const double* number = std::get_if<double>(&read))
    if (const std::string problem = out_of_bounds(*number, key.low, key.high, false, key.unit);
        !problem.empty())
      return Problem{problem, "choose a value within the bounds"};
  return read;
}

ValueOrProblem<double> memory_of(const std::string& text) {
  TomlValue value;
  value.kind = TomlValue::Kind::text;
  value.text = trimmed(text);
  const ValueOrProblem<double> read = number_in(value, "s");
  if (const double* seconds = std::get_if<double>(&read); seconds && !(*seconds > 0))
    return Problem{"has no memory of " + value.text, "write size/memory, e.g. wander=20um/0.3s"};
  return read;
}

void take_recording(const std::string& part, const std::string& origin, RecordingSettings& settings) {
  const Override given = parse_override(part, origin);
  const std::string &key = given.key, &value = given.value;
  const auto refuse = [&](const std::string& problem, const std::string& remedy) {
    throw InputError({{{origin, 0, 0}, key, problem, remedy}});
  };
  const auto flag = std::find_if(recording_flags.begin(), recording_flags.end(),
                                 [&](const RecordingFlag& one) { return one.name == key; });
  if (flag != recording_flags.end()) {
    if (value != "true" && value != "false")
      refuse("is neither true nor false", "write " + std::string(flag->remedy));
    settings.*flag->field = value == "true";
    return;
  }
  if (const std::size_t slash = value.find('/'); key == "wander" && slash != value.npos) {  // 20um/0.3s
    const ValueOrProblem<double> memory = memory_of(value.substr(slash + 1));
    if (const Problem* wrong = std::get_if<Problem>(&memory)) refuse(wrong->problem, wrong->remedy);
    settings.wander_time = std::get<double>(memory);
    return take_recording("wander=" + value.substr(0, slash), origin, settings);
  }
  std::vector<std::string_view> names;
  for (const RecordingFlag& one : recording_flags) names.push_back(one.name);
  for (const RecordingKey& known : recording_keys) {
    names.push_back(known.name);
    if (known.name != key) continue;
    const ValueOrProblem<double> read = recording_value(known, value);
    if (const Problem* wrong = std::get_if<Problem>(&read)) refuse(wrong->problem, wrong->remedy);
    settings.*known.field = std::get<double>(read);
    return;
  }
  refuse(
      "is not a property of the camera",
      "known: " + listed(names) + "; a scale, a bias, a drift are effects: `shakedown effects` lists them");
}

}  // namespace

std::vector<Override> overrides_of_strength(const EffectRecord& record, const SearchedStrength& strength,
                                            double level, const Setup& setup, const std::string& origin) {
  const double value = value_at_level(strength, level, absent_value(record, strength, setup));
  const std::string_view unit = parameter_of(record, strength).unit;
  std::vector<Override> overrides;
  for (const std::string& key : joined_keys(keys_of(record, strength)))
    overrides.push_back({key, toml_of(value, unit), origin});
  for (const auto& [parameter, needed] : record.search.besides)
    overrides.push_back({std::string(record.name) + "." + std::string(parameter),
                         toml_of(needed, record.find(parameter)->unit), origin});
  return overrides;
}

const EffectRecord& formula_effect() {
  for (const EffectRecord* record : all_effects())
    if (record->takes_formula()) return *record;
  EXPECT(false && "no effect takes a formula");
  return *all_effects().front();
}

std::vector<Override> overrides_of_effect(std::string_view text, const std::string& origin,
                                          const Setup& believed) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const EffectRecord& record = effect_named(std::string(trimmed(text.substr(0, equals))), origin);
  if (equals == text.size()) return typical(record, believed, origin);
  std::vector<Override> overrides;
  std::vector<Violation> found;
  for (const std::string& part : split_at_commas(text.substr(equals + 1))) {
    const std::size_t colon = part.find(':');
    if (colon == part.npos || colon == 0 || colon + 1 == part.size()) {
      found.push_back({{origin, 0, 0},
                       std::string(record.name),
                       "\"" + part + "\" sets no parameter",
                       "write parameter:value, e.g. " + std::string(record.name) + "=" +
                           std::string(record.parameters.front().name) + ":..."});
      continue;
    }
    overrides.push_back({std::string(record.name) + "." + std::string(trimmed(part.substr(0, colon))),
                         std::string(trimmed(part.substr(colon + 1))), origin});
  }
  if (!found.empty()) throw InputError(std::move(found));
  return overrides;
}

RecordingSettings parse_recording(const std::vector<std::string>& parts, const std::string& origin) {
  RecordingSettings settings;
  std::vector<Violation> found;
  for (const std::string& part : parts) {
    try {
      take_recording(part, origin, settings);
    } catch (const InputError& error) {
      found.insert(found.end(), error.violations.begin(), error.violations.end());
    }
  }
  if (!found.empty()) throw InputError(std::move(found));
  return settings;
}

std::vector<KnownValue> with_known(std::vector<KnownValue> usual, const std::vector<std::string>& texts,
                                   const std::string& origin) {
  TomlValue table;
  std::vector<Violation> wrong;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals == 0) {
      wrong.push_back({{origin, 0, 0},
                       "",
                       "\"" + text + "\" says nothing of a quantity",
                       "write KEY=VALUE +- ERROR, e.g. \"box.mass=434 g +- 2 g\""});
      continue;
    }
    TomlEntry entry{std::string(trimmed(text.substr(0, equals))), {origin, 0, 0}, {}};
    entry.value.kind = TomlValue::Kind::text;
    entry.value.text = trimmed(text.substr(equals + 1));
    entry.value.place = entry.place;
    table.entries.push_back(std::move(entry));
  }
  const std::vector<KnownValue> told = read_known(table, "", wrong);
  if (!wrong.empty()) throw InputError(std::move(wrong));
  std::erase_if(usual, [&](const KnownValue& one) { return find_known(told, one.key) != nullptr; });
  usual.insert(usual.end(), told.begin(), told.end());
  return usual;
}

std::vector<std::string> hidden_effects(const HiddenCase& hidden) {
  std::vector<std::string> names;
  for (const EffectChoice& choice : hidden.truth.effects) {
    const EffectChoice* same = find_choice(hidden.believed, choice.record->name);
    if (same != nullptr && same->values == choice.values) continue;
    if (choice.record->takes_formula()) return {"unknown"};
    if (!choice.record->nuisance) names.emplace_back(choice.record->name);
  }
  return names;
}

bool has_other_parameters(const HiddenCase& hidden) {
  return std::any_of(setup_keys().begin(), setup_keys().end(),
                     [&](const SetupKey& key) { return !is_nuisance(key) && differs(key, hidden); });
}

std::string truth_json(const HiddenCase& hidden, const RecordingSettings& recording,
                       const std::string& engine, std::uint64_t seed) {
  const nlohmann::ordered_json document{{"schema_version", 1},
                                        {"hidden", hidden_effects(hidden)},
                                        {"strengths", strengths(hidden)},
                                        {"laboratory", differences(hidden, false)},
                                        {"nuisances", differences(hidden, true)},
                                        {"engine", engine},
                                        {"seed", seed},
                                        {"camera",
                                         {{"noise_box_mm", recording.box_noise * 1e3},
                                          {"noise_centre_mm", recording.centre_noise * 1e3},
                                          {"frame_rate_hz", recording.frame_rate},
                                          {"missing", recording.missing},
                                          {"outliers", recording.outliers},
                                          {"jump_mm", recording.jump * 1e3},
                                          {"centre", recording.centre},
                                          {"lens", recording.lens},
                                          {"shutter_ms", recording.shutter * 1e3},
                                          {"near", recording.near},
                                          {"wander_mm", recording.wander * 1e3},
                                          {"wander_time_s", recording.wander_time},
                                          {"trigger_ms", recording.trigger * 1e3},
                                          {"release_mm", recording.release * 1e3},
                                          {"rounding_mm", recording.rounding * 1e3},
                                          {"jitter_ms", recording.jitter * 1e3},
                                          {"stamped", recording.stamped},
                                          {"start_s", recording.start},
                                          {"origin_mm", recording.origin * 1e3},
                                          {"declared", recording.declared}}},
                                        {"setup", write_setup(hidden.truth)}};
  return document.dump(2) + "\n";
}

}  // namespace shakedown
