// SPDX-License-Identifier: MIT
// Describes what is hidden in synthetic measurements: the setup as its user believes it, the setup as it
// truly is, and the difference as an answer to be kept closed until a diagnosis is judged.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "measurements.hpp"
#include "setup_file.hpp"

namespace shakedown {

/// Reads `NAME` (at its typical strength, which may count from what is believed) or
/// `NAME=parameter:value,...` as overrides that put the effect into a setup, e.g.
/// "grain_friction=grain_grain:0.1,grain_wall:0.2", "constant_acceleration=acceleration.z:0.2 m/s^2". Throws
/// InputError with the place `origin` for a name that is no effect and for a part that sets nothing.
std::vector<Override> overrides_of_effect(std::string_view text, const std::string& origin = "--effect",
                                          const Setup& believed = {});

/// Returns the same for one strength of its search at this level.
std::vector<Override> overrides_of_strength(const EffectRecord& record, const SearchedStrength& strength,
                                            double level, const Setup& setup,
                                            const std::string& origin = "blind suite");

/// Returns the effect of the list whose law is written in the setup.
const EffectRecord& formula_effect();

/// Reads noise.box, noise.centre, fps, missing, outliers, jump, centre (true, false), lens, shutter, near,
/// wander (size/memory, "20um/0.3s"), trigger, release, rounding, edge, jitter, start, origin, stamped and
/// declared (true, false), as "key=value" parts. Throws InputError with everything that is wrong.
RecordingSettings parse_recording(const std::vector<std::string>& parts,
                                  const std::string& origin = "--camera");

/// Puts "box.mass=434 g +- 2 g" in the place of what is usually known, or beside it. Throws InputError with
/// everything that is wrong.
std::vector<KnownValue> with_known(std::vector<KnownValue> usual, const std::vector<std::string>& texts,
                                   const std::string& origin = "--known");

/// Holds the setup as its user believes it and as it truly is.
struct HiddenCase {
  Setup believed, truth;
};

/// Returns the effects that the truth has and the believed setup has not (or not so strong), in the order of
/// the truth; an effect written as a formula is "unknown", because no list has it.
std::vector<std::string> hidden_effects(const HiddenCase& hidden);

/// Tells whether a parameter of the damper (masses, lengths, restitutions, frequency ...) is not what the
/// user believes. What a model is not told of real runs (packing, seed, contact time, thresholds) does not
/// count.
bool has_other_parameters(const HiddenCase& hidden);

/// Returns the answer as JSON: hidden, laboratory (parameters that differ), nuisances (what a model is not
/// told), and the true setup as TOML.
std::string truth_json(const HiddenCase& hidden, const RecordingSettings& recording,
                       const std::string& engine, std::uint64_t seed);

}  // namespace shakedown
