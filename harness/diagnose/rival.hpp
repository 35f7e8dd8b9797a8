// SPDX-License-Identifier: MIT
// Carries a candidate through a round of the search: screened, fitted, weighed.
#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "effect_screen.hpp"
#include "state.hpp"

namespace shakedown {

/// Holds what is known of one candidate in this round.
struct Rival {
  const Candidate* candidate;
  ScreenedEffect screened;
  double log_odds = 0;
  double held_out_gain = 0;         ///< of chi2, fitted
  double log_ratio = std::nan("");  ///< ln likelihood of the fitted model over that before, means and spreads
  bool fitted = false;
  DiagnosisState state{};  ///< where it was fitted
  bool weighed = false;    ///< log_odds is more than its prior
  bool attempted = false;  ///< its fit had its turn
  /// chi2 of what its short fit left and of what the model without leaves, in the metric of the model
  /// without; NaN: no short fit was made.
  double short_chi2 = std::nan(""), chi2_without = std::nan("");
  std::optional<DiagnosisState> shortly{};    ///< where its short fit put it
  std::vector<Eigen::VectorXd> short_left{};  ///< m, of each run's features, by its short fit
  /// Its chi2 in the metric of its own runs, and that with the ln determinant: -2 ln likelihood but for a
  /// constant. NaN: none was made.
  double short_own_chi2 = std::nan(""), short_deviance = std::nan("");
  bool short_holds = false;           ///< the data accept it as its short fit left it
  double short_share = std::nan("");  ///< of simulations or time, that its short fit took
  bool weighed_by_left = false;       ///< its fit is weighed by what it leaves, for want of time
  bool out_of_time = false;           ///< no time or no simulations were left to weigh or fit it
  /// ln likelihood of the model without it where it was fitted, over that where the screen is.
  double nothing_gained = 0;
};

/// Tells whether what it does to the features is arithmetic on the recording. Its signature is then exact,
/// and the gain of a fit, which chaos makes, would tell less.
bool is_arithmetic(const Rival& rival);

/// Tells whether a fit found it: its odds over nothing are more than even.
bool is_found(const Rival& rival);

/// Tells whether the data accept it as fitted.
bool holds(const Rival& rival);

/// Tells whether nothing but what its fit leaves weighs it.
bool is_weighed_by_left(const Rival& rival);

/// Returns the effort that its fit can take of the share that is left, by what its short fit took: `usual`,
/// or that of effects which make runs dear.
Effort affordable(const Rival& rival, Effort usual, double left);

/// Returns by how much ln odds of signatures are wrong where the best one has ln odds of `best`, of either
/// sign: by a factor of ten in the odds or, far from nothing, by effort::signature_errs of `best`.
double signatures_err_by(double best);

/// Returns the knobs of a fit at its values; exact ones stay where they are.
std::vector<Knob> at_values(const Refit& fit);

/// Returns the state `before` with this effect at the strength that its signature asks for, not fitted.
DiagnosisState with_rival(const DiagnosisState& before, const Rival& rival, DiagnosisTools& tools);

/// Fits it beside the state `before`; `lowest`: chi2 of the best fit so far, below which a first look that
/// promised too much is worth another. BudgetSpent, PhysicsError and InputError pass.
void fit_rival(Rival& rival, const DiagnosisState& before, DiagnosisTools& tools, EffectScreen& screen,
               double lowest, Effort effort);

/// Fits it with little effort, which says whether a fit that weighs it is worth its cost. BudgetSpent,
/// PhysicsError and InputError pass.
void fit_shortly(Rival& rival, const DiagnosisState& before, DiagnosisTools& tools);

/// Lets its short fit stand where there was no time for a fit that weighs it, if it is alone in question: two
/// that are not are not told from each other. Returns false where it does not stand.
bool take_short_fit(const std::vector<Rival>& rivals, Rival& rival);

/// Sets its odds beside nothing by what is known so far: its prior, its signature, its fitted model; of one
/// that there was no time to weigh and whose signature says little, what its fit leaves. `candidates`: the
/// number of effects that are looked for.
void weigh_rival(Rival& rival, double candidates);

/// Weighs the rivals beside the best of them, where the data reject the model without them all: the
/// likelihood of each over that model is told in the metric of a model that is wrong, and errs by 2 % of
/// thousands. Fitted rivals which the data accept, and those that nothing but a fit weighs, are weighed by
/// what each leaves, in the metric of the best; what was not fitted, by what its short fit leaves, or, where
/// none was made, by the signatures of both; one that is arithmetic keeps its odds, for its signature is
/// exact. A fit that the data reject gains nothing by it.
void weigh_beside_the_best(std::vector<Rival>& rivals, double candidates);

/// Returns those whose fit has not had its turn and whose short fits made the data as likely as any as far as
/// short fits tell, most probable by their signatures first; none where no short fit was made. Where the data
/// accept some as they were fitted shortly, only these are in question, until their fits take that back.
std::vector<Rival*> in_question(std::vector<Rival>& rivals);

/// Tells whether no other short fit made the data as likely as this one's as far as short fits tell, and the
/// model without left more; of those that the data accept, whether no other is one that they accept.
bool is_alone_in_question(const std::vector<Rival>& rivals, const Rival& one);

/// Returns the one of these, most probable first, to fit next; null where there is none. Signatures that
/// differ by less than they err by say nothing, and the effect that was most probable beforehand has its
/// turn.
Rival* first_to_fit(const std::vector<Rival*>& by_odds);

/// Returns the probability of this effect, all its forms together, among these, each alone, and nothing.
double probability_among(const std::vector<Rival>& rivals, const Rival& one);

/// Returns the rival as the answer's ranking shows it.
RankedEffect ranked_as(const Rival& rival);

/// Returns what the signature of one that was not fitted says: strengths with 95 % intervals, which allow for
/// what hard impulses and soft contacts differ by (DiagnoseOptions::strength_uncertainty).
PromisedEffect promised_by(const Rival& rival, const DiagnoseOptions& options);

}  // namespace shakedown
