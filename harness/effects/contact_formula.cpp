// SPDX-License-Identifier: MIT
#include "contact_formula.hpp"

#include <cmath>

#include "formula_check.hpp"
#include "quantity.hpp"

namespace shakedown {

namespace {

Formula formula_of(const ContactFormulaWords& words, const EffectChoice& choice) {
  return {choice.text(words.coefficient), choice.constants("constants"), {"v", std::string(words.symbol)}};
}

std::string place_in(const ContactFormulaWords& words, double speed, double setups) {
  return "v = " + write_number(speed) + " m/s, " + std::string(words.symbol) + " = " + write_number(setups);
}

}  // namespace

ContactFormula::ContactFormula(const ContactFormulaWords& words, const EffectChoice& choice)
    : words_(&words), formula_(formula_of(words, choice)), on_(choice.text("on")) {}

double ContactFormula::operator()(ContactClass kind, double speed, double setups) const {
  const bool by_formula = on_ == "all" || (on_ == "grains") == (kind == ContactClass::grain_grain);
  if (!by_formula) return setups;
  const double value = formula_(speed, setups);
  if (!std::isfinite(value))
    throw PhysicsError(std::string(words_->effect) + ": the " + std::string(words_->coefficient) +
                       " is not a finite number at " + place_in(*words_, speed, setups));
  return value;
}

std::vector<ParameterProblem> problems_of_contact_formula(const ContactFormulaWords& words,
                                                          const EffectChoice& choice) {
  const std::string may_use =
                        "v (m/s), " + std::string(words.symbol) + " (" + std::string(words.meaning) + ")",
                    value_for = "every " + std::string(words.speed) + ", 0 included";
  // First touches without speed, and those beyond any damper.
  constexpr std::array speeds{0.0, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0};
  return problems_of_formula({words.coefficient, may_use, value_for}, choice,
                             [&](const EffectChoice& of) -> std::string {
                               const Formula formula = formula_of(words, of);
                               for (const double speed : speeds)
                                 for (const double setups : words.values)
                                   if (!std::isfinite(formula(speed, setups)))
                                     return place_in(words, speed, setups);
                               return {};
                             });
}

}  // namespace shakedown
