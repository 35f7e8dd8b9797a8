// SPDX-License-Identifier: MIT
// Friction as a formula of the slip speed, written in the setup.
#include <array>
#include <cmath>
#include <string_view>

#include "formula.hpp"
#include "formula_check.hpp"
#include "physics.hpp"
#include "quantity.hpp"

namespace shakedown::effect {

namespace {

Formula friction_formula_of(const EffectChoice& choice) {
  return {choice.text("friction"), choice.constants("constants"), {"v", "mu"}};
}

std::string slip_of(double speed, double coefficient) {
  return "v = " + write_number(speed) + " m/s, mu = " + write_number(coefficient);
}

/// Slips at which formulas break: none, and those beyond any damper.
std::string where_no_friction(const EffectChoice& choice) {
  constexpr std::array speeds{0.0, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0};
  constexpr std::array coefficients{0.0, 0.2, 1.0};
  const Formula formula = friction_formula_of(choice);
  for (const double speed : speeds)
    for (const double coefficient : coefficients)
      if (!std::isfinite(formula(speed, coefficient))) return slip_of(speed, coefficient);
  return {};
}

std::vector<ParameterProblem> check_friction(const EffectChoice& choice) {
  return problems_of_formula(
      {"friction", "v (m/s), mu (the setup's coefficient of the contact)", "every slip speed, 0 included"},
      choice, &where_no_friction);
}

void apply_user_friction(const EffectChoice& choice, int, Physics& physics) {
  const std::string on = choice.text("on");
  physics.contact.friction_at = [formula = friction_formula_of(choice), on](ContactClass kind, double speed,
                                                                            double setups) {
    const bool by_formula = on == "all" || (on == "grains") == (kind == ContactClass::grain_grain);
    if (!by_formula) return setups;
    const double coefficient = formula(speed, setups);
    if (!std::isfinite(coefficient))
      throw PhysicsError("user_friction: the coefficient is not a finite number at " +
                         slip_of(speed, setups));
    constexpr double next_to_nothing = 1e-100;  // what divides by it must not overflow
    return coefficient > next_to_nothing ? coefficient : 0.0;
  };
}

}  // namespace

extern const EffectRecord user_friction{
    .name = "user_friction",
    .label = "friction given as a formula",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence = "Coefficient of friction as a formula of the slip speed at first touch.",
    .formula =
        "friction(v, mu) with named constants; v in m/s, the speed at which the touching points slip past "
        "each "
        "other at first touch, mu the setup's coefficient of the contact (0 without grain_friction); "
        "curve(ln(v), ln(v1), y1, ln(v2), y2, ...) goes through points without turning between them",
    .source = "The setup; formulas are read by muParser (https://beltoforion.de/en/muparser)",
    .limits =
        "One coefficient an impact: it does not follow the slip as that dies. What the formula gives is not "
        "less than 0. Tangential restitution and stiffness are those of grain_friction, or its defaults.",
    .parameters = {{.name = "on",
                    .kind = ParameterKind::choice,
                    .default_value = std::string("all"),
                    .sentence = "Which contacts have it; the others keep the setup's coefficient.",
                    .choices = {"all", "grains", "walls"}},
                   {.name = "friction",
                    .kind = ParameterKind::text,
                    .default_value = std::string("mu"),
                    .required = true,
                    .sentence = "The formula, e.g. \"a+b*exp(-v/v0)\".",
                    .example = "\"0.1+a*exp(-v/0.2)\""},
                   {.name = "table",
                    .kind = ParameterKind::text,
                    .default_value = std::string(),
                    .sentence = "Path of a CSV table of points instead of the formula: header v,friction, "
                                "SI; the coefficient is a curve through them, level beyond.",
                    .example = "\"friction.csv\"",
                    .becomes = "friction"},
                   {.name = "constants",
                    .kind = ParameterKind::constants,
                    .default_value = std::map<std::string, double>{},
                    .sentence =
                        "Named quantities, e.g. {a = 0.3, v0 = \"30 mm/s\"}; the formula sees them in "
                        "SI.",
                    .example = "{a = \"0.3\"}"}},
    .claims = "friction as a function of the slip",
    .dissipative = true,
    .engines = {{"hard", {Fidelity::exact}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "tangential spring as in grain_friction, which slides at the coefficient of the slip speed "
                  "at first touch times the normal spring's force"}}},
    .search = {.not_searched = "A formula has no strength of its own; whether measurements tell friction "
                               "against slip speed: fit --friction-curve."},
    .apply = &apply_user_friction,
    .check = &check_friction};

}  // namespace shakedown::effect
