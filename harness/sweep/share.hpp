// SPDX-License-Identifier: MIT
// Which part of a sweep this process does. Jobs are dealt out like cards, so shares cost about the same.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace shakedown {

struct JobShare {
  int index = 0;  ///< 0 ... of - 1
  int of = 1;
  std::string source{};  ///< what said so, for people; empty: nobody, everything is done here

  /// Tells whether this process does the job of this number.
  bool has(std::size_t job) const {
    return job % static_cast<std::size_t>(of) == static_cast<std::size_t>(index);
  }
};

/// Reads "2/8", the second of eight. Throws InputError.
JobShare parse_share(std::string_view text);

/// Returns the value of a variable of the environment; nothing where it is not set.
using Environment = std::function<std::optional<std::string>(const char* name)>;
/// Returns the environment of this process.
Environment process_environment();

/// Returns the share that a launcher gave: ranks of Open MPI, MVAPICH, or any with PMI; tasks of srun; Slurm
/// job arrays and Grid Engine arrays, and tasks within array members. A Slurm batch script itself is no task
/// of srun: without a step it does everything. Throws InputError when rank and size contradict each other.
JobShare share_from_launcher(const Environment& environment);

}  // namespace shakedown
