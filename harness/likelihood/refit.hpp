// SPDX-License-Identifier: MIT
// Parameters of a model from an experiment, through emulators: generalised least squares with the covariance
// of the chaos, the camera's noise and the emulator's own error. Whether what remains is within the model's
// spread is told by pseudo-experiments drawn from simulations that the covariance has not seen.
#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "failure_cells.hpp"
#include "judgement.hpp"
#include "validation.hpp"

namespace shakedown {

struct FittedValue {
  std::string key;
  double value = 0, low = 0, high = 0;  ///< 95 % interval
  double error = 0;                     ///< standard error
  bool at_bound = false;
};

/// How one measured run compares with the model at the fit.
struct RunComparison {
  std::string run;
  /// m, rms of measured less mean of the model, with what the run has of its own (release, clock, the track's
  /// wander) where the run itself puts it.
  double error_box = 0, error_centre = 0;
  /// m, the same of recordings that the model itself makes, refitted: rms over pseudo-experiments. Of a run
  /// that was only foretold, by the covariance.
  double floor_box = 0, floor_centre = 0;
  /// Share of these recordings that leave as much as was measured; NaN where there are none.
  double chance_box = std::numeric_limits<double>::quiet_NaN(), chance_centre = chance_box;
  double chi2 = 0;
  Eigen::VectorXd residual;              ///< m, each feature
  Eigen::VectorXd spread;                ///< m, its expected standard deviation
  std::vector<Validation> validation{};  ///< of each observable; empty where it was only foretold
};

/// Fills in errors and floors, rms over the features of each observable, from what is left (m, of each
/// feature) and the spread.
void set_errors(RunComparison& run, const FeaturePlan& plan, const Eigen::VectorXd& left);

/// For the judgement: box and centre of all runs, then the rows of their validation.
std::vector<Difference> differences_of(const std::vector<RunComparison>& runs);

struct Refit {
  std::vector<Knob> knobs;
  Eigen::VectorXd least_known;  ///< a standard error along the direction in which the knobs are known least,
                                ///< in their units
  std::vector<Eigen::MatrixXd>
      covariances;  ///< m^2, of each measured run's features: chaos, camera noise and model error
  std::vector<Eigen::MatrixXd> for_means;  ///< covariance_for_means() of the same
  /// Straight emulators of each measured run about the values, by one width of each knob, with the chaos of
  /// simulations made there; empty where none were.
  std::vector<Emulator> at_solution;
  std::vector<FittedValue> values;
  Eigen::MatrixXd covariance;  ///< of the values, in their units
  double chi2 = 0, degrees = 0;
  double p_value = 1;      ///< share of pseudo-experiments that, refitted, fit no better
  double far_p_value = 1;  ///< the same by a chi2 distribution of the pseudo-experiments' mean and variance:
                           ///< below what their number can tell
  double scatter = 1;      ///< chi2 over the median of the pseudo-experiments'
  std::vector<RunComparison> runs;
  std::vector<FailureCell> cells;  ///< worst first
  /// Each box length predicted from a fit to the others, rms of the box, m; NaN with one length only.
  double held_out_error_box = 0;
  std::vector<Validation> validation() const;  ///< of every run
  /// As a test of the model.
  ModelTest test() const { return {p_value, scatter, "", codes_differ}; }
  double codes_differ = shakedown::codes_differ;  ///< ModelTest::undecided_below, by the model's effects
  std::vector<Difference> left() const { return differences_of(runs); }
  double promised_scatter = 1, promised_chi2 = 0;  ///< `scatter` and `judged_chi2` by the emulator, where
                                                   ///< simulations at the solution have judged
  /// chi2, and its sum over the lengths left out, in the covariances of RefitOptions::judged_by, so that
  /// rivals are measured with one rule.
  double judged_chi2 = 0, judged_held_out_chi2 = 0;
  double error_box() const;
  double error_centre() const;
  double floor_box() const;
  double floor_centre() const;
};

/// Simulations of each different setup in a round that only finds the way: half of those of the round that
/// judges, and `fewest_on_the_way` at least (an assumption).
constexpr int fewest_on_the_way = 64;
constexpr int simulations_on_the_way(int count) { return std::max(fewest_on_the_way, count / 2); }

struct RefitOptions {
  int count = 192;      ///< simulations of each different setup in the last round, half as many before
  int rounds = 2;       ///< re-centrings
  int most_rounds = 4;  ///< when the solution keeps leaving the box
  int most_looks = 2;   ///< again, as look_again_below and look_beside_below ask for them
  int first_run = 1000;
  /// Of the release: what two codes of the same physics differ by where restitutions are free. Of soft
  /// contacts (0.15, 0.3 and 0.4 ms; means of 48 runs) less hard impacts (of 200), the paper's damper at 40,
  /// 65 and 104 mm, restitutions moved by -0.013 and 0.024 at most leave 0.03 to 0.04, 0.04 to 0.07 and 0.07
  /// to 0.15 mm of the box, most of it the noise of those means.
  double model_error = 5e-4;
  const Refit* judged_by = nullptr;  ///< a fit to the same measured runs; null: by itself
  /// Simulations of each different setup at the solution, which then move it to the minimum that they and the
  /// emulator's slopes show, and judge it: its chi2, errors, p-value and cells. An emulator that cannot
  /// follow the model takes its own misfit for chaos, and where the model is wrong it promises too much. 0:
  /// the emulator judges.
  int confirming = 0;
  /// Where it promised much more than the simulations at the solution confirm, it looks again in a narrower
  /// box, if what it promised is below this judged_chi2.
  double look_again_below = std::numeric_limits<double>::infinity();
  /// Below this p-value, where the misfit is not gross, it looks again on both sides along the direction that
  /// is known least, and keeps the best: a valley's emulator is noisy.
  double look_beside_below = 0;
};

/// Fits the knobs (none: the setup as it is). Where simulations are refused (Execution::ask_for) once there
/// is a solution, that solution is the answer; before, BudgetSpent passes through. `measured` may leave runs
/// out; compare_at() then judges them.
Refit refit(const std::vector<MeasuredFeatures>& measured, std::vector<Knob> knobs, const Workshop& workshop,
            const RefitOptions& options);

/// A fit of the same runs that was made without looking beside it: does what RefitOptions::look_beside_below
/// asks, and keeps the best.
Refit look_beside(const Refit& fit, const std::vector<MeasuredFeatures>& measured, const Workshop& workshop,
                  const RefitOptions& options);

/// The same measured runs (or others) against the model with the knobs at the given values, nothing fitted.
Refit compare_at(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
                 const Workshop& workshop, const RefitOptions& options);

}  // namespace shakedown
