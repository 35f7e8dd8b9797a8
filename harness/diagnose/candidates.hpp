// SPDX-License-Identifier: MIT
// Lists effects that may be missing, each with the knobs that say how strong it is.
#pragma once
#include <string>
#include <vector>

#include "emulator.hpp"
#include "evidence.hpp"
#include "known_effects.hpp"
#include "signature.hpp"

namespace shakedown {

/// Describes an effect that may be missing, in one of its forms.
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

  /// Says where its signature is simulated: value of the parameter, SI, and strength from the effect's
  /// absence (of a length the curvature, 1/m^2). Where the parameter's bounds allow less from where it is
  /// absent and that is free, that is to make room: the wall's restitution beside that of the side walls.
  struct Level {
    double value = 0, strength = 0;
  };
  std::vector<Level> levels{};
  StrengthPrior strengths{};  ///< those that its levels and the parameter's bounds allow

  /// Returns what a run costs, in plain ones (Search::Cost).
  double plain_runs() const { return dear ? 10 : slow ? 4 : 1; }

  /// Returns what its fit varies.
  const std::vector<Knob>& fitted_knobs() const { return knobs.empty() ? when_tried : knobs; }
  /// Returns the value of its parameter, SI, at this strength from absence, within the knob's bounds.
  double value_of(double strength) const;
  /// Returns the strength from absence at this value (SI): value less that of absence; of a length 1/value^2,
  /// 1/m^2.
  double strength_of(double value) const;
};

/// Returns every effect that `engine` models and that a diagnosis may add, given the setup's present values.
/// Left out are strengths that the setup has already, and effects that claim a part of the model that another
/// of the setup's effects has replaced. `only`: these alone (empty: all). `free`: knobs that are fitted
/// beside them; of these the one that an effect replaces a part of makes room for its levels.
std::vector<Candidate> candidates_for(const Setup& setup, const std::vector<std::string>& only,
                                      KnownEffects known, const Engine& engine,
                                      const std::vector<Knob>& free = {});

/// Tells whether ensembles try each value of its shapes, as candidates of their own.
bool has_shapes(const EffectRecord& record);

/// Returns the indices of the candidates, first what is most probable beforehand for what it costs, so that
/// where simulations run out as much as can be has been looked at.
std::vector<std::size_t> by_odds_for_cost(const std::vector<Candidate>& candidates);

/// Tells whether the engine models this effect at its defaults.
bool is_modelled(const Engine& engine, const EffectRecord& record);

/// Groups the indices of the candidates with knobs by the runs that they are scattered in: the cheap ones
/// together, then what makes runs slow or dear, each effect apart (gravity across bends what drag does).
struct ScatterGroups {
  std::vector<std::size_t> cheap;
  std::vector<std::vector<std::size_t>> slow, dear;
};
/// Returns the groups of these candidates.
ScatterGroups scatter_groups(const std::vector<Candidate>& candidates);

/// Returns the setup with what the presence of the candidate needs besides, and the candidate at no strength
/// (a length at its typical one).
Setup prepared(const Setup& setup, const Candidate& candidate, KnownEffects known);

}  // namespace shakedown
