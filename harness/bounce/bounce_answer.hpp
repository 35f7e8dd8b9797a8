// SPDX-License-Identifier: MIT
// Gives the answer about drops as text, as JSON and as lines of an experiment file.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "drop_reading.hpp"
#include "law_choice.hpp"

namespace shakedown {

/// Everything that a report shows.
struct BounceReading {
  ReadDrops read;
  BounceOptions options;
  BounceAnswer answer;
  LawFit as_timed;  ///< the free curve without air: ratios of flights
};

/// Chooses the law by drops that were read, and fits the curve that needs no law.
BounceReading weigh_drops(ReadDrops read, const BounceOptions& options);

/// Returns the law in a sentence with numbers: how the restitution changes, by which law, and how it
/// scatters.
std::string sentence_of(const BounceReading& reading);
/// Returns the answer as text for a terminal: the sentence, the laws with their probabilities, the
/// restitution at speeds_told(), timing noise and scatter, and the impacts left out.
std::string bounce_text(const BounceReading& reading);
/// Returns the answer as JSON (schema_version 1): the same numbers, and all impacts and drops; units in the
/// keys.
nlohmann::ordered_json bounce_json(const BounceReading& reading);

/// Returns six speeds from the slowest to the fastest impact, m/s, at which the restitution is told.
std::vector<double> speeds_told(const BounceAnswer& answer);

/// Returns "FILE, throw 3, impact 4".
std::string place_of(const Drop& drop, int impact);

/// Returns lines for an experiment file's [known] with the restitution at the reference speed, and, as
/// comments, the law as effects of a setup. `contact`: "grain_grain" or "grain_wall".
std::string known_lines(const BounceReading& reading, const std::string& contact);

/// Returns what of the law a setup says with [[effect]] tables: a viscoelastic law, and scatter of 95 %
/// probability; empty without these.
std::string effect_lines(const BounceReading& reading);

}  // namespace shakedown
