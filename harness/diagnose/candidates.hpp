// SPDX-License-Identifier: MIT
// Effects that may be missing, each with the knobs that say how strong it is.
#pragma once
#include <string>
#include <vector>

#include "emulator.hpp"
#include "evidence.hpp"
#include "known_effects.hpp"
#include "signature.hpp"

namespace shakedown {

struct Candidate {
  std::string effect;
  std::vector<Knob> knobs;  ///< one typical strength wide, about the effect's absence or, where both signs do
                            ///< the same, about that strength; empty: a length, which `when_tried` holds
  std::vector<std::pair<std::string, double>>
      fixed;  ///< setup paths and values (SI) that its presence needs besides, e.g. the length of the blade
  StrengthSeen prior{};            ///< what is typical of its strength; gain, value and error are not set
  bool dear = false;               ///< a run costs some ten times a plain one
  bool slow = false;               ///< a run costs three to five times a plain one
  std::vector<Knob> when_tried{};  ///< of a length: what its fit may vary

  /// Where its signature is simulated: value of the parameter, and strength from the effect's absence (of a
  /// length the curvature, 1/m^2).
  struct Level {
    double value = 0, strength = 0;
  };
  std::vector<Level> levels{};
  StrengthPrior strengths{};  ///< those that its levels and the parameter's bounds allow

  /// What a run costs, in plain ones (Search::Cost).
  double plain_runs() const { return dear ? 10 : slow ? 4 : 1; }

  /// What its fit varies; and the value of its parameter that has this strength from absence, and back.
  const std::vector<Knob>& fitted_knobs() const { return knobs.empty() ? when_tried : knobs; }
  double value_of(double strength) const;
  double strength_of(double value) const;
};

/// Every effect that `engine` models and that a diagnosis may add, given the setup's present values. Left out
/// are strengths that the setup has already, and effects that claim a part of the model that another of the
/// setup's effects has replaced. `only`: these alone (empty: all).
std::vector<Candidate> candidates_for(const Setup& setup, const std::vector<std::string>& only,
                                      KnownEffects known, const Engine& engine);

/// Ensembles try each value of its shape, as candidates of their own.
bool has_shapes(const EffectRecord& record);

/// Indices of the candidates, what is most probable beforehand for what it costs first, so that where
/// simulations run out as much as can be has been looked at.
std::vector<std::size_t> by_odds_for_cost(const std::vector<Candidate>& candidates);

/// True where the engine can run the setup with this effect at its defaults.
bool is_modelled(const Engine& engine, const EffectRecord& record);

/// Indices of the candidates with knobs, by which runs they are scattered in: the cheap ones together, then
/// what makes runs slow or dear, each effect apart (gravity across bends what drag does).
struct ScatterGroups {
  std::vector<std::size_t> cheap;
  std::vector<std::vector<std::size_t>> slow, dear;
};
ScatterGroups scatter_groups(const std::vector<Candidate>& candidates);

/// The setup with the candidate at no strength.
Setup prepared(const Setup& setup, const Candidate& candidate, KnownEffects known);

}  // namespace shakedown
