// SPDX-License-Identifier: MIT
#include "candidates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "camera.hpp"
#include "effect_strength.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "physics.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

/// Returns a knob about the effect's absence, one typical strength wide. For what does the same with both
/// signs, and for a length, it stands about the typical strength: nothing is linear about zero.
Knob knob_of(const EffectRecord& record, const SearchedStrength& strength, const Setup& setup) {
  Knob knob{keys_of(record, strength), 0, std::abs(strength.typical), strength.low, strength.high, true};
  if (strength.inverse) {
    knob.centre = strength.typical;
    knob.width = strength.typical / 2;
  } else {
    knob.centre = strength.even ? strength.typical : absent_value(record, strength, setup);
    // What is looked for from a strength on is scattered beyond it too.
    knob.width = std::max(knob.width, 2 * (strength.low - knob.centre));
  }
  knob.absent = absent_value(record, strength, setup);
  knob.absent_key = strength.absent_key;
  constexpr std::size_t for_a_cubic = 4;
  knob.cubic = strength.levels.size() >= for_a_cubic;
  const std::optional<CameraParameter> of_camera = camera_parameter_of(record);
  knob.exact = !strength.inverse && of_camera && of_camera->path == knob.key;
  if (knob.exact) knob.curved = knob.cubic = false;
  return knob;
}

/// Sets levels and possible strengths. A polynomial through the levels is trusted up to twice the strongest;
/// where there are levels of both signs, of each. `makes_room`: the parameter that it replaces a part of is
/// free, and moves beside it.
void set_levels(Candidate& candidate, const SearchedStrength& strength, double absent, bool makes_room) {
  constexpr double trusted = 2;
  double lowest = 0, highest = 0;
  for (const double level : strength.levels) {
    const double value = makes_room ? std::clamp(absent + level, strength.low, strength.high)
                                    : value_at_level(strength, level, absent);
    candidate.levels.push_back({value, makes_room ? level : candidate.strength_of(value)});
    lowest = std::min(lowest, candidate.levels.back().strength);
    highest = std::max(highest, candidate.levels.back().strength);
  }
  // Sort the weakest first: what is hopeless there need not be simulated stronger.
  std::stable_sort(candidate.levels.begin(), candidate.levels.end(),
                   [](const Candidate::Level& a, const Candidate::Level& b) {
                     return std::abs(a.strength) < std::abs(b.strength);
                   });
  if (lowest == 0) lowest = -highest;
  if (highest == 0) highest = -lowest;
  const double range = strength.high - strength.low;
  const auto [low, high] =
      makes_room ? std::minmax({-range, range})
                 : std::minmax({candidate.strength_of(strength.low), candidate.strength_of(strength.high)});
  candidate.strengths = {candidate.prior.typical, std::max(low, trusted * lowest),
                         std::min(high, trusted * highest)};
  if (strength.even) candidate.strengths.low = std::max(candidate.strengths.low, 0.0);
}

Candidate candidate_of(const EffectRecord& record, const Search& search, const SearchedStrength& strength,
                       const Setup& setup, bool makes_room) {
  Candidate candidate;
  candidate.effect = record.name;
  candidate.dear = search.cost == Search::Cost::dear;
  candidate.slow = search.cost == Search::Cost::slow;
  for (const auto& [parameter, value] : search.besides)
    candidate.fixed.emplace_back(candidate.effect + "." + std::string(parameter), value);
  const Knob knob = knob_of(record, strength, setup);
  (strength.inverse ? candidate.when_tried : candidate.knobs).push_back(knob);
  if (strength.inverse) candidate.fixed.emplace_back(knob.key, strength.typical);
  const double typical = std::abs(strength.typical);
  candidate.prior.typical = strength.inverse ? 1 / (typical * typical) : typical;
  candidate.prior.one_sided =
      strength.inverse || strength.even || (strength.low >= 0 && strength.absent_key.empty());
  candidate.prior.odds = search.odds;
  set_levels(candidate, strength, absent_value(record, strength, setup), makes_room);
  return candidate;
}

/// Leaves the search strengths from `least` on.
void look_from(Search& search, double least) {
  for (SearchedStrength& strength : search.strengths) {
    strength.low = std::max(strength.low, least);
    std::erase_if(strength.levels, [&](double level) { return level < least; });
  }
}

/// Returns each of the searches, once for each value of this shape.
std::vector<Search> with_each(const std::vector<Search>& searches, const SearchedShape& shape) {
  std::vector<Search> shapes;
  for (const Search& search : searches)
    for (std::size_t i = 0; i < shape.values.size(); ++i) {
      shapes.push_back(search);
      shapes.back().odds /= static_cast<double>(shape.values.size());
      for (auto& [parameter, beside] : shapes.back().besides)
        if (parameter == shape.parameter) beside = shape.values[i];
      if (!shape.least_strengths.empty()) look_from(shapes.back(), shape.least_strengths.at(i));
    }
  return shapes;
}

/// Returns the same search, once for each value of its shapes. The momentum balance tells those of what acts
/// on the box.
std::vector<Search> shapes_of(const EffectRecord& record, const Search& search) {
  if (!has_shapes(record)) return {search};
  std::vector<Search> searches{search};
  for (const SearchedShape& shape : search.shapes) searches = with_each(searches, shape);
  return searches;
}

