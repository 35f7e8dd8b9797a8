// SPDX-License-Identifier: MIT
// Writes a user's formula in the words of LAMMPS's variables. LAMMPS reads -x^2 as (-x)^2 and knows neither
// tanh nor min: so the formula is read by the rules of muParser and written with brackets around everything.
#pragma once
#include <map>
#include <string>

namespace shakedown {

/// What x (m), v (m/s) and t (s) are called there.
struct LammpsNames {
  std::string x, v, t;
};

/// Why LAMMPS cannot be given a formula.
struct LammpsFormulaProblem {
  std::string text;
};

/// Returns the formula, which muParser must take, as LAMMPS has it; `constants`: SI. Throws
/// LammpsFormulaProblem for functions and operators that LAMMPS has no words for. Both branches of a
/// condition are evaluated there.
std::string lammps_formula(const std::string& formula, const std::map<std::string, double>& constants,
                           const LammpsNames& names);

}  // namespace shakedown
