// SPDX-License-Identifier: MIT
// Fits with full effort what a search has found, and drops what that made needless.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "key_unit.hpp"
#include "rules.hpp"
#include "state.hpp"

namespace shakedown {

namespace {

bool is_joint(const Knob& knob) { return joined_keys(knob.key).size() > 1; }

/// Returns a knob by itself for each key of those that move together.
std::vector<Knob> taken_apart(const std::vector<Knob>& knobs) {
  std::vector<Knob> parts;
  for (const Knob& knob : knobs)
    for (const std::string& key : joined_keys(knob.key)) {
      parts.push_back(knob);
      parts.back().key = key;
    }
  return parts;
}

/// Returns the better of the fits in two valleys, because two strengths that do much the same have two: most
/// of the one, or most of the other. Where the data do not tell which, its intervals reach over both.
Refit with_other_valley(const DiagnosisState& apart, const std::vector<std::string>& parts,
                        DiagnosisTools& tools, const std::string& stage) {
  DiagnosisState other = apart;
  const auto value_of = [&](const Refit& fit, const std::string& key) {
    return std::find_if(fit.values.begin(), fit.values.end(),
                        [&](const FittedValue& value) { return value.key == key; });
  };
  double sum = 0;
  for (const std::string& key : parts) sum += value_of(apart.fit, key)->value;
  const double mean = sum / static_cast<double>(parts.size());
  for (Knob& part : other.found) {
    if (std::find(parts.begin(), parts.end(), part.key) == parts.end()) continue;
    // What was below the mean begins where the range of such strengths ends (three times what both are
    // together, as in `concluded`), what was above it at half the mean.
    const bool was_below = value_of(apart.fit, part.key)->value < mean;
    part.centre = std::clamp(was_below ? 3 * mean : mean / 2, part.low, part.high);
    part.width = std::min(part.width, std::max(part.centre / 2, part.width / 10));
  }
  other.fit = tools.fit(other, stage, other.knobs(), effort::attempt);
  const double better = (apart.fit.scatter - other.fit.scatter) * apart.fit.degrees;
  if (std::abs(better) > rules::emulator_noise) return better > 0 ? other.fit : apart.fit;
  Refit both = better > 0 ? other.fit : apart.fit;
  for (FittedValue& value : both.values)
    for (const Refit* fit : {&std::as_const(apart).fit, &std::as_const(other).fit}) {
      const auto there = value_of(*fit, value.key);
      value.low = std::min(value.low, there->low), value.high = std::max(value.high, there->high);
    }
  return both;
}

}  // namespace

DiagnosisState concluded(const DiagnosisState& state, DiagnosisTools& tools, const std::string& stage) {
  DiagnosisState whole = state;
  const Effort effort = tools.affordable(state, effort::conclude, effort::conclude_in_haste);
  const bool in_haste = effort.count < effort::conclude.count;
  if (in_haste || std::none_of(state.found.begin(), state.found.end(), is_joint)) {
    whole.fit = tools.fit(state, stage, state.knobs(), effort);
    return whole;
  }
  DiagnosisState apart = state;
  apart.found = taken_apart(state.found);
  std::vector<std::string> parts;
  for (Knob& part : apart.found) {
    // One may be far from what both were together: from nothing to three times that.
    const bool was_joint = std::none_of(state.found.begin(), state.found.end(),
                                        [&](const Knob& knob) { return knob.key == part.key; });
    if (!was_joint) continue;
    parts.push_back(part.key);
    part.width = std::max(part.width, 1.5 * (part.centre - part.low));
    part.centre = std::max(part.centre, part.low + part.width);
  }
  apart.fit = tools.fit(apart, stage, apart.knobs(), effort::apart);
  try {
    apart.fit = with_other_valley(apart, parts, tools, stage);
  } catch (const BudgetSpent&) {  // the one that was found has to do
  }
  // Fitted by themselves they are too many for the emulator to follow.
  if ((apart.fit.scatter - state.fit.scatter) * apart.fit.degrees > rules::emulator_noise) {
    whole.fit = tools.fit(state, stage, state.knobs(), effort::conclude);
    return whole;
  }
  return apart;
}

DiagnosisState pruned(const DiagnosisState& state, DiagnosisTools& tools,
                      const std::vector<std::string>& from_balance, std::size_t added) {
  if (state.missing.size() < 2) return state;
  for (const std::string& effect : hardly_told(state, from_balance, added)) {
    DiagnosisState less = state;
    std::erase_if(less.setup.effects,
                  [&](const EffectChoice& choice) { return choice.record->name == effect; });
    std::erase_if(less.found, [&](const Knob& knob) { return effect_of(knob.key) == effect; });
    std::erase(less.missing, effect);
    less.scatter_at_start =
        std::numeric_limits<double>::infinity();  // it was told of the model with the effect
    less.fit = tools.fit(less, "is " + effect + " still needed?", less.knobs(), effort::beside);
    if (less.fit.p_value <= rules::holds &&
        (less.fit.scatter - state.fit.scatter) * state.fit.degrees > rules::emulator_noise)
      continue;
    return pruned(less, tools, from_balance, 1);
  }
  return state;
}

}  // namespace shakedown
