// SPDX-License-Identifier: MIT
#include "known_value.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "quantity.hpp"
#include "setup_keys.hpp"
#include "suggestion.hpp"
#include "table_text.hpp"
#include "toml_string.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

using TomlKind = TomlValue::Kind;

constexpr std::array<CameraKey, 9> keys_of_camera{{
    {"camera.scale", "", false, false,
     "Relative error of the scale: by how much the table's lengths are too long."},
    {"camera.lens", "", false, false,
     "Relative distortion of the lens at 0.2 m from the optical axis; it grows with the square of the "
     "distance."},
    {"camera.depth", "", false, false,
     "Relative: by how much larger the grains appear than the box's marker; negative where they lie behind "
     "it."},
    {"camera.shutter", "s", false, false,
     "Time from the first to the last row that is read of 0.4 m of track (rolling shutter)."},
    {"camera.trigger", "ms", false, true,
     "What the clock of a run shows at the release; negative where it starts late."},
    {"camera.wander", "mm", true, false, "Standard deviation of a slow error of the tracked positions."},
    {"camera.wander_time", "s", true, false, "Time over which that slow error forgets itself."},
    {"camera.origin", "mm", false, false,
     "What the table's positions read where the spring is relaxed, after the origin stated was subtracted."},
    {"clock", "", false, false,
     "Relative error of the frame rate: what the table calls 1 s is 1 s times 1 plus this."},
}};

const CameraKey* find_camera_key(std::string_view path) {
  for (const CameraKey& key : keys_of_camera)
    if (key.path == path) return &key;
  return nullptr;
}

/// Tells whether a key can be measured: nobody measures the sections that only steer a simulation.
bool can_be_known(const SetupKey& key) {
  constexpr std::array<std::string_view, 6> measured{"box",    "spring",      "blade",
                                                     "grains", "restitution", "release"};
  return is_numeric(key) && std::find(measured.begin(), measured.end(), key.section()) != measured.end();
}

/// Tells whether an effect acts in contacts or on grains: a test of the grains alone tells more of it than
/// films of the whole damper, which tell what acts on the box.
bool is_in_contacts(const EffectRecord& record) {
  return record.acts_on == ActsOn::contact || record.acts_on == ActsOn::grains;
}

/// These keys of the setup are weighed with their error. Of all others a value without error may be said.
constexpr std::array<std::string_view, 6> weighed_keys{
    "box.mass",         "grains.mass",         "restitution.grain_grain", "restitution.grain_wall",
    "spring.frequency", "release.displacement"};
bool is_weighed(std::string_view key) {
  return find_camera_key(key) != nullptr ||
         std::find(weighed_keys.begin(), weighed_keys.end(), key) != weighed_keys.end();
}

std::string listed_keys() {
  std::string words;
  for (const std::string_view key : weighed_keys) (words += words.empty() ? "" : ", ") += key;
  return words + " and those of camera and clock";
}

struct Target {
  std::string_view unit;
  double low, high;
  bool low_excluded;
};

std::optional<Target> target_of(std::string_view path, KnownEffects effects) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (const CameraKey* key = find_camera_key(path))
    return Target{key->unit, key->positive ? 0 : -infinity, infinity, false};
  if (const Parameter* parameter = find_component_number(effects, path))
    return Target{parameter->unit, parameter->low, parameter->high, false};
  const SetupKey* key = find_setup_key(path);
  if (!key || !can_be_known(*key)) return std::nullopt;
  return Target{key->unit, key->low, key->high, key->low_excluded};
}

/// Returns "box.mass or grains.mass" for "mass"; else the nearest key.
std::string meant_by(std::string_view path) {
  std::vector<std::string_view> candidates;
  std::string same_name;
  const auto add = [&](std::string_view key) {
    candidates.push_back(key);
    if (key.substr(key.find('.') + 1) == path)
      same_name += (same_name.empty() ? "" : " or ") + ("'" + std::string(key) + "'");
  };
  for (const SetupKey& key : setup_keys())
    if (can_be_known(key)) add(key.path);
  for (const CameraKey& key : keys_of_camera) add(key.path);
  if (!same_name.empty()) return same_name;
  const std::string_view near = nearest(path, candidates);
  return near.empty() ? "" : "'" + std::string(near) + "'";
}

