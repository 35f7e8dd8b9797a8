// SPDX-License-Identifier: MIT
// Restitution as a formula of the closing speed, written in the setup.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "formula.hpp"
#include "formula_check.hpp"
#include "physics.hpp"
#include "quantity.hpp"

namespace shakedown::effect {

namespace {

Formula restitution_formula_of(const EffectChoice& choice) {
  return {choice.text("restitution"), choice.constants("constants"), {"v", "e"}};
}

std::string impact_of(double speed, double restitution) {
  return "v = " + write_number(speed) + " m/s, e = " + write_number(restitution);
}

/// Impacts at which formulas break: first touches without speed, and those beyond any damper.
std::string where_no_restitution(const EffectChoice& choice) {
  constexpr std::array speeds{0.0, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0};
  constexpr std::array restitutions{0.3, 0.75, 1.0};
  const Formula formula = restitution_formula_of(choice);
  for (const double speed : speeds)
    for (const double restitution : restitutions)
      if (!std::isfinite(formula(speed, restitution))) return impact_of(speed, restitution);
  return {};
}

std::vector<ParameterProblem> check_restitution(const EffectChoice& choice) {
  return problems_of_formula({"restitution", "v (m/s), e (the setup's restitution of the contact)",
                              "every closing speed, 0 included"},
                             choice, &where_no_restitution);
}

void apply_user_restitution(const EffectChoice& choice, int, Physics& physics) {
  const std::string on = choice.text("on");
  physics.contact.restitution_at = [formula = restitution_formula_of(choice),
                                    constant = physics.contact.restitution,
                                    on](ContactClass kind, double speed) {
    const double setups = constant[static_cast<std::size_t>(kind)];
    const bool by_formula = on == "all" || (on == "grains") == (kind == ContactClass::grain_grain);
    if (!by_formula) return setups;
    const double restitution = formula(speed, setups);
    if (!std::isfinite(restitution))
      throw PhysicsError("user_restitution: the restitution is not a finite number at " +
                         impact_of(speed, setups));
    return std::clamp(restitution, 0.0, 1.0);
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
