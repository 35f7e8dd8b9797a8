// SPDX-License-Identifier: MIT
// Effects that may be missing, each with the knobs that say how strong it is.
#pragma once
#include <string>
#include <vector>

#include "emulator.hpp"
#include "evidence.hpp"

namespace shakedown {

struct Candidate {
  std::string effect;
  std::vector<Knob> knobs;  ///< one typical strength wide, about the effect's absence where when_absent() is
                            ///< the centre; empty: on or off
  std::vector<std::pair<std::string, double>>
      fixed;  ///< setup paths and values (SI) that its presence needs besides, e.g. the length of the blade
  StrengthSeen prior{};  ///< what is typical of its strength; gain, value and error are not set
  bool dear = false;     ///< a run costs some ten times a plain one: screened by itself, with few runs
  /// Tried whatever the linear estimate says: inside the contacts a refit hides most of what is linear, and
  /// at full strength it is not.
  bool always = false;
  double towards = 1;  ///< -1: what the effect does lowers its parameter
  bool slow = false;   ///< a run costs three to five times a plain one: screened by itself, with fewer runs
  std::vector<Knob> when_tried{};  ///< of one screened as on or off: what its fit may vary

  const std::vector<Knob>& fitted_knobs() const { return knobs.empty() ? when_tried : knobs; }
};

/// The knob's value at which the effect is absent: zero for strengths, the centre for what replaces a
/// parameter.
inline double when_absent(const Knob& knob) { return knob.low <= 0 ? 0 : knob.centre; }

/// Every effect that the hard engine models and that a diagnosis may add, given the setup's present values;
/// effects that the setup has already, and those that replace the same part of the model, are left out.
/// `only`: these alone (empty: all).
std::vector<Candidate> candidates_for(const Setup& setup, const std::vector<std::string>& only,
                                      std::span<const EffectRecord* const> known);

/// Indices of the candidates with knobs, by which runs they are scattered in: the cheap ones together, then
/// what makes runs slow or dear, each effect apart (gravity across bends what drag does).
struct ScatterGroups {
  std::vector<std::size_t> cheap;
  std::vector<std::vector<std::size_t>> slow, dear;
};
ScatterGroups scatter_groups(const std::vector<Candidate>& candidates);

/// The setup with the candidate at no strength.
Setup prepared(const Setup& setup, const Candidate& candidate, std::span<const EffectRecord* const> known);

}  // namespace shakedown
