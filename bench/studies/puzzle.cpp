// SPDX-License-Identifier: MIT
#include "puzzle.hpp"

#include <fmt/format.h>

#include <cmath>

#include "effects.hpp"
#include "engine_differences.hpp"
#include "engines.hpp"
#include "free_parameters.hpp"
#include "measurements.hpp"
#include "refit.hpp"
#include "refit_options.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

Setup believed() {
  Setup setup;
  setup.restitution.grain_grain = drop_test_restitution;
  return setup;
}

Experiment film_of_laboratory(double restitution, double friction, const std::vector<double>& lengths,
                              const PuzzleOptions& options) {
  Setup truth = believed();
  truth.restitution.grain_grain = restitution;
  truth.run.duration = 16;
  if (friction > 0)
    for (const char* key : {"grain_friction.grain_grain", "grain_friction.grain_wall"})
      set_number(truth, key, friction, all_effects());
  const std::unique_ptr<Engine> soft = engine_named("soft");
  return make_measurements(truth, runs_of_lengths(lengths), {},
                           {soft.get(), all_effects(), 7, options.execution, {}});
}

bool is_fitted(const MeasuredRun& run) { return run.box_length < 0.05; }

Fit fitted(const Setup& start, const Experiment& experiment, const std::string& free,
           const PuzzleOptions& options) {
  FitOptions how;
  for (const MeasuredRun& run : experiment.runs)
    if (is_fitted(run)) how.on.push_back(run.name);
  how.count = options.quick ? 64 : 128;
  how.execution = options.execution;
  how.known = all_effects();
  return fit_parameters(start, measurement_of(start, experiment, all_effects()),
                        free_parameters(free, start, all_effects()), *engine_named("hard"), how);
}

PuzzleModel model_of(std::string name, const std::vector<RunComparison>& runs) {
  PuzzleModel model{std::move(name), {}, {}, {}};
  for (const RunComparison& run : runs) {
    model.runs.push_back(run.run);
    model.error.push_back(run.error_box);
    model.spread.push_back(run.floor_box);
  }
  return model;
}

Experiment part_of(const Experiment& whole, bool fitted) {
  Experiment part = whole;
  std::erase_if(part.runs, [&](const MeasuredRun& run) { return is_fitted(run) != fitted; });
  return part;
}

/// Judges the model as it stands on the lengths that nobody fitted.
PuzzleModel unfitted(const std::string& name, const Setup& setup, const Experiment& experiment,
                     const PuzzleOptions& options) {
  const std::unique_ptr<Engine> hard = engine_named("hard");
  const Workshop workshop{hard.get(), all_effects(), options.execution};
  RefitOptions how;
  how.count = options.quick ? 48 : 128;
  return model_of(name, refit(features_of(measurement_of(setup, part_of(experiment, false), all_effects())),
                              {}, workshop, how)
                            .runs);
}

/// Returns the diagnosis when the restitution of the drop test is held fixed and only L = 40 mm was filmed.
Diagnosis diagnosed(const Experiment& experiment, const PuzzleOptions& options) {
  DiagnoseOptions how;
  how.execution = options.execution;
  how.known = all_effects();
  how.fixed = {"restitution.grain_grain"};
  how.strength_uncertainty = &strength_uncertainty;
  return diagnose(believed(), measurement_of(believed(), part_of(experiment, true), all_effects()),
                  *engine_named("hard"), how);
}

/// Goes from the laboratory with friction back to the model, both ways: restitution fitted, and 0.95 with
/// friction.
void repair(Puzzle& puzzle, const Experiment& experiment, const Fit& frictionless,
            const PuzzleOptions& options) {
  puzzle.models.push_back(unfitted("0.95, no friction", believed(), experiment, options));
  puzzle.models.push_back(model_of("restitution fitted, no friction", frictionless.left_out));
  if (!options.quick) {
    puzzle.diagnosis = diagnosed(experiment, options);
    puzzle.models.push_back(unfitted("0.95, with what the diagnosis of 40 mm adds", puzzle.diagnosis.amended,
                                     experiment, options));
  }
  puzzle.with_friction =
      fitted(believed(), experiment, "grain_friction.grain_grain&grain_friction.grain_wall", options);
  puzzle.models.push_back(model_of("0.95, friction fitted", puzzle.with_friction.left_out));
}

}  // namespace

Puzzle solve_puzzle(const PuzzleOptions& options) {
  const auto tell = [&](const std::string& stage) {
    if (options.progress) options.progress(stage);
  };
  Puzzle puzzle;
  Setup start = believed();
  start.restitution.grain_grain = 0.85;
  tell("the puzzle: the paper's fit");
  puzzle.as_the_paper = fitted(start, film_of_laboratory(0.75, 0, {0.040, 0.040}, options),
                               "restitution.grain_grain,restitution.grain_wall", options);
  const std::vector<double> frictions =
      options.quick ? std::vector{0.0, 0.1, 0.2, 0.5} : std::vector{0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5};
  for (const double friction : frictions) {
    tell(fmt::format("the puzzle: friction {:g}", friction));
    const bool chosen = friction == puzzle.friction;
    const Experiment experiment = film_of_laboratory(
        drop_test_restitution, friction,
        chosen ? std::vector{0.040, 0.040, 0.065, 0.085, 0.104} : std::vector{0.040, 0.040}, options);
    PuzzlePoint point{friction, fitted(start, experiment, "restitution.grain_grain", options), {}};
    if (!options.quick)
      point.both = fitted(start, experiment, "restitution.grain_grain,restitution.grain_wall", options);
    if (chosen) {
      tell(options.quick ? "the puzzle: friction in the model" : "the puzzle: diagnosis");
      repair(puzzle, experiment, point.one, options);
    }
    puzzle.points.push_back(std::move(point));
  }
  return puzzle;
}

double friction_that_looks_like(const Puzzle& puzzle, double restitution) {
  constexpr double rounding = 0.005;
  for (const PuzzlePoint& point : puzzle.points) {
    const FittedParameter& found = point.one.parameters.front();
    if (found.low - rounding <= restitution && restitution <= found.high + rounding) return point.friction;
  }
  return std::nan("");
}

}  // namespace shakedown
