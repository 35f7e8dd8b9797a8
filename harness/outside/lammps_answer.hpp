// SPDX-License-Identifier: MIT
// Reads what LAMMPS has written as a trajectory.
#pragma once
#include "lammps_script.hpp"
#include "trajectory.hpp"
#include "work_folder.hpp"

namespace shakedown {

/// Returns the time of the last row written so far, s; 0 without one.
double lammps_time_so_far(const WorkFolder& folder, const LammpsSteps& steps);

/// Returns the trajectory of a run that has ended. Throws PhysicsError when rows are missing or hold numbers
/// that are not finite.
Trajectory lammps_answer(const WorkFolder& folder, const Setup& setup, const Physics& physics,
                         const State& initial, const LammpsScript& script);

}  // namespace shakedown
