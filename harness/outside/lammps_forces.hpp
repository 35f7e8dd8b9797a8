// SPDX-License-Identifier: MIT
// Writes what acts on box and grains besides spring and contacts as variables and fixes of LAMMPS.
#pragma once
#include <string>
#include <vector>

#include "physics.hpp"

namespace shakedown {

struct LammpsForces {
  struct OnBox {
    std::string name, formula;  ///< of an equal-style variable, N, in v_box_x and v_box_v
    int effect = -1;            ///< line in Setup::effects
  };
  struct Power {
    std::string formula;  ///< of an equal-style variable, W: what the effect does to grains and box
    int effect = -1;
  };
  std::vector<OnBox> on_box;
  std::vector<std::string> on_grains;                ///< lines of the script
  std::vector<std::string> on_grains_with_reaction;  ///< the same, of forces that the box feels the other way
  std::vector<Power> powers;                         ///< one for each line of Setup::effects that does work
};

/// Returns the forces of a setup. `step`: s, of the integrator; `grain_mass`: kg, 0 without grains; `held`:
/// the box does not move.
LammpsForces lammps_forces(const Setup& setup, const Physics& physics, double step, double grain_mass,
                           bool held);

}  // namespace shakedown
