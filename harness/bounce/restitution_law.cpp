// SPDX-License-Identifier: MIT
#include "restitution_law.hpp"

#include <algorithm>
#include <cmath>

#include "expect.hpp"
#include "viscoelastic_contact.hpp"

namespace shakedown {

namespace {
constexpr double most_of_a_power = 0.98;  // as in velocity_dependent_restitution
constexpr double plastic_exponent = 0.25;
}  // namespace

const std::vector<RestitutionLaw>& restitution_laws() {
  static const LawParameter at_reference{"restitution", 0, 0, 0, 1, 0.8};
  static const std::vector<RestitutionLaw> laws{
      {LawKind::constant, "constant", "e", "I. Newton, Principia (1687)", 0.23, {at_reference}},
      {LawKind::viscoelastic,
       "viscoelastic",
       "Hertz's force with a dashpot, e the value at v_ref; 1 - e ~ v^(1/5) for small losses",
       "N. V. Brilliantov et al., Phys. Rev. E 53, 5382 (1996); T. Schwager and T. Poeschel, Phys. Rev. E "
       "78, "
       "051304 (2008)",
       0.23,
       {at_reference}},
      {LawKind::power,
       "power",
       "e (v/v_ref)^-p, at most 0.98",
       "K. L. Johnson, Contact Mechanics (Cambridge, 1985)",
       0.23,
       {at_reference, {"exponent", 0, 0.2, 0, 1, 0.02}}},
      {LawKind::plastic,
       "plastic",
       "e (v/v_ref)^(-1/4), at most 0.98",
       "K. L. Johnson, Contact Mechanics (Cambridge, 1985), full plasticity",
       0.23,
       {at_reference}},
      {LawKind::curve,
       "none of these",
       "e + a L + b L^2, L = ln(v/v_ref)",
       "",
       0.08,
       {at_reference, {"slope", 0, 0.1, -2, 2, 0}, {"bend", 0, 0.05, -2, 2, 0}}}};
  return laws;
}

const RestitutionLaw& law_of(LawKind kind) {
  const auto& laws = restitution_laws();
  const auto found =
      std::find_if(laws.begin(), laws.end(), [&](const RestitutionLaw& law) { return law.kind == kind; });
  EXPECT(found != laws.end());
  return *found;
}

double restitution(LawKind kind, std::span<const double> parameters, double speed, double reference) {
  const double e = parameters[0], ratio = speed / reference;
  const auto power = [&](double exponent) {
    return std::min(e * std::pow(ratio, -exponent), std::max(most_of_a_power, e));
  };
  switch (kind) {
    case LawKind::constant: return e;
    case LawKind::power: return power(parameters[1]);
    case LawKind::plastic: return power(plastic_exponent);
    case LawKind::viscoelastic: {
      // Fits ask for the same value at the reference again and again.
      static thread_local double last = -1, damping = 0;
      if (e != last) damping = viscoelastic_damping(std::clamp(e, 1e-3, 1.0)), last = e;
      return viscoelastic_restitution(damping * std::pow(ratio, 0.2));
    }
    case LawKind::curve: {
      const double log = std::log(ratio);
      return e + parameters[1] * log + parameters[2] * log * log;
    }
  }
  return e;
}

}  // namespace shakedown
