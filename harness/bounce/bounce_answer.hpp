// SPDX-License-Identifier: MIT
// The answer about drops as text, as JSON and as lines of an experiment file.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "drop_tables.hpp"
#include "law_choice.hpp"

namespace shakedown {

/// Everything that a report shows.
struct BounceReading {
  ReadDrops read;
  BounceOptions options;
  BounceAnswer answer;
  LawFit as_timed;  ///< the free curve without air: ratios of flights
};

/// Reads no file: chooses the law and fits the curve that needs none.
BounceReading weigh_drops(ReadDrops read, const BounceOptions& options);

/// "power, scattering from impact to impact" in a sentence with numbers.
std::string sentence_of(const BounceReading& reading);
std::string bounce_text(const BounceReading& reading);
nlohmann::ordered_json bounce_json(const BounceReading& reading);

/// Speeds, ascending, at which the restitution is told.
std::vector<double> speeds_told(const BounceAnswer& answer);

/// "throw 3 of FILE, impact 4"
std::string place_of(const Drop& drop, int impact);

/// Lines for an experiment file's [known] with the restitution at the reference speed, and, as comments, the
/// law as effects of a setup. `contact`: "grain_grain" or "grain_wall".
std::string known_lines(const BounceReading& reading, const std::string& contact);

/// The law as [[effect]] tables of a setup; empty for a constant without scatter.
std::string effect_lines(const BounceReading& reading);

}  // namespace shakedown
