// SPDX-License-Identifier: MIT
#include "quantity.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "errors.hpp"
#include "text.hpp"

namespace shakedown {

namespace {

/// A unit as factor * 10^power_of_ten: decimal prefixes stay exact because they only move the decimal point
/// of the number.
struct Scale {
  double factor = 1;
  int power_of_ten = 0;
  Dimension dimension;
};

struct Name {
  std::string_view text;
  Scale scale;
  bool takes_prefix = false;
};

constexpr double pi = std::numbers::pi;
constexpr std::array unit_names{
    Name{"m", {1, 0, {1, 0, 0}}, true},
    Name{"g", {1, -3, {0, 1, 0}}, true},
    Name{"s", {1, 0, {0, 0, 1}}, true},
    Name{"Hz", {1, 0, {0, 0, -1}}, true},
    Name{"N", {1, 0, {1, 1, -2}}, true},
    Name{"J", {1, 0, {2, 1, -2}}, true},
    Name{"W", {1, 0, {2, 1, -3}}, true},
    Name{"Pa", {1, 0, {-1, 1, -2}}, true},
    Name{"min", {60, 0, {0, 0, 1}}},
    Name{"h", {3600, 0, {0, 0, 1}}},
    Name{"rad", {1, 0, {}}, true},
    Name{"deg", {pi / 180, 0, {}}},
    Name{"%", {1, -2, {}}},
    Name{"1", {1, 0, {}}},
    Name{"g0", {9.80665, 0, {1, 0, -2}}},
};

struct Prefix {
  std::string_view text;
  int power_of_ten;
};
constexpr std::array prefixes{Prefix{"G", 9},  Prefix{"M", 6},       Prefix{"k", 3},
                              Prefix{"c", -2}, Prefix{"m", -3},      Prefix{"u", -6},
                              Prefix{"n", -9}, Prefix{"\u00b5", -6}, Prefix{"\u03bc", -6}};

std::optional<Scale> scale_of(std::string_view name) {
  for (const Name& known : unit_names)
    if (known.text == name) return known.scale;
  for (const Prefix& prefix : prefixes) {
    if (!name.starts_with(prefix.text)) continue;
    for (const Name& known : unit_names)
      if (known.takes_prefix && known.text == name.substr(prefix.text.size())) {
        Scale scale = known.scale;
        scale.power_of_ten += prefix.power_of_ten;
        return scale;
      }
  }
  return {};
}

Scale power(Scale base, int exponent) {
  return {std::pow(base.factor, exponent),
          base.power_of_ten * exponent,
          {base.dimension.metre * exponent, base.dimension.kilogram * exponent,
           base.dimension.second * exponent}};
}

Scale product(const Scale& a, const Scale& b) {
  return {a.factor * b.factor,
          a.power_of_ten + b.power_of_ten,
          {a.dimension.metre + b.dimension.metre, a.dimension.kilogram + b.dimension.kilogram,
           a.dimension.second + b.dimension.second}};
}

struct UnitReader {
  std::string_view rest;
  std::string reason;  ///< not empty: failed

  bool take(std::string_view word) {
    if (!rest.starts_with(word)) return false;
    rest.remove_prefix(word.size());
    return true;
  }
  void skip_blanks() {
    while (take(" ") || take("\t")) continue;
  }
  void fail(std::string why) {
    if (reason.empty()) reason = std::move(why);
    rest = {};
  }

  int exponent() {
    if (take("\u00b2")) return 2;
    if (take("\u00b3")) return 3;
    if (!take("^") && !take("**")) return 1;
    int value = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error != std::errc{} || std::abs(value) > 9) {
      fail("needs a whole exponent from -9 to 9 after ^");
      return 1;
    }
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return value;
  }

  Scale factor() {
    skip_blanks();
    Scale scale;
    if (take("(")) {
      scale = expression();
      if (!take(")")) fail("has an open bracket");
    } else {
      std::size_t length = 0;  // \xc2\xb5 and \xce\xbc are the two micro signs
      const auto in_name = [&](std::size_t i) {
        const auto c = static_cast<unsigned char>(rest[i]);
        return std::isalnum(c) || c == '%' || c == 0xce || c == 0xbc || c == 0xb5 ||
               (c == 0xc2 && i + 1 < rest.size() && static_cast<unsigned char>(rest[i + 1]) == 0xb5);
      };
      while (length < rest.size() && in_name(length)) ++length;
      const std::string_view name = rest.substr(0, length);
      const std::optional<Scale> known = scale_of(name);
      if (!known) {
        fail(name.empty() ? "has no unit where one is expected"
                          : "has the unknown unit '" + std::string(name) + "'");
        return scale;
      }
      scale = *known;
      rest.remove_prefix(length);
    }
    return power(scale, exponent());
  }

