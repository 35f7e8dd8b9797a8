// SPDX-License-Identifier: MIT
// Reads what was weighed and measured before the experiment, and how well: [known] of an experiment file.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "errors.hpp"
#include "known_effects.hpp"
#include "toml_document.hpp"

namespace shakedown {

struct SetupKey;

/// A value goes before the setup's own; an error of 0 fixes it. `key` is a numeric key of the setup
/// ("box.mass", "restitution.grain_grain"), one of camera_keys(), or a number of an effect inside the
/// contacts or on the grains, as a component test tells it ("grain_friction.grain_wall").
struct KnownValue {
  std::string key;
  double value = 0;   ///< SI; of camera and clock as a rule 0: nothing wrong expected
  double error = 0;   ///< SI, one standard deviation; 0: exact
  SourcePlace place;  ///< of the key in the experiment file
};

/// What a camera and its clock may do to positions and times; keys of [known] beside those of the setup.
struct CameraKey {
  std::string_view path;  ///< "camera.scale"
  std::string_view unit;  ///< in which people write it; empty: a ratio
  bool positive = false;  ///< a size (of a wander), which cannot be negative
  bool each_run = false;  ///< drawn anew in every run; else common to all
  std::string_view sentence;
};
/// Returns all keys of camera and clock.
std::span<const CameraKey> camera_keys();

/// Returns a value as it could stand in a file: "0 +- 0.5 %".
std::string example_of(const CameraKey& key);

/// Returns the keys of the setup that [known] can say: numbers that somebody can measure.
std::vector<const SetupKey*> knowable_setup_keys();

/// Tells whether a key is drawn anew in every run, so that its error is of each run by itself: the release
/// and the trigger.
bool is_of_each_run(std::string_view key);

/// Tells whether a key may differ between the runs of one experiment: not restitutions, the spring, a
/// tracker's wander.
bool may_differ_between_runs(std::string_view key);

/// Reads [known]: keys in quotes ("box.mass") or with a dot, values as `value +- error [unit]` with the unit
/// once or with both. What is wrong goes to `violations`; `path` stands before the keys there. `effects`:
/// those whose numbers may be said.
std::vector<KnownValue> read_known(const TomlValue& table, const std::string& path,
                                   std::vector<Violation>& violations, KnownEffects effects = {});

/// Returns the value of this key, nullptr when it is not known.
const KnownValue* find_known(const std::vector<KnownValue>& known, std::string_view key);

/// Returns the number of an effect that a component test tells: of what acts inside the contacts or on the
/// grains, a number by itself. Null for all else; what acts on the box the momentum balance measures.
const Parameter* find_component_number(KnownEffects effects, std::string_view key);

/// Returns the value as a line of an experiment file, without its end: "box.mass" = "434 g +- 2 g".
std::string known_line(const KnownValue& known, KnownEffects effects = {});

}  // namespace shakedown
