// SPDX-License-Identifier: MIT
// A collision log as a file, from which a run can be replayed anywhere that the same program runs.
// Little-endian:
//   "shakedown collision log 2\n"
//   the program that wrote it, the setup (TOML): two texts, each its length (8 bytes) and its bytes
//   run, end time, entries, impacts: 8 bytes each
//   number of grains, 1 where they spin; x_box, v_box; of each grain position, velocity, spin (if any),
//   radius, mass: 8 bytes a number
//   number of digests and the digests; number of bytes of packed events and the events
//   (hardsphere/event_log.hpp)
//   FNV-1a of all that
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "collision_log.hpp"
#include "known_effects.hpp"
#include "setup.hpp"

namespace shakedown {

/// Name of the log in a folder of results.
constexpr const char* collision_log_name = "collisions.log";

struct StoredRun {
  std::string program;  ///< that wrote it
  Setup setup;          ///< as used; grains that came from a file are in the log's initial state
  int run = 0;
  CollisionLog log;
  std::filesystem::path file{};  ///< that it was read from; empty: none
};

/// Returns what stands in a file of collisions; read_collision_log reads it back.
std::string collision_log_bytes(const StoredRun& stored);

/// Reads a log, or collision_log_name in a folder. Throws FileError, naming what is wrong with the file.
StoredRun read_collision_log(std::filesystem::path file, KnownEffects known);

}  // namespace shakedown
