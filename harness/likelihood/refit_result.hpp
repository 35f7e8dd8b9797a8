// SPDX-License-Identifier: MIT
// Holds what a fit found: values with their errors, and how each measured run compares with the model there.
#pragma once
#include <limits>
#include <vector>

#include "failure_cells.hpp"
#include "judgement.hpp"
#include "validation.hpp"

namespace shakedown {

/// Holds the fitted value of one knob, in the SI unit of its key.
struct FittedValue {
  std::string key;
  double value = 0, low = 0, high = 0;  ///< 95 % interval
  double error = 0;                     ///< standard error
  bool at_bound = false;
};

/// Says how one measured run compares with the model at the fit.
struct RunComparison {
  std::string run;
  /// m, rms of measured less mean of the model, with what the run has of its own (release, clock, the track's
  /// wander) where the run itself puts it.
  double error_box = 0, error_centre = 0;
  /// m, the same of recordings that the model itself makes, refitted: rms over pseudo-experiments. Of a run
  /// that was only foretold: rms of its expected spread.
  double floor_box = 0, floor_centre = 0;
  /// Share of these recordings that leave as much as was measured; NaN where there are none.
  double chance_box = std::numeric_limits<double>::quiet_NaN(), chance_centre = chance_box;
  double chi2 = 0;
  Eigen::VectorXd residual;              ///< m, each feature
  Eigen::VectorXd spread;                ///< m, its expected standard deviation
  std::vector<Validation> validation{};  ///< of each observable; empty where it was only foretold
};

/// Fills in the errors, rms of what is `left` (m, of each feature) over the features of each observable, and
/// the floors, rms of the spread.
void set_errors(RunComparison& run, const FeaturePlan& plan, const Eigen::VectorXd& left);

/// Returns the differences for the judgement: box and centre of all runs, then the rows of their validation.
std::vector<Difference> differences_of(const std::vector<RunComparison>& runs);

/// Holds what a fit of the knobs to measured runs found.
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
  /// Returns the fit as a test for the judgement.
  ModelTest test() const { return {p_value, scatter, "", codes_differ}; }
  double codes_differ = shakedown::codes_differ;  ///< ModelTest::undecided_below, by the model's effects
  /// Returns what the fit leaves, as differences for the judgement.
  std::vector<Difference> left() const { return differences_of(runs); }
  double promised_scatter = 1, promised_chi2 = 0;  ///< `scatter` and `judged_chi2` by the emulator, where
                                                   ///< simulations at the solution have judged
  /// chi2, and its sum over the lengths left out, in the covariances of RefitOptions::judged_by, so that
  /// rivals are measured with one rule.
  double judged_chi2 = 0, judged_held_out_chi2 = 0;
  double own_chi2 = 0;   ///< as judged_chi2, by the covariances of this fit itself
  double disbelief = 0;  ///< what the knobs' values cost beforehand, in judged_chi2 and own_chi2 too
  /// These return the rms over the runs of what RunComparison calls so, m; each run counts once.
  double error_box() const;
  double error_centre() const;
  double floor_box() const;
  double floor_centre() const;
};

}  // namespace shakedown
