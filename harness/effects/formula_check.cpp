// SPDX-License-Identifier: MIT
#include "formula_check.hpp"

#include <string>

namespace shakedown {

std::vector<ParameterProblem> problems_of_formula(
    const FormulaParameter& parameter, const EffectChoice& choice,
    const std::function<std::string(const EffectChoice& choice)>& unsound) {
  const std::string remedy = "write it so that it has a value for " + std::string(parameter.value_for);
  try {
    const std::string place = unsound(choice);
    if (place.empty()) return {};
    return {{parameter.name, "is not a finite number at " + place, remedy}};
  } catch (const FormulaProblem& wrong) {
    const std::string at =
        wrong.position > 0 ? " at character " + std::to_string(wrong.position) + " of the formula" : "";
    return {{parameter.name,
             "\"" + choice.text(parameter.name) + "\" cannot be read" + at + " (" + wrong.problem + ")",
             "use " + std::string(parameter.may_use) +
                 ", the names in constants, + - * / ^, and functions such as abs, sin, exp, sqrt, min, max, "
                 "curve"}};
  } catch (const PhysicsError& wrong) {  // of a function that the program lends, or of a curve
    return {{parameter.name, wrong.what(), remedy}};
  }
}

}  // namespace shakedown
