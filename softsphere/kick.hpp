// SPDX-License-Identifier: MIT
// In a half kick velocities change by the forces at fixed positions, and every force's work is entered
// exactly.
#pragma once
#include <memory>
#include <vector>

#include "contact.hpp"

namespace shakedown {

/// Working space of half kicks, a row for each grain and the box.
struct KickSpace {
  Bodies::Rows velocity_before, spin_before, force, torque, drag;
  Bodies::Column wind;               ///< m/s, of each grain against the air
  std::vector<Bodies::Column> free;  ///< one column a free force
  std::vector<int> touched;          ///< bodies in contact
  std::unique_ptr<bool[]> listed;    ///< of each body, while they are listed
};

/// Everything that a half kick reads and changes.
struct KickedRun {
  const ContactModel& model;
  const GrainForces& grain_forces;
  Bodies& bodies;
  std::vector<Contact>& contacts;
  KickSpace& space;
  Accounts& accounts;
};

/// Executes one half kick at `time`, s, of `half_step` seconds.
///
/// v' = v + F half_step / m, the forces taken at the velocities of the pass before; one pass is explicit,
/// three passes solve the implicit equation to (beta step / 2)^3, 3e-7 at twenty steps per contact. Work of a
/// force F between i and j in a half kick: half_step F . [(v_i + v_i') / 2 - (v_j + v_j') / 2]. The kinetic
/// energy of i changes by F . (v_i + v_i') half_step / 2 exactly, and F is a sum over forces, so the works
/// close the ledger to rounding.
void half_kick(const KickedRun& run, double time, double half_step, int passes);

}  // namespace shakedown
