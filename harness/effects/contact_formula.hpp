// SPDX-License-Identifier: MIT
// Reads a coefficient of the contacts as a formula of a speed at first touch and of the setup's own value of
// it, for effects with the parameters `on` (all, grains, walls), `constants`, and the formula itself.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "effect.hpp"
#include "formula.hpp"
#include "physics.hpp"

namespace shakedown {

struct ContactFormulaWords {
  std::string_view effect;       ///< "user_restitution"
  std::string_view coefficient;  ///< "restitution": the name of the formula's parameter
  std::string_view symbol;       ///< of the setup's value in the formula
  std::string_view meaning;      ///< "the setup's restitution of the contact"
  std::string_view speed;        ///< "closing speed", in the formula v, m/s
  std::array<double, 3> values;  ///< of the setup's coefficient, at which a formula is tried
};

class ContactFormula {
 public:
  /// The words must outlive it. Throws FormulaProblem.
  ContactFormula(const ContactFormulaWords& words, const EffectChoice& choice);

  /// Returns the coefficient at this speed (m/s), or `setups`, the setup's own, for a contact that has no
  /// formula. Throws PhysicsError where the formula gives no finite number.
  double operator()(ContactClass kind, double speed, double setups) const;

 private:
  const ContactFormulaWords* words_;
  Formula formula_;
  std::string on_;
};

/// Returns what is wrong with the formula: unreadable, or without a finite value at some speed from none to
/// ten metres a second, beyond any damper. For EffectRecord::check.
std::vector<ParameterProblem> problems_of_contact_formula(const ContactFormulaWords& words,
                                                          const EffectChoice& choice);

}  // namespace shakedown