/// Tells whether this setup can have it; a cubic spring cannot be without a displacement.
bool possible_in(Setup setup, const Candidate& candidate, KnownEffects known) {
  try {
    Knob knob = candidate.fitted_knobs().front();
    knob.centre = knob.at(1);
    setup = prepared(setup, candidate, known);
    set_knob(setup, knob, known);
    physics_of(setup);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Tells whether another effect of the setup has replaced the part of the model that this one would.
bool is_claimed(const Setup& setup, const EffectRecord& record) {
  return !record.claims.empty() &&
         std::any_of(setup.effects.begin(), setup.effects.end(), [&](const EffectChoice& choice) {
           return choice.record != &record && choice.record->claims == record.claims;
         });
}

/// Tells whether an effect without which it would do nothing is not there.
bool is_needy(const Setup& setup, const EffectRecord& record) {
  return !record.needs.empty() && find_choice(setup, record.needs) == nullptr;
}

/// Tells whether the setup has this strength already, another component of the same effect left aside.
bool is_present(const Setup& setup, const EffectRecord& record, const SearchedStrength& strength,
                KnownEffects known) {
  if (find_choice(setup, record.name) == nullptr) return false;
  const std::vector<std::string> keys = joined_keys(keys_of(record, strength));
  const double absent = absent_value(record, strength, setup);
  return std::any_of(keys.begin(), keys.end(),
                     [&](const std::string& key) { return get_number(setup, key, known) != absent; });
}

std::vector<Candidate> all_candidates(const Setup& setup, KnownEffects known, const Engine& engine,
                                      const std::vector<Knob>& free) {
  std::vector<Candidate> list;
  const auto is_free = [&](std::string_view key) {
    return std::any_of(free.begin(), free.end(),
                       [&](const Knob& knob) { return knob.key == key && !knob.exact; });
  };
  for (const EffectRecord* record : known) {
    const Search search = search_of(*record);
    // The balance finds sines.
    if (record->nuisance || search.harmonic || !search.not_searched.empty() || is_claimed(setup, *record) ||
        is_needy(setup, *record) || !is_modelled(engine, *record))
      continue;
    for (const SearchedStrength& strength : search.strengths) {
      if (is_present(setup, *record, strength, known)) continue;
      const auto index = static_cast<std::size_t>(&strength - search.strengths.data());
      for (const Search& shaped : shapes_of(*record, search)) {
        Candidate candidate =
            candidate_of(*record, shaped, shaped.strengths[index], setup, is_free(strength.absent_key));
        if (possible_in(setup, candidate, known)) list.push_back(std::move(candidate));
      }
    }
  }
  return list;
}

}  // namespace

double Candidate::value_of(double strength) const {
  const Knob& knob = fitted_knobs().front();
  if (!std::isinf(knob.absent)) return knob.at(knob.z_of(knob.absent + strength));
  return strength > 0 ? std::clamp(1 / std::sqrt(strength), knob.low, knob.high) : knob.high;
}

double Candidate::strength_of(double value) const {
  const double absent = fitted_knobs().front().absent;
  return std::isinf(absent) ? 1 / (value * value) : value - absent;
}

bool has_shapes(const EffectRecord& record) {
  return !record.search.shapes.empty() &&
         (record.acts_on == ActsOn::grains || record.acts_on == ActsOn::contact);
}

std::vector<std::size_t> by_odds_for_cost(const std::vector<Candidate>& candidates) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto odds = [&](std::size_t c) { return candidates[c].prior.odds / candidates[c].plain_runs(); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return odds(a) > odds(b); });
  return order;
}

bool is_modelled(const Engine& engine, const EffectRecord& record) {
  const EffectChoice choice = with_defaults(record);
  Capability capability = engine.can_model(record);
  if (record.capability_of != nullptr) capability = record.capability_of(choice, engine.name(), capability);
  return capability.fidelity != Fidelity::not_modelled;
}

std::vector<Candidate> candidates_for(const Setup& setup, const std::vector<std::string>& only,
                                      KnownEffects known, const Engine& engine,
                                      const std::vector<Knob>& free) {
  std::vector<Candidate> list = all_candidates(setup, known, engine, free);
  std::erase_if(list, [&](const Candidate& candidate) {
    return !only.empty() && std::find(only.begin(), only.end(), candidate.effect) == only.end();
  });
  return list;
}

ScatterGroups scatter_groups(const std::vector<Candidate>& candidates) {
  ScatterGroups groups;
  std::map<std::string, std::vector<std::size_t>> slow;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (candidates[c].knobs.empty()) continue;
    if (candidates[c].dear)
      groups.dear.push_back({c});
    else
      (candidates[c].slow ? slow[candidates[c].effect] : groups.cheap).push_back(c);
  }
  for (auto& [effect, members] : slow) groups.slow.push_back(std::move(members));
  return groups;
}

Setup prepared(const Setup& setup, const Candidate& candidate, KnownEffects known) {
  Setup changed = setup;
  for (const auto& [key, value] : candidate.fixed) set_number(changed, key, value, known);
  return changed;
}

}  // namespace shakedown
