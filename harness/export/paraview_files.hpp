// SPDX-License-Identifier: MIT
// Writes what ParaView opens: a VTP file a moment for the grains (points with radius, mass, velocity, spin:
// show them with the Point Gaussian representation or a sphere glyph scaled by radius), one for the box, and
// a PVD file that puts them in order of time.
#pragma once
#include <string>
#include <vector>

#include "frames.hpp"

namespace shakedown {

/// Return grains and box of one frame as VTK XML files of polygonal data, SI.
std::string grains_vtp(const Frame& frame);
std::string box_vtp(const Frame& frame);

struct PvdEntry {
  double time;  ///< s
  int part;
  std::string file;
};
/// Returns the PVD file with these files.
std::string pvd(const std::vector<PvdEntry>& entries);

}  // namespace shakedown
