// SPDX-License-Identifier: MIT
// Friction as a formula of the slip speed, written in the setup.
#include "contact_formula.hpp"

namespace shakedown::effect {

namespace {

constexpr ContactFormulaWords friction_words{
    "user_friction", "friction",     "mu", "the setup's coefficient of the contact",
    "slip speed",    {0.0, 0.2, 1.0}};

std::vector<ParameterProblem> check_friction(const EffectChoice& choice) {
  return problems_of_contact_formula(friction_words, choice);
}

void apply_user_friction(const EffectChoice& choice, int, Physics& physics) {
  physics.contact.friction_at = [formula = ContactFormula(friction_words, choice)](
                                    ContactClass kind, double slip, double setups) {
    constexpr double next_to_nothing = 1e-100;  // what divides by it must not overflow
    const double coefficient = formula(kind, slip, setups);
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
