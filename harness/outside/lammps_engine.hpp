// SPDX-License-Identifier: MIT
#pragma once
#include <memory>

#include "engine.hpp"

namespace shakedown {

/// Engine "lammps": the program LAMMPS (https://www.lammps.org) with its package GRANULAR, run beside ours;
/// the environment variable SHAKEDOWN_LAMMPS names it where it is not `lmp` on the PATH. Contacts are the
/// soft engine's springs and dashpots, coded by other people: same constants, same time step, but a Verlet
/// scheme of first order at touch and separation. Domains: damper and closed. A run that is
/// stopped keeps nothing; the files of others stay where keep_outside_files says. Collisions, which it does
/// not tell, are -1.
std::unique_ptr<Engine> make_lammps_engine();

/// Tells whether there is a program to run.
bool has_lammps();

}  // namespace shakedown
