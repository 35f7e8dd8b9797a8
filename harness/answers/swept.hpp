// SPDX-License-Identifier: MIT
// Tells what a sweep costs, and what its file of results holds.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "result_file.hpp"
#include "sweep.hpp"

namespace shakedown {

/// Returns in a line what a sweep costs on so many threads, for this process' share.
std::string cost_text(const SweepCost& cost, const JobShare& share, int threads);
/// Returns the same as JSON text, s.
std::string cost_json(const SweepCost& cost, int threads);

/// Holds what a file of results comes to.
struct Swept {
  SweepIdentity identity;
  std::vector<ResultRow> rows;
  std::vector<PointSummary> points;
  std::string finding, digest;  ///< in words; of all rows
};

/// Returns what is in the file now. Throws FileError.
Swept swept(const ResultFile& file);

/// Returns it as text for a terminal. `name`: of the file; `jobs`: rows that there will be, 0: not known.
std::string swept_text(const Swept& swept, const std::string& name, std::size_t jobs);
/// Returns it as JSON text. `complete`: no row is left to do.
std::string swept_json(const Swept& swept, bool complete);

}  // namespace shakedown
