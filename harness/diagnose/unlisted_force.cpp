// SPDX-License-Identifier: MIT
#include "unlisted_force.hpp"

#include <algorithm>
#include <cctype>

#include "quantity.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

/// Calls use(piece, is_name) for the words of a formula and for what lies between them, in order.
template <class Use>
void each_piece(const std::string& formula, const Use& use) {
  const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t i = 0; i < formula.size();) {
    std::size_t end = i;
    while (end < formula.size() && in_word(formula[end])) ++end;
    const bool is_name = end > i;
    if (!is_name) ++end;
    use(formula.substr(i, end - i), is_name);
    i = end;
  }
}

/// Returns the formula with this name, where it stands as a whole word, replaced.
std::string renamed(const std::string& formula, const std::string& name, const std::string& to) {
  std::string out;
  each_piece(formula,
             [&](const std::string& piece, bool is_name) { out += is_name && piece == name ? to : piece; });
  return out;
}

bool mentions(const std::string& formula, std::string_view name) {
  bool found = false;
  each_piece(formula, [&](const std::string& piece, bool) { found = found || piece == name; });
  return found;
}

}  // namespace

UnlistedForce sum_of(const std::vector<ForceFormula>& formulas) {
  UnlistedForce sum;
  for (std::size_t i = 0; i < formulas.size(); ++i) {
    std::string formula = formulas[i].formula;
    for (const FormulaConstant& constant : formulas[i].constants) {
      const std::string name = constant.name + (i > 0 ? std::to_string(i + 1) : "");
      if (i > 0) formula = renamed(formula, constant.name, name);
      sum.constants.emplace_back(name, write_quantity(constant.value, constant.unit));
    }
    sum.formula += (i > 0 && !formula.starts_with('-') ? "+" : "") + formula;
  }
  return sum;
}

std::optional<UnlistedForce> shared_by_grains(const UnlistedForce& force, int grains) {
  if (mentions(force.formula, "x") || mentions(force.formula, "v")) return {};
  return UnlistedForce{"(" + force.formula + ")/" + std::to_string(grains), force.constants, "grains"};
}

bool has_force_on_grains(const Setup& setup) {
  const EffectChoice* choice = find_choice(setup, formula_effect_name);
  return choice != nullptr && choice->text("on") == "grains";
}

std::string_view variable_of(ShapeOf shape) {
  switch (shape) {
    case ShapeOf::position:
    case ShapeOf::damping_at_x:
    case ShapeOf::friction_at_x: return "x";
    case ShapeOf::velocity: return "v";
    case ShapeOf::damping_at_t:
    case ShapeOf::stiffness_at_t:
    case ShapeOf::time: break;
  }
  return "t";
}

std::string_view quantity_of(ShapeOf shape) {
  switch (shape) {
    case ShapeOf::damping_at_x:
    case ShapeOf::damping_at_t: return "damping";
    case ShapeOf::stiffness_at_t: return "stiffness";
    case ShapeOf::friction_at_x: return "friction";
    case ShapeOf::position:
    case ShapeOf::velocity:
    case ShapeOf::time: break;
  }
  return "force";
}

std::string points_of_force(const std::vector<ForceCurve>& curves) {
  if (curves.empty()) return "";
  const ForceCurve& most = *std::max_element(
      curves.begin(), curves.end(), [](const ForceCurve& a, const ForceCurve& b) { return a.gain < b.gain; });
  std::string table =
      std::string(variable_of(most.of)) + "," + std::string(quantity_of(most.of)) + ",error\n";
  for (std::size_t i = 0; i < most.argument.size(); ++i)
    table += write_number(most.argument[i]) + "," + write_number(most.value[i]) + "," +
             write_number(most.error[i]) + "\n";
  return table;
}

std::string as_table(const UnlistedForce& force) {
  if (force.formula.empty()) return "";
  std::string constants;
  for (const auto& [name, value] : force.constants)
    constants += (constants.empty() ? "" : ", ") + name + " = \"" + value + "\"";
  return "[[effect]]\nname = \"" + std::string(formula_effect_name) + "\"\non = \"" + force.on +
         "\"\nforce = \"" + force.formula + "\"\nconstants = {" + constants + "}\n";
}

Setup with_force(const Setup& setup, const UnlistedForce& force, KnownEffects known) {
  const std::string origin = "force found by the momentum balance";
  const std::string effect(formula_effect_name);
  std::vector<Override> overrides{{effect + ".on", force.on, origin},
                                  {effect + ".force", "\"" + force.formula + "\"", origin}};
  for (const auto& [name, value] : force.constants)
    overrides.push_back({effect + ".constants." + name, value, origin});
  return with_overrides(setup, overrides, known);
}

}  // namespace shakedown
