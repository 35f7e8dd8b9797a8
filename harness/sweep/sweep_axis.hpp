// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "effect.hpp"
#include "known_effects.hpp"

namespace shakedown {

struct Setup;

/// One parameter of a sweep and the values that it takes.
struct SweepAxis {
  std::string key;             ///< path of a numeric key of the setup or of an effect
  std::string unit;            ///< in which people read its values; empty: a pure number
  std::vector<double> values;  ///< SI, in the order given

  /// Returns "box_length_mm", for columns of tables.
  std::string column() const;
  /// Returns the value in the axis' own unit.
  double shown(double si) const;
};

/// Reads "box.length=25mm:600mm:5mm" (from, to and step; the end is included where the steps hit it) or
/// "box.length=40mm,65mm,104mm". A unit after the last number alone holds for all: "25:600:5 mm". Values are
/// the decimal numbers that a person would write: 25 mm + 3 x 5 mm is exactly the 40 mm of a setup file.
/// Throws InputError.
SweepAxis parse_axis(std::string_view text, KnownEffects known);

/// Reads several at once, every violation together; refuses one key twice and more than two axes.
std::vector<SweepAxis> parse_axes(const std::vector<std::string>& texts, KnownEffects known);

}  // namespace shakedown
