// SPDX-License-Identifier: MIT
// The paper's puzzle: a drop test says that two grains keep 0.95 of their closing speed, the fit to L = 40 mm
// says 0.75. "Missing dissipation mechanisms (e.g., granulate friction)", the paper guesses. Here the soft
// engine is the laboratory: grains with 0.95 and friction, filmed; the frictionless model is fitted to L = 40
// mm as the paper did; then friction is put into the model.
#pragma once
#include <string>
#include <vector>

#include "diagnosis.hpp"
#include "execution.hpp"
#include "fit.hpp"

namespace shakedown {

constexpr double drop_test_restitution = 0.95;

struct PuzzlePoint {
  double friction = 0;  ///< of grains and walls, in the laboratory
  Fit one;              ///< restitution.grain_grain alone, wall as in the paper
  Fit both;             ///< both restitutions; empty in the quick version
};

/// Error (rms of x_box, m) on the lengths that were not fitted, and what noise and chaos make.
struct PuzzleModel {
  std::string name;
  std::vector<std::string> runs;
  std::vector<double> error, spread;
};

struct Puzzle {
  std::vector<PuzzlePoint> points;
  Fit as_the_paper;       ///< both restitutions, where the laboratory has the paper's 0.75 and 0.76 and no
                          ///< friction
  double friction = 0.2;  ///< of the laboratory below
  std::vector<PuzzleModel> models;  ///< 0.95 as it is, the frictionless fit, 0.95 with what the diagnosis
                                    ///< adds, 0.95 with friction fitted
  Fit with_friction;                ///< grain_friction fitted to L = 40 mm, 0.95 fixed
  Diagnosis diagnosis;  ///< of the model with 0.95 held fixed, by L = 40 mm alone; its ladder is empty in the
                        ///< quick version
};

struct PuzzleOptions {
  bool quick = false;
  Execution execution{};
  std::function<void(const std::string& stage)> progress{};
};

/// Solves the puzzle. Throws Interrupted, and what engines throw.
Puzzle solve_puzzle(const PuzzleOptions& options);

/// Returns the smallest friction whose fitted restitution (95 % interval, and half a unit of the paper's last
/// digit) is this; NaN when none is.
double friction_that_looks_like(const Puzzle& puzzle, double restitution);

}  // namespace shakedown