  Scale expression() {
    Scale total = factor();
    for (skip_blanks(); !rest.empty() && !rest.starts_with(")"); skip_blanks()) {
      if (take("/")) {
        total = product(total, power(factor(), -1));
      } else {
        if (!take("*")) take("\u00b7");
        total = product(total, factor());
      }
    }
    return total;
  }
};

/// Longer texts are refused as units: people write none, and brackets within brackets are read by recursion.
constexpr std::size_t longest_unit = 200;

ValueOrReason<Scale> parse_scale(std::string_view text) {
  if (text.size() > longest_unit)
    return "has a unit of more than " + std::to_string(longest_unit) + " characters";
  UnitReader reader{trimmed(text), {}};
  if (reader.rest.empty()) return Scale{};
  const Scale scale = reader.rest.starts_with("/") ? Scale{} : reader.expression();
  Scale total = scale;
  while (reader.take("/")) total = product(total, power(reader.factor(), -1));  // "/s"
  if (reader.reason.empty() && !reader.rest.empty()) reader.fail("does not end after a unit");
  if (!reader.reason.empty()) return reader.reason;
  return total;
}

/// Returns `digits` (no exponent) times 10^exponent, correctly rounded.
double decimal(std::string_view digits, int exponent) {
  const std::string text = std::string(digits) + "e" + std::to_string(exponent);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // from_chars leaves the value alone beyond the range of a double.
  if (error == std::errc::result_out_of_range)
    return exponent < 0 ? 0.0 : std::numeric_limits<double>::infinity();
  return value;
}

/// Splits "1.5e-3" into "1.5" and -3; the exponent of a text without one is 0.
std::pair<std::string_view, int> split_exponent(std::string_view number) {
  const std::size_t e = number.find_first_of("eE");
  if (e == number.npos) return {number, 0};
  int exponent = 0;
  std::string_view digits = number.substr(e + 1);
  if (digits.starts_with("+")) digits.remove_prefix(1);
  if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec != std::errc{})
    exponent = digits.starts_with("-") ? -100000 : 100000;
  return {number.substr(0, e), exponent};
}

double scaled(std::string_view number, const Scale& scale) {
  const auto [digits, exponent] = split_exponent(number);
  return decimal(digits, exponent + scale.power_of_ten) * scale.factor;
}

/// Writes "d.ddd" with an exponent as plain digits when that is not longer than people like to read.
std::string plain(std::string digits, int exponent) {
  const bool negative = digits.starts_with("-");
  if (negative) digits.erase(0, 1);
  std::erase(digits, '.');
  const int size = static_cast<int>(digits.size());
  std::string text;
  if (exponent < -4 || exponent > 9) {
    text = digits.substr(0, 1) + (size > 1 ? "." + digits.substr(1) : "") + "e" + std::to_string(exponent);
  } else if (exponent < 0) {
    text = "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  } else if (size <= exponent + 1) {
    text = digits + std::string(static_cast<std::size_t>(exponent + 1 - size), '0');
  } else {
    text = digits.substr(0, static_cast<std::size_t>(exponent + 1)) + "." +
           digits.substr(static_cast<std::size_t>(exponent + 1));
  }
  return (negative ? "-" : "") + text;
}

/// Returns value * 10^shift with the shortest digits of value: moving the point loses nothing.
std::string shifted(double value, int shift) {
  if (value == 0) return std::signbit(value) ? "-0" : "0";
  std::array<char, 40> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific).ptr;
  const auto [digits, exponent] =
      split_exponent(std::string_view(buffer.data(), static_cast<std::size_t>(end - buffer.data())));
  return plain(std::string(digits), exponent + shift);
}

