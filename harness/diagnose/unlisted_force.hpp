// SPDX-License-Identifier: MIT
// Writes a force that no effect of the library describes as the effect user_force, ready to add.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "force_formula.hpp"
#include "known_effects.hpp"
#include "momentum.hpp"
#include "setup.hpp"

namespace shakedown {

/// The effect whose law is a formula in the setup.
inline constexpr const char* formula_effect_name = "user_force";

/// Holds such a force.
struct UnlistedForce {
  std::string formula;                                         ///< of x, v and t; empty: none
  std::vector<std::pair<std::string, std::string>> constants;  ///< name and quantity
  std::string on = "box";                                      ///< or "grains": on each of them
};

/// Returns the sum of all formulas; constants of the second and later ones are numbered (c, c2).
UnlistedForce sum_of(const std::vector<ForceFormula>& formulas);

/// Returns the same force in sum, each of so many grains having its share; nothing where it depends on x or
/// v, which are the box's. The momentum balance does not tell the two apart.
std::optional<UnlistedForce> shared_by_grains(const UnlistedForce& force, int grains);

/// Tells whether the setup's user_force acts on the grains.
bool has_force_on_grains(const Setup& setup);

/// Returns "x", "v" or "t": what such a force depends on.
std::string_view variable_of(ShapeOf shape);
/// Returns "force"; "damping" of a force -v c, "stiffness" of one -x k, "friction" of one -sign(v) f.
std::string_view quantity_of(ShapeOf shape);

/// Returns the points of the curve that explains most, as a CSV table that user_force takes: header
/// x,force,error (or x,damping of a force -v c(x), t,stiffness of -x k(t) and so on), SI, error the standard
/// error. Empty without curves.
std::string points_of_force(const std::vector<ForceCurve>& curves);

/// Returns the force as a table of a setup file; empty without a formula.
std::string as_table(const UnlistedForce& force);

/// Returns the setup with this force in place of a user_force that it may have.
Setup with_force(const Setup& setup, const UnlistedForce& force, KnownEffects known);

}  // namespace shakedown
