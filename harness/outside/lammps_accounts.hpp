// SPDX-License-Identifier: MIT
// Where the energy goes, added up by LAMMPS itself. Velocity Verlet with the force F of a step changes the
// kinetic energy of the half steps around it by exactly F v dt, v the velocity at the step. So the sum of F v
// over the steps is the work of each kind of contact without an error of its own.
#pragma once
#include <string>
#include <vector>

#include "lammps_forces.hpp"
#include "lammps_script.hpp"

namespace shakedown {

struct LammpsGrains {
  bool friction = false, any = true;
  double radius = 0;  ///< m
};

/// Adds the variables, computes and the averaging fix to the script's text.
std::vector<LammpsAccount> lammps_accounts(const LammpsGrains& grains, const LammpsForces& forces,
                                           std::string& text);

}  // namespace shakedown
