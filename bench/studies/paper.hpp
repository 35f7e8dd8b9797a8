// SPDX-License-Identifier: MIT
// Bannerman, Kollmer, Sack, Heckel, Mueller, Poeschel: Movers and shakers: Granular damping in microgravity.
// Its table, its figures and its statements, from both engines.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "chart.hpp"
#include "damper_runs.hpp"
#include "execution.hpp"
#include "length_sweep.hpp"
#include "puzzle.hpp"
#include "statement.hpp"

namespace shakedown {

struct PaperOptions {
  bool quick = false;  ///< few runs, coarse sweeps, the puzzle without its diagnosis
  Execution execution{};
  std::function<void(const std::string& stage, double fraction)> progress{};  ///< may be empty
};

/// Everything that was simulated.
struct PaperRuns {
  std::vector<DamperRuns> hard, soft;  ///< L = 40, 65, 85, 104, 311 mm
  std::vector<DamperRuns> finer;       ///< L = 40, 104 mm, all elastic thresholds divided by three
  DamperRuns twice_the_frequency;      ///< L = 40 mm
  DamperRuns elastic_side_walls;       ///< L = 40 mm
  LengthSweep lengths;                 ///< 25 to 600 mm
  std::vector<LengthSweep> frequencies, restitutions;  ///< lengths about the optimum
  Puzzle puzzle;
};

struct Paper {
  PaperRuns runs;
  std::vector<Statement> statements;
  std::vector<Chart> charts;
  double seconds = 0;
};

/// Simulates and judges all of it. Throws Interrupted.
Paper reproduce_paper(const PaperOptions& options);

// The parts of it, each from what was simulated.
std::vector<Statement> statements_of_motion(const PaperRuns& runs);
std::vector<Statement> statements_of_decay(const PaperRuns& runs);
std::vector<Statement> statements_of_optimum(const PaperRuns& runs);
std::vector<Chart> charts_of(const PaperRuns& runs);

/// Return, for files, Table I and the statements of the paper beside what was simulated.
std::string table_1_csv();
std::string statements_csv(const std::vector<Statement>& statements);
std::string paper_json(const Paper& paper);
std::string paper_markdown(const Paper& paper);

}  // namespace shakedown
