// SPDX-License-Identifier: MIT
// Lists what may be missing in the momentum balance, each a strength of an effect of the library. The column
// of a strength is derived: the balance of the setup less that of the setup with the effect, by its strength.
// An effect whose column is nothing (all that happens between grains) is not seen here.
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "known_effects.hpp"
#include "measurement.hpp"
#include "weak_form.hpp"

namespace shakedown {

/// Says what a strength that is found means.
enum class TermKind {
  refit,    ///< the spring's own frequency: the user's parameter, always free
  physics,  ///< a force that the setup lacks
  camera,   ///< what the camera does to the positions
};

/// Describes one strength, counted from what the setup has of it. A length that goes to infinity when the
/// effect is absent counts as 1/length^2.
struct MomentumTerm {
  std::string effect;     ///< id of the effect; "spring.frequency" for the refit
  std::string parameter;  ///< "damping", "acceleration.x"
  std::string unit;       ///< SI unit of the parameter
  TermKind kind = TermKind::physics;
  bool never_negative = false;  ///< a drag cannot push
  bool inverse = false;         ///< the strength is 1/parameter^2
  bool dry = false;            ///< a friction that turns with the motion: a set of terms has one at most, and
                               ///< a box at rest does not feel it as the column says
  double present = 0;          ///< of the setup, as a strength
  double typical = 0;          ///< scale of the prior, as a strength
  double least = 0, most = 0;  ///< of the parameter
  double odds = 1;             ///< how likely beside a usual effect
  std::vector<std::pair<std::string, double>> besides{};  ///< keys that its presence needs besides, SI
  std::string shape{};  ///< key among them that the balance finds too; empty: none

  std::string key() const { return effect + "." + parameter; }  ///< "effect.parameter"
  /// Returns the parameter at this strength beyond the setup's, within its bounds.
  double parameter_at(double strength) const;
  /// Tells whether the parameter at this strength beyond the setup's lies within its bounds; a length may be
  /// as long as it likes.
  bool possible(double strength) const;
};

/// Returns the setup with the term's strength beyond its own.
Setup with_strength(Setup setup, const MomentumTerm& term, double strength, KnownEffects known);

/// Returns the spring's frequency first, then every strength of `known` that a diagnosis may look for; with
/// `of_waveform` those too that the waveform of an empty box alone tells.
std::vector<MomentumTerm> momentum_terms(const Setup& setup, KnownEffects known, bool of_waveform = false);

/// Returns the column of a change of the setup: (as it is - changed) / by, for one run.
ForceSamples samples_of_change(const MomentumRun& as_it_is, const MomentumRun& changed, double by);

/// Returns the column of the relative change of the spring's stiffness.
ForceSamples spring_samples(const MomentumRun& run);

}  // namespace shakedown
