// SPDX-License-Identifier: MIT
// LAMMPS itself adds up where the energy goes. Velocity Verlet with the force F of a step changes the kinetic
// energy of the half steps around it by exactly F v dt, v the velocity at the step. So the sum of F v over
// the steps is the work of each kind of contact without an error of its own.
#pragma once
#include <string>
#include <vector>

#include "lammps_forces.hpp"

namespace shakedown {

/// A power that LAMMPS adds up at every step, W: the columns "mean" and "now" of it in each row.
struct LammpsAccount {
  enum class Of { grain_grain, end_wall, side_wall, effect };
  Of of = Of::effect;
  int effect = -1;       ///< line in Setup::effects
  std::string variable;  ///< "v_name" or "c_name[1]"
};

/// What the accounts must know of the grains: whether contacts rub, so that torques work too; whether there
/// are any grains; and their radius, which all have.
struct LammpsGrains {
  bool friction = false, any = true;
  double radius = 0;  ///< m
};

/// Adds the variables and computes of the accounts to the script's text; returns the accounts in their order.
std::vector<LammpsAccount> lammps_accounts(const LammpsGrains& grains, const LammpsForces& forces,
                                           std::string& text);

}  // namespace shakedown
