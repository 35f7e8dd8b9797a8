// SPDX-License-Identifier: MIT
// Laws of restitution against the speed of impact, with formulas and parameters of the effects
// velocity_dependent_restitution and fluctuating_restitution, so that what is found goes into a setup.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shakedown {

enum class LawKind { constant, viscoelastic, power, plastic, curve };

/// A number of a law and what is believed of it before the data: normal about `mean`, cut off at the bounds.
struct LawParameter {
  std::string_view name;
  double mean = 0, deviation = 0;  ///< of the prior; deviation 0: uniform between the bounds
  double low = 0, high = 1;
  double start = 0;
};

struct RestitutionLaw {
  LawKind kind;
  std::string_view name, formula, source;
  double prior;  ///< probability before the data
  std::vector<LawParameter> parameters;
};

/// Returns constant, viscoelastic, power, plastic, and "none of these": a curve e + a L + b L^2, L =
/// ln(v/v_ref).
const std::vector<RestitutionLaw>& restitution_laws();
/// Returns the law of this kind.
const RestitutionLaw& law_of(LawKind kind);

/// Returns the restitution at a speed of impact > 0, m/s; `reference` is the speed, m/s, at which
/// parameters[0] holds.
double restitution(LawKind kind, std::span<const double> parameters, double speed, double reference);

}  // namespace shakedown
