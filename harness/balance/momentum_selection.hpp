// SPDX-License-Identifier: MIT
// Forward selection of the terms of the momentum balance.
#pragma once
#include <optional>
#include <vector>

#include "momentum.hpp"
#include "momentum_fit.hpp"

namespace shakedown {

/// One term in the fit: a line of momentum_terms(), or a sine at a frequency (two columns).
struct ChosenTerm {
  int term = -1;         ///< -1: harmonic
  double frequency = 0;  ///< Hz
};

struct Selection {
  std::vector<ChosenTerm> chosen;  ///< the spring's frequency first
  Regression fit;                  ///< columns in the order of `chosen`, two for a harmonic
  double objective = 0;            ///< -2 ln likelihood: chi2 and the noise that the fitted forces let in
};

/// A term that could take another's place with chi2 no more than this higher, three standard deviations, is
/// called its look-alike.
constexpr double as_good = 9;

/// What the selection works on; the covariance of `problem` follows the fit.
struct SelectionProblem {
  MomentumProblem problem;
  std::vector<PreparedTerm> terms;  ///< as momentum_terms()
  const std::vector<MomentumRun>* runs = nullptr;
  double highest_frequency = 0;  ///< Hz, of a sine that these windows can see
};

SelectionProblem selection_problem(const std::vector<MomentumRun>& runs, double frequency,
                                   const MomentumOptions& options);

/// Whitened columns of the chosen terms.
Eigen::MatrixXd columns_of(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen);

/// Fits the chosen terms, taking their own noise into the covariance.
Selection fit_terms(SelectionProblem& p, std::vector<ChosenTerm> chosen);

/// Adds terms while chi2 falls by more than ln n + 6 (a sine: its two columns and the number of frequencies
/// tried count), swaps a term for another that fits better, and drops what is no longer needed.
Selection select_terms(SelectionProblem& p, const MomentumOptions& options);

/// The strongest sine between the frequencies that shorter windows see and the ones that selection_problem's
/// own see, when it is worth its price; amplitudes in m/s^2.
struct FastSine {
  double frequency = 0, sine = 0, cosine = 0, error = 0;
};
std::optional<FastSine> find_fast_sine(SelectionProblem& shorter, const std::vector<ChosenTerm>& chosen,
                                       double lowest, double highest);

/// Drops the first term that is no longer worth its price; false when there is none.
bool drop_needless(SelectionProblem& p, Selection& selection);

/// The known term or sine that is most worth adding: its gain less its price.
struct KnownCandidate {
  ChosenTerm term;
  double surplus = 0;
};
std::optional<KnownCandidate> best_known(const SelectionProblem& p, const Selection& selection,
                                         const MomentumOptions& options);

/// Fall of chi2 when a line of momentum_terms() joins (or, for one of the chosen, when it is there).
Gain gain_of_term(const SelectionProblem& p, const Selection& selection, int term);

}  // namespace shakedown