/// Returns, for units that are no power of ten, the fewest digits that read back exactly; nothing when none
/// do.
std::optional<std::string> searched(double si, const Scale& scale) {
  const double value = si / scale.factor;
  for (const double candidate : {value, std::nextafter(value, 1e308), std::nextafter(value, -1e308)})
    for (int precision = 0; precision < 17; ++precision) {
      std::array<char, 40> buffer{};
      const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), candidate,
                                     std::chars_format::scientific, precision)
                           .ptr;
      const std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
      if (scaled(text, {scale.factor, 0, {}}) != si) continue;
      const auto [digits, exponent] = split_exponent(text);
      return plain(std::string(digits), exponent - scale.power_of_ten);
    }
  return {};
}

std::string in_base_units(const Dimension& dimension) {
  std::string over, under;
  const auto add = [&](const char* unit, int exponent) {
    std::string& side = exponent > 0 ? over : under;
    if (exponent == 0) return;
    if (&side == &under)
      side += "/";
    else if (!side.empty())
      side += " ";
    side += unit + (std::abs(exponent) == 1 ? std::string{} : "^" + std::to_string(std::abs(exponent)));
  };
  add("kg", dimension.kilogram);
  add("m", dimension.metre);
  add("s", dimension.second);
  return (over.empty() ? "1" : over) + under;
}

}  // namespace

ValueOrReason<Unit> parse_unit(std::string_view text) {
  const ValueOrReason<Scale> scale = parse_scale(text);
  if (const auto* reason = std::get_if<std::string>(&scale)) return *reason;
  const Scale& found = std::get<Scale>(scale);
  return Unit{decimal("1", found.power_of_ten) * found.factor, found.dimension};
}

ValueOrReason<Quantity> parse_quantity(std::string_view text) {
  text = trimmed(text);
  std::string_view number = text;
  if (number.starts_with("+")) number.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error == std::errc::invalid_argument) return std::string("does not begin with a number");
  const std::string_view rest(end, static_cast<std::size_t>(number.data() + number.size() - end));
  number = number.substr(0, number.size() - rest.size());
  if (!std::isfinite(value) || error == std::errc::result_out_of_range)
    return std::string("is not a finite number");
  if (rest.starts_with(",")) return std::string("has a comma in the number (the decimal sign is a point)");
  const ValueOrReason<Scale> scale = parse_scale(rest);
  if (const auto* reason = std::get_if<std::string>(&scale)) return *reason;
  const Quantity quantity{scaled(number, std::get<Scale>(scale)), std::get<Scale>(scale).dimension};
  if (!std::isfinite(quantity.si)) return std::string("is not a finite number");
  return quantity;
}

std::string describe(const Dimension& dimension) {
  struct Known {
    Dimension dimension;
    const char* name;
  };
  static constexpr std::array known{
      Known{{0, 0, 0}, "a pure number"},
      Known{{1, 0, 0}, "a length (m)"},
      Known{{0, 1, 0}, "a mass (kg)"},
      Known{{0, 0, 1}, "a time (s)"},
      Known{{0, 0, -1}, "a frequency (Hz)"},
      Known{{1, 0, -1}, "a speed (m/s)"},
      Known{{1, 0, -2}, "an acceleration (m/s^2)"},
      Known{{1, 1, -2}, "a force (N)"},
      Known{{2, 1, -2}, "an energy (J)"},
      Known{{-1, 1, -2}, "a pressure (Pa)"},
      Known{{0, 1, -1}, "a viscous damping (N s/m)"},
      Known{{-1, 1, 0}, "a quadratic drag (N s^2/m^2)"},
      Known{{0, 1, -2}, "a stiffness (N/m)"},
  };
  for (const Known& candidate : known)
    if (candidate.dimension == dimension) return candidate.name;
  return in_base_units(dimension);
}

std::string write_quantity(double si, std::string_view unit) {
  EXPECT(std::isfinite(si));
  const ValueOrReason<Scale> parsed = parse_scale(unit);
  EXPECT(std::holds_alternative<Scale>(parsed));
  const Scale& scale = std::get<Scale>(parsed);
  const std::string suffix = unit.empty() ? "" : " " + std::string(unit);
  if (scale.factor == 1) return shifted(si, -scale.power_of_ten) + suffix;
  if (const std::optional<std::string> text = searched(si, scale)) return *text + suffix;
  const std::string base = in_base_units(scale.dimension);  // no decimal in this unit reads back to it
  return shifted(si, 0) + (base == "1" ? "" : " " + base);
}

std::string write_number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  return shifted(value, 0);
}

}  // namespace shakedown
