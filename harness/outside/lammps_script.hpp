// SPDX-License-Identifier: MIT
// A setup in the words of LAMMPS (stable version of 29 September 2021, package GRANULAR).
//
// The box is an atom of its own type, which no grain touches: it has the box's mass and place along x, and
// the walls, fix wall/gran/region, are moved to where it is at every step. A variable gives it the spring's
// force less the sum of all forces that contacts have put on the grains so far (the forces of pairs cancel
// in that sum), so that walls push grains and box alike, to rounding, and the integrator is one for both.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "damper_state.hpp"
#include "lammps_accounts.hpp"

namespace shakedown {

/// Time steps: all equal, a whole number of them in a sample.
struct LammpsSteps {
  double step = 0;               ///< s
  std::int64_t in_a_sample = 0;  ///< steps
  std::int64_t samples = 0;      ///< after the one at release
};

/// Returns the time step and how often it is written, so that frames fall where the setup has them.
LammpsSteps lammps_steps(const Setup& setup);

struct LammpsScript {
  std::string text;    ///< in.lammps
  std::string bodies;  ///< bodies.data
  std::string table;   ///< attraction.table; empty: there is none
  /// Columns of motion.csv after step, x_box (m), v_box (m/s), centre of the grains (m), their kinetic energy
  /// with spin (J): of each account the mean over the steps of the sample and the value at the last one, W.
  std::vector<LammpsAccount> accounts;
};

/// The names of the files in the folder of a run.
constexpr const char *lammps_script_file = "in.lammps", *lammps_bodies_file = "bodies.data",
                     *lammps_motion_file = "motion.csv", *lammps_end_file = "end.csv";

/// Returns the files of a run. Throws InputError for what the words of LAMMPS cannot say.
LammpsScript lammps_script(const Setup& setup, const Physics& physics, const State& initial);

}  // namespace shakedown
