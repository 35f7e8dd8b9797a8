// SPDX-License-Identifier: MIT
// Tells how far apart the hard and the soft engine are with each effect on, as measured. What an impulse and
// a force make of one law is not the same in layers, so the strength of an effect found with one engine in
// data of the other's kind is uncertain by that much.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace shakedown {

/// A row of engine_differences.csv: slopes of |peaks| (observe/observables.hpp) of ensembles; the paper's
/// damper at this box length, contacts of 0.3 ms in the soft engine. Measured with
/// tests/engines/effects_crosscheck.
struct EngineDifference {
  std::string effect;      ///< empty: the plain model
  std::string strength;    ///< at which it was measured, in words
  double box_length;       ///< m
  double hard_slope;       ///< m/s
  double hard_minus_soft;  ///< m/s
  double half_width;       ///< m/s, of the 95 % interval of hard_minus_soft
};

/// Returns all that were measured, as engine_differences.csv has them.
std::span<const EngineDifference> engine_differences();

/// What the effect does to the slope, and what it adds to the difference of the engines beyond that of the
/// plain model, all at the strength measured and in m/s. |added| / |change| is the relative uncertainty of a
/// strength, to first order in it.
struct AddedDifference {
  double change;      ///< of the hard engine's slope by the effect
  double added;       ///< to hard minus soft
  double half_width;  ///< of the 95 % interval of `added`
};

/// Returns nothing for an effect or a box length (m) that was not measured (40 and 104 mm were).
std::optional<AddedDifference> added_difference(std::string_view effect, double box_length);

/// Returns the relative uncertainty of a strength that was found with one engine in data of the other's kind:
/// root mean square over the lengths of added / change where `added` differs from zero (else 0), weighted by
/// how well it is known; 0 where none was looked for.
double strength_uncertainty(std::string_view effect);

}  // namespace shakedown
