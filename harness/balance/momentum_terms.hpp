// SPDX-License-Identifier: MIT
// The forces and camera errors of the effects library that the momentum balance can see, each linear in its
// strength.
#pragma once
#include <string>
#include <vector>

#include "weak_form.hpp"

namespace shakedown {

/// What a strength that is found means.
enum class TermKind {
  refit,    ///< the spring's own frequency: the user's parameter, always free
  physics,  ///< a force that the setup lacks
  camera,   ///< what the camera does to the positions
};

/// One term of the balance. Strength times samples is the force.
struct MomentumTerm {
  std::string effect;     ///< id of the effect; "spring.frequency" for the refit
  std::string parameter;  ///< its parameter, as in the setup
  std::string unit;       ///< SI unit of the strength
  TermKind kind = TermKind::physics;
  bool never_negative = false;  ///< a drag cannot push
  /// Force of unit strength; of terms that are not quite linear, the force of `strength` divided by it.
  ForceSamples (*samples)(const MomentumRun& run, double strength) = nullptr;
  bool linear = true;
  /// The effect's parameter from the fitted strength; nullptr: the strength itself.
  double (*parameter_of)(double strength) = nullptr;
};

/// Spring frequency first. Effects that balance themselves (friction between grains, drag on the grains,
/// restitution, a scale or time offset of the camera, a velocity at release) leave no trace here and are not
/// in the list.
const std::vector<MomentumTerm>& momentum_terms();

}  // namespace shakedown
