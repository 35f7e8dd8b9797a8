// SPDX-License-Identifier: MIT
#include "effect_strength.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "key_unit.hpp"
#include "quantity.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

constexpr double strongest_over_typical = 10;

double neutral_of(const Parameter& parameter) {
  return std::isnan(parameter.neutral) ? 0.0 : parameter.neutral;
}

/// Returns the strengths that the parameters suggest, without levels and bounds.
std::vector<SearchedStrength> suggested(const EffectRecord& record) {
  for (const Parameter& parameter : record.parameters) {
    const double change = parameter.typical - neutral_of(parameter);
    if (std::isnan(parameter.neutral) || change == 0) continue;
    const std::string name(parameter.name);
    if (parameter.kind == ParameterKind::number) return {{.parameters = name, .typical = change}};
    if (parameter.kind == ParameterKind::vector)
      return {{.parameters = name + ".x", .typical = change},
              {.parameters = name + ".y", .typical = change},
              {.parameters = name + ".z", .typical = change}};
  }
  return {};
}

/// Returns half, once and twice the typical strength; of a length that must be infinite, twice, once and
/// half.
std::vector<double> usual_levels(const SearchedStrength& strength, double absent) {
  std::vector<double> levels;
  for (const double factor : {0.5, 1.0, 2.0}) {
    const double level = strength.inverse ? strength.typical / factor : strength.typical * factor;
    const double value = strength.inverse ? level : absent + level;
    if (factor == 1 || (strength.low <= value && value <= strength.high)) levels.push_back(level);
  }
  return levels;
}

double usual_strongest(const SearchedStrength& strength, double absent) {
  if (strength.inverse) return std::max(strength.low, strength.typical / strongest_over_typical);
  const double value = absent + strongest_over_typical * strength.typical;
  return std::clamp(value, strength.low, strength.high) - absent;
}

}  // namespace

Search search_of(const EffectRecord& record) {
  Search search = record.search;
  if (search.strengths.empty()) search.strengths = suggested(record);
  for (SearchedStrength& strength : search.strengths) {
    const Parameter& parameter = parameter_of(record, strength);
    const double absent = absent_value(record, strength, Setup{});
    if (strength.typical == 0) strength.typical = parameter.typical - (strength.inverse ? 0 : absent);
    if (strength.low == 0 && strength.high == 0) {
      strength.low = strength.even ? std::max(0.0, parameter.low) : parameter.low;
      strength.high = parameter.high;
    }
    if (strength.levels.empty()) strength.levels = usual_levels(strength, absent);
    if (strength.strongest == 0) strength.strongest = usual_strongest(strength, absent);
  }
  return search;
}

std::string keys_of(const EffectRecord& record, const SearchedStrength& strength) {
  std::string keys;
  for (const std::string& parameter : joined_keys(strength.parameters))
    keys += (keys.empty() ? "" : "&") + std::string(record.name) + "." + parameter;
  return keys;
}

const Parameter& parameter_of(const EffectRecord& record, const SearchedStrength& strength) {
  const std::string first = joined_keys(strength.parameters).front();
  const Parameter* parameter = record.find(first.substr(0, first.find('.')));
  EXPECT(parameter != nullptr);
  return *parameter;
}

double absent_value(const EffectRecord& record, const SearchedStrength& strength, const Setup& setup) {
  if (strength.inverse) return std::numeric_limits<double>::infinity();
  if (strength.absent_key.empty()) return neutral_of(parameter_of(record, strength));
  const SetupKey* key = find_setup_key(strength.absent_key);
  EXPECT(key != nullptr);
  return numbers_of(*key, setup).at(0);
}

double value_at_level(const SearchedStrength& strength, double level, double absent) {
  if (strength.inverse) return level;
  constexpr double nearly_all = 0.8;  // of the level: at the bound it still is one, else on the other side
  const double there = std::clamp(absent + level, strength.low, strength.high);
  return std::abs(there - absent) >= nearly_all * std::abs(level)
             ? there
             : std::clamp(absent - level, strength.low, strength.high);
}

std::string strength_in_words(const EffectRecord& record, const SearchedStrength& strength, double value) {
  const Parameter& parameter = parameter_of(record, strength);
  const std::string_view unit = parameter.unit_shown.empty() ? parameter.unit : parameter.unit_shown;
  const double si = std::get<Unit>(parse_unit(unit)).si;
  const std::string label(record.label.empty() ? record.name : record.label);
  std::array<char, 32> number;
  std::snprintf(number.data(), number.size(), "%.3g", value / si);
  return label + ", " + number.data() + (unit.empty() ? "" : " " + std::string(unit));
}

std::string_view family_of(const EffectRecord& record) {
  return record.family.empty() ? record.name : record.family;
}

}  // namespace shakedown
