// SPDX-License-Identifier: MIT
// Numbers with units, at the borders of the program only. Dimensions are powers of metre, kilogram, second.
#pragma once
#include <compare>
#include <string>
#include <string_view>
#include <variant>

namespace shakedown {

struct Dimension {
  int metre = 0, kilogram = 0, second = 0;
  auto operator<=>(const Dimension&) const = default;
};

/// A unit's size in SI and its dimension.
struct Unit {
  double si = 1;
  Dimension dimension;
};

struct Quantity {
  double si = 0;
  Dimension dimension;
};

/// Either a value or the reason in words why there is none.
template <class T>
using ValueOrReason = std::variant<T, std::string>;

/// Reads a unit: "mm", "g", "Hz", "N s/m", "N s^2/m^2", "m/s^2", "mN", "deg", "%", "" ... with products by
/// space, dot or *, each "/" dividing by the factor after it, powers by ^, and brackets.
ValueOrReason<Unit> parse_unit(std::string_view text);

/// Reads a quantity: "107.5 mm", "1.23 Hz", "65mm". A bare number gives the dimension of a pure number.
/// Decimal units are exact: "107.5 mm" is the double nearest to 0.1075 m.
ValueOrReason<Quantity> parse_quantity(std::string_view text);

/// Returns a dimension in words: "a length (m)", "a pure number", "kg m^2/s" when it has no name.
std::string describe(const Dimension& dimension);

/// Returns the shortest text that reads back to exactly this value in this unit: "40 mm" of (0.04, "mm").
/// `si` must be finite.
std::string write_quantity(double si, std::string_view unit);

/// Returns the shortest decimal text of a number that reads back to it, e.g. "0.75"; "nan", "inf".
std::string write_number(double value);

}  // namespace shakedown
