// SPDX-License-Identifier: MIT
// Finds which forces the momentum balance asks for. Every set of up to four strengths is a hypothesis; its
// evidence is in closed form (Laplace), with a prior for each strength about what is typical of the effect
// and one for how many effects an experiment hides. The spring's frequency and the nuisances are in every
// fit.
#pragma once
#include <functional>
#include <vector>

#include "momentum_fit.hpp"
#include "momentum_terms.hpp"

namespace shakedown {

/// ln odds beneath the most probable set below which a set is out of question: one in a million.
constexpr double hopeless_log_odds = 14;

/// Names one term in the fit: a known strength, a formula (lines beyond the known ones), or a sine (two
/// columns).
struct ChosenTerm {
  int term = -1;         ///< -1: harmonic
  double frequency = 0;  ///< Hz
};

/// Holds the terms that were chosen, and their fit.
struct Selection {
  std::vector<ChosenTerm> chosen;  ///< the spring's frequency first
  Regression fit;        ///< columns in the order of `chosen`, two for a harmonic, then the nuisances
  double objective = 0;  ///< -2 ln likelihood: chi2 and the noise that the fitted forces let in
};

/// A term that could take another's place with chi2 no more than this higher, three standard deviations, is
/// called its look-alike.
constexpr double as_good = 9;

/// Holds a set of strengths and how probable it is among all sets that were compared.
struct BalanceHypothesis {
  std::vector<ChosenTerm> chosen;  ///< the spring's frequency first
  double log_odds = 0;             ///< ln of posterior over that of nothing beside frequency and nuisances
  double gain = 0;                 ///< fall of chi2 that it brings; the rest of log_odds is prior
  double probability = 0;
};

/// Holds what is compared; the covariance of `problem` follows the fit.
struct SelectionProblem {
  MomentumProblem problem;
  std::vector<MomentumTerm> known;
  std::vector<PreparedTerm> terms;  ///< as `known`, then formulas
  const std::vector<MomentumRun>* runs = nullptr;
  double highest_frequency = 0;  ///< Hz, of a sine that these windows can see
  double typical_sine = 0;       ///< m/s^2; 0: no effect of the library is a sine
  /// Returns the samples of a known strength, one entry a run, at another value than that of the terms.
  std::function<std::vector<ForceSamples>(const MomentumTerm&, double strength)> derive;

  /// Tells whether this place in `terms` is one of `known`; else it is a formula, or -1, a sine.
  bool is_known(int term) const { return term >= 0 && term < static_cast<int>(known.size()); }
};

/// Returns the whitened columns of the chosen terms, then the nuisances.
Eigen::MatrixXd columns_of(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen);

/// Fits the chosen terms, taking their own noise into the covariance.
Selection fit_terms(SelectionProblem& p, std::vector<ChosenTerm> chosen);

/// Returns all sets of known strengths beside what is in `base` (the spring's frequency, sines), most
/// probable first. Probabilities are among these.
std::vector<BalanceHypothesis> compare_sets(const SelectionProblem& p, const std::vector<ChosenTerm>& base);

/// Returns the sets in question, each weighed with its own noise: a set whose forces let more of the frames'
/// noise in pays for what it thereby seems to explain. Those that are hopeless beside the first are left out.
std::vector<BalanceHypothesis> with_own_noise(const SelectionProblem& p,
                                              const std::vector<BalanceHypothesis>& sets);

/// Returns the known strengths that leave a trace in the balance beside frequency and nuisances.
std::vector<int> terms_seen(const SelectionProblem& p);

/// Returns ln evidence of the wander of the track that the problem has, whatever acts on the box.
double log_evidence_of_noise(const SelectionProblem& p);

/// Holds a sine: its frequency, Hz, and the ln odds that it brings over none.
struct SineFound {
  double frequency = 0, log_odds = 0;
};
/// Returns the sine that gains most beside a selection, of frequencies from `lowest` to `highest` (Hz). Its
/// ln odds allow for all frequencies looked at; they are -infinity where there are none. Not looked at is
/// what the recording cannot resolve from a sine of the selection or from the swing of an empty box.
SineFound best_sine(const SelectionProblem& p, const Selection& beside, double lowest, double highest);

/// Returns the fall of chi2 when a known strength joins (or, for one of the chosen, when it is there).
Gain gain_of_term(const SelectionProblem& p, const Selection& selection, int term);

/// Tells whether every term of `part` stands in `whole`.
bool is_part_of(const std::vector<ChosenTerm>& part, const std::vector<ChosenTerm>& whole);

/// Returns how many columns a chosen term has.
inline Eigen::Index width_of(const ChosenTerm& c) { return c.term < 0 ? 2 : 1; }

}  // namespace shakedown
