// SPDX-License-Identifier: MIT
// Writes trajectories that other programs open, from a collision log.
#pragma once
#include <filesystem>
#include <string_view>

#include "frames.hpp"

namespace shakedown {

enum class ExportFormat { xyz, lammps, vtp, npy, csv };
constexpr std::array<std::string_view, 5> export_format_names{"xyz", "lammps", "vtp", "npy", "csv"};

/// Returns the format of this name. Throws InputError for a name that is none.
ExportFormat export_format_named(std::string_view name);

struct Exported {
  std::filesystem::path open;  ///< what to open
  std::int64_t frames = 0;
};

/// Writes the frames into `folder`: motion.xyz, motion.lammpstrj, motion.csv, motion.pvd with its VTP files,
/// or arrays (time, position, velocity, spin, radius, mass, box) as .npy. Throws InputError for times outside
/// the run, FileError.
Exported export_run(const StoredRun& run, const FrameTimes& times, ExportFormat format,
                    const std::filesystem::path& folder);

}  // namespace shakedown