Violation unknown_key(const TomlEntry& entry, std::string_view key, const std::string& path,
                      KnownEffects effects) {
  const std::string full = path + std::string(key);
  if (const EffectRecord* record = effects.find(effect_of(key)))
    return {entry.place, full,
            is_in_contacts(*record) ? "is no number of that effect that can be measured by itself"
                                    : "is of an effect that the films themselves tell",
            is_in_contacts(*record)
                ? "name one of its numbers (shakedown effects " + std::string(record->name) + ")"
                : "add the effect to the setup if it is there, or leave this out"};
  if (const SetupKey* found = find_setup_key(key))
    return {entry.place, full,
            is_numeric(*found) ? "is not measured: it only steers a simulation" : "is not a number",
            "set it in the setup file, or in [[run]] for one run"};
  const std::string meant = meant_by(key);
  std::string of_camera;
  for (const CameraKey& one : keys_of_camera) (of_camera += ", ") += one.path;
  return {entry.place, full, "is nothing that [known] can say (neither a key of the setup nor of the camera)",
          (meant.empty() ? "" : "did you mean " + meant + "? ") +
              "known here: the setup's keys of box, spring, blade, grains, restitution, release" + of_camera};
}

/// A number and the unit behind it, as written.
struct Written {
  std::string number, unit;
  std::string text() const { return unit.empty() ? number : number + " " + unit; }
};

Written split_number(std::string_view text) {
  text = trimmed(text);
  std::size_t end = text.find_first_not_of("+-0123456789.");
  if (end != text.npos && (text[end] == 'e' || text[end] == 'E') && end + 1 < text.size() &&
      text.substr(end + 1).find_first_of("+-0123456789") == 0)
    end = text.find_first_not_of("0123456789", text.find_first_of("0123456789", end));
  if (end == text.npos) return {std::string(text), ""};
  return {std::string(text.substr(0, end)), std::string(trimmed(text.substr(end)))};
}

struct ValueAndError {
  Written value, error;
  bool unit_at_error_only = false;
};

/// Splits "434 g +- 2 g", "434 +- 2 g", "434 g +- 2", "(434 +- 2) g" into value and error; nothing when no
/// error is given.
std::optional<ValueAndError> split_error(std::string_view text) {
  text = trimmed(text);
  std::string_view unit_of_both;
  if (const std::size_t close = text.rfind(')'); text.starts_with('(') && close != text.npos) {
    unit_of_both = trimmed(text.substr(close + 1));
    text = text.substr(1, close - 1);
  }
  for (const std::string_view sign : {"+-", "+/-", "\u00b1"}) {
    const std::size_t at = text.find(sign);
    if (at == text.npos) continue;
    ValueAndError found{split_number(text.substr(0, at)), split_number(text.substr(at + sign.size()))};
    if (found.error.unit.empty()) found.error.unit = found.value.unit;
    found.unit_at_error_only = found.value.unit.empty() && unit_of_both.empty();
    if (found.value.unit.empty()) found.value.unit = found.error.unit;
    if (!unit_of_both.empty()) found.value.unit = found.error.unit = unit_of_both;
    return found;
  }
  return std::nullopt;
}

std::string example_with_error(std::string_view unit) {
  const auto with_unit = [&](const char* number) {
    return unit.empty() ? std::string(number) : number + (" " + std::string(unit));
  };
  return toml_string(with_unit(unit.empty() ? "0.95" : "100") + " +- " +
                     with_unit(unit.empty() ? "0.02" : "1"));
}

ValueOrProblem<double> number_of(const Written& written, std::string_view unit) {
  TomlValue value;
  value.kind = TomlKind::text;
  value.text = written.text();
  return number_in(value, unit);
}

/// Returns the error in SI. A per cent of a quantity with a unit is a share of its value: "434 g +- 0.5 %".
ValueOrProblem<double> error_of(const ValueAndError& both, double value, std::string_view unit) {
  if (both.error.unit != "%" || unit.empty() || both.value.unit == "%") return number_of(both.error, unit);
  const ValueOrProblem<double> share = number_of(both.error, "");
  if (const double* number = std::get_if<double>(&share)) return std::abs(value) * *number;
  return share;
}

/// Sets value and error of `known`, or returns the problem.
std::optional<Problem> take(const TomlValue& from, const Target& target, KnownValue& known) {
  const std::string remedy = "write value and error, e.g. " + example_with_error(target.unit);
  if (from.kind != TomlKind::text)
    return Problem{"is " + std::string(describe(from.kind)) + " (a text with value and error is expected)",
                   remedy};
  const std::optional<ValueAndError> both = split_error(from.text);
  if (!both)
    return Problem{toml_string(from.text) + " has no error (how well is it known?)",
                   remedy + "; +- 0 for what is exact"};
  const ValueOrProblem<double> value = number_of(both->value, target.unit);
  if (const auto* problem = std::get_if<Problem>(&value)) return Problem{problem->problem, remedy};
  known.value = std::get<double>(value);
  // 0.95 +- 2 %: the value has the unit of the error, but nobody has a restitution of 0.0095
  if (both->unit_at_error_only && both->error.unit == "%" && target.high == 1 && known.value > 0 &&
      known.value <= 0.01)
    return Problem{toml_string(from.text) + " leaves open of what the per cent is",
                   "write the error as a number (0.95 +- 0.02), or % with both (95 % +- 2 %)"};
  const ValueOrProblem<double> error = error_of(*both, known.value, target.unit);
  if (const auto* problem = std::get_if<Problem>(&error))
    return Problem{"the error " + problem->problem, remedy};
  known.error = std::get<double>(error);
  if (const std::string why =
          out_of_bounds(known.value, target.low, target.high, target.low_excluded, target.unit);
      !why.empty())
    return Problem{why, "correct it"};
  if (!(known.error >= 0) || known.error == std::numeric_limits<double>::infinity())
    return Problem{"its error " + write_quantity(known.error, target.unit) + " is no standard deviation",
                   "write it without a sign"};
  return std::nullopt;
}

