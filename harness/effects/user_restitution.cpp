// SPDX-License-Identifier: MIT
// Restitution as a formula of the closing speed, written in the setup.
#include <algorithm>

#include "contact_formula.hpp"

namespace shakedown::effect {

namespace {

constexpr ContactFormulaWords restitution_words{
    "user_restitution", "restitution",   "e", "the setup's restitution of the contact",
    "closing speed",    {0.3, 0.75, 1.0}};

std::vector<ParameterProblem> check_restitution(const EffectChoice& choice) {
  return problems_of_contact_formula(restitution_words, choice);
}

void apply_user_restitution(const EffectChoice& choice, int, Physics& physics) {
  physics.contact.restitution_at = [formula = ContactFormula(restitution_words, choice),
                                    constant = physics.contact.restitution](ContactClass kind, double speed) {
    return std::clamp(formula(kind, speed, constant[static_cast<std::size_t>(kind)]), 0.0, 1.0);
  };
}

}  // namespace

extern const EffectRecord user_restitution{
    .name = "user_restitution",
    .label = "restitution given as a formula",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence = "Normal restitution as a formula of the closing speed at first touch.",
    .formula =
        "restitution(v, e) with named constants; v in m/s, e the setup's restitution of the contact (grains "
        "or "
        "walls); curve(ln(v), ln(v1), y1, ln(v2), y2, ...) goes through points without turning between them",
    .source = "The setup; formulas are read by muParser (https://beltoforion.de/en/muparser)",
    .limits =
        "Depends on the impact alone, not on what happened before. What the formula gives is kept between 0 "
        "and 1.",
    .parameters = {{.name = "on",
                    .kind = ParameterKind::choice,
                    .default_value = std::string("all"),
                    .sentence = "Which contacts have it; the others keep the setup's restitution.",
                    .choices = {"all", "grains", "walls"}},
                   {.name = "restitution",
                    .kind = ParameterKind::text,
                    .default_value = std::string("e"),
                    .required = true,
                    .sentence = "The formula, e.g. \"e*curve(ln(v/0.3), -4, a, 0, 1)\".",
                    .example = "\"1-(1-e)*(v/a)^0.2\""},
                   {.name = "table",
                    .kind = ParameterKind::text,
                    .default_value = std::string(),
                    .sentence = "Path of a CSV table of points instead of the formula: header v,restitution, "
                                "SI; the restitution is a curve through them, level beyond.",
                    .example = "\"restitution.csv\"",
                    .becomes = "restitution"},
                   {.name = "constants",
                    .kind = ParameterKind::constants,
                    .default_value = std::map<std::string, double>{},
                    .sentence =
                        "Named quantities, e.g. {a = 1.2, v0 = \"30 mm/s\"}; the formula sees them in "
                        "SI.",
                    .example = "{a = \"0.3 m/s\"}"}},
    .claims = "normal restitution",
    .engines = {{"hard", {Fidelity::exact}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "linear spring-dashpot of the restitution at the closing speed at first touch"}}},
    .search = {.not_searched = "A formula has no strength of its own; where no effect of the list fits, a "
                               "diagnosis offers a curve (fit --restitution-curve)."},
    .apply = &apply_user_restitution,
    .applied_last = true,
    .check = &check_restitution};

}  // namespace shakedown::effect
