// SPDX-License-Identifier: MIT
// Decides what a diagnosis says in the end, from what was found.
#pragma once
#include "balance_evidence.hpp"
#include "diagnosis.hpp"

namespace shakedown {

/// Sets error and as_given of the whole box, m, rms of all runs, from the rows of two validations: what each
/// run has of its own (trigger, release, a wander) at its most probable. Without that a late trigger weighs
/// more than whatever a fit mends, and the error seems to rise. Nothing is changed where a row is missing.
void compare_with_given(const std::vector<Validation>& given, const std::vector<Validation>& fitted,
                        Difference& box);

/// Holds what the verdict rests on.
struct Findings {
  bool unlisted = false;             ///< a force of no list acts on the box
  bool anything_missing = false;     ///< effects were found
  std::vector<std::string> found{};  ///< effects of the final model
  bool refitted = false;             ///< parameters had to move
  double explained = 1;              ///< share of the misfit as given that the effects found take away
  bool camera_stands_out = false;    ///< something of the camera explains the recording
  ModelTest features{1, 1, ""}, balance{1, 1, ""};  ///< of the final model
  std::vector<Difference> left{};                   ///< by the final model
  double far_p_value = 1;  ///< of the features, below what pseudo-experiments can count too
};
/// Returns the share of the misfit beyond that of the model's own runs which goes from one fit to the next;
/// both as Refit::scatter. 1 where there was none, or where what is left is no number.
double share_taken_away(double before, double after);

/// Returns the verdict, by the table of verdicts in README.md.
Verdict verdict_of(const Findings& findings);

/// Returns the p-value that weighs something in no list against the final model: the worst of features,
/// balance and what is left. Misfits that two codes of the same physics have count no more than rules::holds.
double worst_p_value(const Findings& findings);

/// Independent numbers that a difference beyond judgement's most_left is made of at least: a run of fewer
/// frames than eight is not compared at all.
constexpr double least_independent = 8;

/// Returns the p-value of the worst difference beyond most_left by chi2 of least_independent degrees; 1 where
/// there is none: what is nearer is weighed by the other tests.
double p_value_of_left(const std::vector<Difference>& left);

/// Tells whether an effect explains something: one that leaves a rejected model with most of the misfit, or
/// with errors far above noise and chaos, does not. `scatter_before`: without it; `error`, `floor`: with it,
/// m.
bool explains(double p_value, double scatter, double scatter_before, double error, double floor);

/// Tells whether the errors of box and of centre, rms of all runs, are both greater in the second validation:
/// what was added between them makes no error fall. False where either lacks rows.
bool no_error_falls(const std::vector<Validation>& before, const std::vector<Validation>& after);

/// Tells whether what was added to a model that the data reject leaves one that they reject, `p_value`, and
/// lets no error fall: it is not what is missing.
bool adds_nothing(double p_value, const std::vector<Validation>& before,
                  const std::vector<Validation>& after);

/// Returns what of the camera the data show beyond what is known of it, most certain first.
std::vector<NuisanceFound> standing_out(const std::vector<NuisanceFound>& nuisances);

}  // namespace shakedown
