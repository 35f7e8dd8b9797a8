// SPDX-License-Identifier: MIT
#include "sweep_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "key_unit.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

constexpr double most_values = 100000;
constexpr const char* remedy_form = "write KEY=FROM:TO:STEP or KEY=A,B,C, e.g. box.length=25mm:600mm:5mm";

[[noreturn]] void refuse_key(std::string_view key, std::string problem, std::string remedy = remedy_form) {
  throw InputError({{{"--vary", 0, 0}, std::string(key), std::move(problem), std::move(remedy)}});
}

/// Returns the unit in which people write the key's values. A key that does not exist is refused as
/// everywhere else.
std::string unit_of(const std::string& key, KnownEffects known) {
  try {
    (void)get_number(Setup{}, key, known);
  } catch (InputError& error) {
    for (Violation& violation : error.violations) violation.place.file = "--vary";
    throw InputError(error.violations);
  }
  return unit_of_key(key, known);
}

std::vector<std::string> parts_of(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back().push_back(c);
  }
  for (std::string& part : parts) {
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
  }
  return parts;
}

bool is_bare(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.eE+-") == text.npos;
}

/// Returns each part in SI. Parts without a unit take that of the last one.
std::vector<double> numbers_in(const std::string& key, std::vector<std::string> parts,
                               const std::string& unit) {
  const std::string& last = parts.back();
  const std::size_t digits = last.find_first_not_of("0123456789.eE+- ");
  const std::string common = digits == last.npos ? "" : last.substr(digits);
  std::vector<double> numbers;
  for (std::string& part : parts) {
    if (is_bare(part)) part += " " + common;
    const auto parsed = parse_quantity(part);
    if (const auto* reason = std::get_if<std::string>(&parsed))
      refuse_key(key, fmt::format("\"{}\" {}", part, *reason));
    const Quantity quantity = std::get<Quantity>(parsed);
    const Dimension due = std::get<Unit>(parse_unit(unit)).dimension;
    if (quantity.dimension != due)
      refuse_key(key,
                 fmt::format("\"{}\" is {} (needs {})", part, describe(quantity.dimension), describe(due)),
                 unit.empty() ? "give a bare number" : "give it in " + unit);
    if (!std::isfinite(quantity.si)) refuse_key(key, fmt::format("\"{}\" is not a finite number", part));
    numbers.push_back(quantity.si);
  }
  return numbers;
}

/// Returns from, from + step ... in decimal, so that values are what a setup file would say.
std::vector<double> steps(const std::string& key, double from, double to, double step,
                          const std::string& unit) {
  if (step == 0 || (to - from) / step < 0)
    refuse_key(key, "never gets from the first value to the last",
               "give a step other than 0 that leads there");
  const double count = std::floor((to - from) / step * (1 + 1e-9) + 1e-9) + 1;
  if (count > most_values)
    refuse_key(key, fmt::format("has {:.0f} values (at most {:.0f})", count, most_values),
               "take a larger step");
  const double si = std::get<Unit>(parse_unit(unit)).si;
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const double value = std::abs(from + i * step) < 1e-9 * std::abs(step) ? 0 : from + i * step;
    const std::string decimal = fmt::format("{:.12g} {}", value / si, unit);
    values.push_back(std::get<Quantity>(parse_quantity(decimal)).si);
  }
  return values;
}

}  // namespace

double SweepAxis::shown(double si) const { return si / std::get<Unit>(parse_unit(unit)).si; }

std::string SweepAxis::column() const {
  std::string name = key + (unit.empty() ? "" : "_" + unit);
  for (std::size_t at; (at = name.find('/')) != name.npos;) name.replace(at, 1, "_per_");
  for (char& c : name)
    if (c == '.' || c == ' ' || c == '*') c = '_';
  std::erase(name, '^');
  return name;
}

SweepAxis parse_axis(std::string_view text, KnownEffects known) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0) refuse_key(text, "names no range");
  SweepAxis axis{std::string(text.substr(0, equals)), "", {}};
  axis.unit = unit_of(axis.key, known);
  const std::string_view range = text.substr(equals + 1);
  const bool stepped = range.find(':') != range.npos;
  const std::vector<std::string> parts = parts_of(range, stepped ? ':' : ',');
  if (stepped && parts.size() != 3)
    refuse_key(axis.key, fmt::format("\"{}\" has {} parts (a range has 3)", range, parts.size()));
  const std::vector<double> numbers = numbers_in(axis.key, parts, axis.unit);
  axis.values = stepped ? steps(axis.key, numbers[0], numbers[1], numbers[2], axis.unit) : numbers;
  std::vector<double> sorted = axis.values;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    refuse_key(axis.key, "has one value twice", "name each value once");
  return axis;
}

std::vector<SweepAxis> parse_axes(const std::vector<std::string>& texts, KnownEffects known) {
  std::vector<SweepAxis> axes;
  std::vector<Violation> found;
  for (const std::string& text : texts) {
    try {
      axes.push_back(parse_axis(text, known));
      for (std::size_t i = 0; i + 1 < axes.size(); ++i)
        if (axes[i].key == axes.back().key) refuse_key(axes[i].key, "is varied twice", "give it one range");
    } catch (const InputError& error) {
      found.insert(found.end(), error.violations.begin(), error.violations.end());
    }
  }
  if (texts.size() > 2)
    found.push_back({{"--vary", 0, 0},
                     "",
                     fmt::format("given {} times (a sweep has one or two dimensions)", texts.size()),
                     "fix the others with --set"});
  if (!found.empty()) throw InputError(std::move(found));
  return axes;
}

}  // namespace shakedown