void read_entries(const TomlValue& table, const std::string& above, const std::string& path,
                  KnownEffects effects, std::vector<KnownValue>& all, std::vector<Violation>& violations) {
  for (const TomlEntry& entry : table.entries) {
    const std::string key = above + entry.key;
    if (entry.value.kind == TomlKind::table) {  // box.mass without quotation marks
      read_entries(entry.value, key + ".", path, effects, all, violations);
      continue;
    }
    const std::optional<Target> target = target_of(key, effects);
    if (!target) {
      violations.push_back(unknown_key(entry, key, path, effects));
      continue;
    }
    if (find_known(all, key)) {
      violations.push_back({entry.place, path + key, "is said twice", "keep one of the two"});
      continue;
    }
    KnownValue known{key, 0, 0, entry.place};
    if (const std::optional<Problem> problem = take(entry.value, *target, known))
      violations.push_back({entry.value.place, path + key, problem->problem, problem->remedy});
    else if (known.error > 0 && !is_weighed(key) && find_component_number(effects, key) == nullptr)
      violations.push_back({entry.value.place, path + key, "has an error that nothing here weighs",
                            "write the value alone, " + key + " = " +
                                toml_string(write_quantity(known.value, target->unit)) +
                                ", into the setup or its [[run]]; weighed are " + listed_keys()});
    else
      all.push_back(std::move(known));
  }
}

}  // namespace

std::span<const CameraKey> camera_keys() { return keys_of_camera; }

std::string example_of(const CameraKey& key) {
  if (key.path == "clock") return "0 +- 0.01 %";
  return key.unit.empty() ? "0 +- 0.5 %"
         : key.path == "camera.wander_time"
             ? "0.3 s +- 0.1 s"
             : "0 +- " + write_quantity(key.unit == "mm" ? 2e-5 : 2e-3, key.unit);
}

std::vector<const SetupKey*> knowable_setup_keys() {
  std::vector<const SetupKey*> keys;
  for (const SetupKey& key : setup_keys())
    if (can_be_known(key)) keys.push_back(&key);
  return keys;
}

bool may_differ_between_runs(std::string_view key) {
  if (find_camera_key(key) == nullptr && find_setup_key(key) == nullptr) return false;  // of an effect
  const auto starts = [&](std::string_view with) { return key.substr(0, with.size()) == with; };
  return !starts("restitution.") && !starts("spring.") && !starts("camera.wander");
}

bool is_of_each_run(std::string_view key) {
  const CameraKey* camera = find_camera_key(key);
  return camera ? camera->each_run : key == "release.displacement";
}

std::vector<KnownValue> read_known(const TomlValue& table, const std::string& path,
                                   std::vector<Violation>& violations, KnownEffects effects) {
  std::vector<KnownValue> known;
  read_entries(table, "", path, effects, known, violations);
  return known;
}

const KnownValue* find_known(const std::vector<KnownValue>& known, std::string_view key) {
  for (const KnownValue& one : known)
    if (one.key == key) return &one;
  return nullptr;
}

const Parameter* find_component_number(KnownEffects effects, std::string_view key) {
  const EffectRecord* record = effects.find(effect_of(key));
  const Parameter* parameter = effects.find_parameter(key);
  const bool is_number = parameter != nullptr && parameter->kind == ParameterKind::number &&
                         std::count(key.begin(), key.end(), '.') == 1;
  return is_number && is_in_contacts(*record) ? parameter : nullptr;
}

std::string known_line(const KnownValue& known, KnownEffects effects) {
  const std::optional<Target> target = target_of(known.key, effects);
  EXPECT(target.has_value());
  return toml_string(known.key) + " = " +
         toml_string(write_quantity(known.value, target->unit) + " +- " +
                     write_quantity(known.error, target->unit));
}

}  // namespace shakedown
