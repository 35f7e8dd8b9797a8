// SPDX-License-Identifier: MIT
// Writes a moment of a run as text that other programs read. SI; shortest digits that read back to the same
// number.
#pragma once
#include <string>

#include "frames.hpp"

namespace shakedown {

/// Returns extended XYZ: id, positions, velocities, radii, masses and spins, by the names of OVITO (velo,
/// mass) and again by those of ASE (momenta, masses); the cell is the box, its origin moves.
std::string extended_xyz(const Frame& frame);

/// Returns a LAMMPS dump, units si (OVITO, VMD, pandas).
std::string lammps_dump(const Frame& frame);

/// Returns the first line of a table of frames, with or without columns of spins.
std::string csv_header(bool spins);
/// Returns a line a grain: t_s,grain,x_m,y_m,z_m,vx_m_per_s,...,radius_m,mass_kg,x_box_m,v_box_m_per_s.
std::string csv_lines(const Frame& frame);

}  // namespace shakedown
