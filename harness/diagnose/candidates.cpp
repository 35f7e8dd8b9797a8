// SPDX-License-Identifier: MIT
#include "candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "effect_strength.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "physics.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

constexpr std::array probes{-0.08, -0.02, 0.03, 0.1};  // m, m/s and s: where forces are compared

/// What acts on box and grains along the axis from outside, all of them at one place.
double force_from_outside(const Physics& physics, double grains, double x, double v, double t) {
  const auto swing = [t](double frequency, double phase) {
    return std::sin(2 * std::numbers::pi * frequency * t + phase);
  };
  double force = -physics.stiffness * x * (1 + physics.spring_cubic * x * x) - physics.box.viscous * v -
                 std::copysign(physics.box.dry_friction, v) + physics.box.constant +
                 grains * physics.grains.constant.x();
  for (const Harmonic& one : physics.box.harmonics) force += one.amplitude * swing(one.frequency, one.phase);
  for (const auto& one : physics.grains.harmonics)
    force += grains * one.amplitude.x() * swing(one.frequency, one.phase);
  for (const FreeForce& one : physics.box.free) force += one.newton(x, v, t);
  return force;
}

/// The momentum balance of box and grains is not the same with both.
bool balance_differs(const Physics& a, const Physics& b, double grains) {
  // A scale and a clock that is late leave the balance as it is.
  const auto seen = [](const Camera& camera) {
    return std::array{camera.centre_bias, camera.arc_length, camera.drift,  camera.depth,
                      camera.origin,      camera.lens,       camera.shutter};
  };
  if (a.box_mass != b.box_mass || seen(a.camera) != seen(b.camera) ||
      a.grains.free.size() != b.grains.free.size())
    return true;
  for (const double x : probes)
    for (const double v : probes)
      for (const double t : probes)
        if (force_from_outside(a, grains, x, v, t) != force_from_outside(b, grains, x, v, t)) return true;
  return false;
}

/// A knob about the effect's absence, one typical strength wide; of what does the same with both signs about
/// that strength, for nothing is linear about zero.
Knob knob_of(const EffectRecord& record, const SearchedStrength& strength, const Setup& setup) {
  Knob knob{keys_of(record, strength), 0, std::abs(strength.typical), strength.low, strength.high, true};
  if (strength.inverse) {
    knob.centre = strength.typical;
    knob.width = strength.typical / 2;
  } else {
    knob.centre = strength.even ? strength.typical : absent_value(record, strength, setup);
  }
  knob.cubic = strength.levels.size() > 3;
  return knob;
}

Candidate candidate_of(const EffectRecord& record, const Search& search, const SearchedStrength& strength,
                       const Setup& setup) {
  Candidate candidate;
  candidate.effect = record.name;
  candidate.doubt = -2 * std::log(search.odds);
  candidate.dear = search.cost == Search::Cost::dear;
  candidate.slow = search.cost == Search::Cost::slow;
  candidate.always = search.hides_in_restitution;
  for (const auto& [parameter, value] : search.besides)
    candidate.fixed.emplace_back(candidate.effect + "." + std::string(parameter), value);
  const Knob knob = knob_of(record, strength, setup);
  (strength.inverse ? candidate.when_tried : candidate.knobs).push_back(knob);
  if (strength.inverse) candidate.fixed.emplace_back(knob.key, strength.typical);
  return candidate;
}

/// The setup with the effect at its typical strength.
Setup with_effect(const Setup& setup, const Candidate& candidate, const SearchedStrength& strength,
                  double absent, std::span<const EffectRecord* const> known) {
  Setup changed = prepared(setup, candidate, known);
  for (const std::string& key : joined_keys(candidate.fitted_knobs().front().key))
    set_number(changed, key, value_at_level(strength, strength.typical, absent), known);
  return changed;
}

std::vector<Candidate> all_candidates(const Setup& setup, std::span<const EffectRecord* const> known) {
  std::vector<Candidate> list;
  const Physics plain = physics_of(setup);
  const double grains = setup.grains.count * setup.grains.mass;
  for (const EffectRecord* record : known) {
    const Search search = search_of(*record);
    const bool elsewhere = search.harmonic.has_value();  // the balance finds tones
    if (elsewhere || !search.not_searched.empty() || find_choice(setup, record->name) != nullptr) continue;
    for (const SearchedStrength& strength : search.strengths) {
      Candidate candidate = candidate_of(*record, search, strength, setup);
      try {
        const double absent = absent_value(*record, strength, setup);
        const Physics with = physics_of(with_effect(setup, candidate, strength, absent, known));
        candidate.seen_by_momentum = balance_differs(plain, with, grains);
        list.push_back(std::move(candidate));
      } catch (const InputError&) {  // this setup cannot have it: a cubic spring without a displacement
      }
    }
  }
  return list;
}

}  // namespace

std::vector<Candidate> candidates_for(const Setup& setup, const std::vector<std::string>& only,
                                      std::span<const EffectRecord* const> known) {
  std::vector<Candidate> list = all_candidates(setup, known);
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

Setup prepared(const Setup& setup, const Candidate& candidate, std::span<const EffectRecord* const> known) {
  Setup changed = setup;
  for (const auto& [key, value] : candidate.fixed) set_number(changed, key, value, known);
  return changed;
}

}  // namespace shakedown
