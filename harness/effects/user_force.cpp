// SPDX-License-Identifier: MIT
// A force that nobody listed, written in the setup: the effect that needs no compiler.
#include <array>
#include <cmath>

#include "formula.hpp"
#include "formula_check.hpp"
#include "physics.hpp"
#include "quantity.hpp"

namespace shakedown::effect {

namespace {

Formula force_formula_of(const EffectChoice& choice) {
  return {choice.text("force"), choice.constants("constants")};
}

std::string place_of(double x, double v, double t) {
  return "x = " + write_number(x) + " m, v = " + write_number(v) + " m/s, t = " + write_number(t) + " s";
}

/// Returns a place where the formula has no finite value, in words, or nothing. Tries places at which
/// formulas break: zero, tiny, and the extremes of the paper's damper.
std::string where_no_force(const EffectChoice& choice) {
  constexpr std::array positions{0.0, 1e-6, -1e-6, 1e-3, -1e-3, 0.03, -0.03, 0.1075, -0.1075, 0.2, -0.2};
  constexpr std::array velocities{0.0, 1e-6, -1e-6, 1e-3, -1e-3, 0.1, -0.1, 0.8, -0.8, 2.0, -2.0};
  constexpr std::array times{0.0, 1e-3, 0.1, 1.0, 10.0, 30.0};
  const Formula formula = force_formula_of(choice);
  for (const double t : times)
    for (const double x : positions)
      for (const double v : velocities)
        if (!std::isfinite(formula(x, v, t))) return place_of(x, v, t);
  return {};
}

std::vector<ParameterProblem> check_force(const EffectChoice& choice) {
  return problems_of_formula({"force", "x (m), v (m/s), t (s)", "every x, v and t"}, choice, &where_no_force);
}

void apply_user_force(const EffectChoice& choice, int index, Physics& physics) {
  const Formula formula = force_formula_of(choice);
  const auto newton = [formula](double x, double v, double t) {
    const double force = formula(x, v, t);
    if (!std::isfinite(force))
      throw PhysicsError("user_force: the force is not a finite number at " + place_of(x, v, t));
    return force;
  };
  (choice.text("on") == "box" ? physics.box.free : physics.grains.free).push_back({newton, index});
}

/// Returns what an engine makes of this formula: between impacts the hard engine knows the grains' motion in
/// closed form, which a force that follows a grain would bend.
Capability capability_of_formula(const EffectChoice& choice, std::string_view engine, Capability general) {
  if (engine != "hard" || choice.text("on") != "grains") return general;
  const Formula formula = force_formula_of(choice);
  if (!formula.uses("x") && !formula.uses("v")) return general;
  return {Fidelity::not_modelled, "on grains the hard engine takes formulas of t alone; use --engine soft"};
}

}  // namespace

extern const EffectRecord user_force{
    .name = "user_force",
    .label = "force given as a formula",
    .acts_on = ActsOn::all,
    .sentence = "A force along the axis on the box or on every grain, given as a formula.",
    .formula =
        "force(x, v, t) in N with named constants; x and v of the box in the lab (x = 0 where the spring is "
        "relaxed), or of the grain itself",
    .source = "The setup; formulas are read by muParser (https://beltoforion.de/en/muparser)",
    .limits =
        "No memory, no dependence on other bodies. Steps in the formula are followed, not located: the "
        "stated error holds where it is smooth.",
    .parameters = {{.name = "on",
                    .kind = ParameterKind::choice,
                    .default_value = std::string("box"),
                    .sentence = "What it acts on.",
                    .choices = {"box", "grains"}},
                   {.name = "force",
                    .kind = ParameterKind::text,
                    .default_value = std::string("0"),
                    .required = true,
                    .sentence = "The formula, e.g. \"-c*v*exp(-((x-x0)/w)^2)\".",
                    .example = "\"-c*v*abs(v)\""},
                   {.name = "table",
                    .kind = ParameterKind::text,
                    .default_value = std::string(),
                    .sentence =
                        "Path of a CSV table of points instead of the formula, SI: header x,force "
                        "(or v,force, t,force; x,damping of -v c(x), x,friction of -tanh(v/1 mm/s) f(x), "
                        "t,stiffness of -x k(t) ...); a "
                        "curve goes through them, level beyond.",
                    .example = "\"force.csv\"",
                    .becomes = "force"},
                   {.name = "constants",
                    .kind = ParameterKind::constants,
                    .default_value = std::map<std::string, double>{},
                    .sentence = "Named quantities with units, e.g. {c = \"0.4 N s/m\", x0 = \"45 mm\", w = "
                                "\"12 mm\"}; the formula sees them in SI.",
                    .example = "{c = \"0.1 N s^2/m^2\"}"}},
    .engines =
        {{"hard",
          {Fidelity::to_stated_error,
           "on the box: motion dense to 1e-13 of the release displacement; on grains: formulas of t alone, "
           "else --engine soft"}},
         {"soft", {Fidelity::to_stated_error, "second order in the time step; the ledger closes to 1e-9"}},
         {"lammps",
          {Fidelity::to_stated_error,
           "a variable: second order in the step in x and t, first in v; no ! and no rarer functions, and "
           "both branches of a condition must have a value"}}},
    .search = {.not_searched = "A formula has no strength of its own; where no effect of the list fits, a "
                               "diagnosis offers formulas."},
    .apply = &apply_user_force,
    .check = &check_force,
    .capability_of = &capability_of_formula};

}  // namespace shakedown::effect
