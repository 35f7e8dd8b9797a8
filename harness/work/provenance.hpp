// SPDX-License-Identifier: MIT
// Says what made a result, so that it can be made again.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace shakedown {

struct Provenance {
  std::string version, commit, compiler, flags;  ///< of this program
  std::string host_cpu;
  int host_cores = 0;
  std::string started;               ///< UTC, ISO 8601
  std::vector<std::string> command;  ///< as typed
  std::string engine;
  std::uint64_t seed = 0;
  int runs = 0, threads = 0;
};

/// Returns the part that this program and this machine determine; the caller fills in the rest.
Provenance provenance_of_this_program();

/// Returns the provenance as the object `provenance` of every result file.
std::string provenance_json(const Provenance& provenance);

/// Returns "shakedown 0.1.0 (commit, compiler)".
std::string version_line();

}  // namespace shakedown
