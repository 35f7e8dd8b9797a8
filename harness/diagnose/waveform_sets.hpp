// SPDX-License-Identifier: MIT
// Fits and weighs sets of laws within a fit of many, and rids them of what is needless.
#pragma once
#include <vector>

#include "waveform.hpp"

namespace shakedown {

/// Holds a set of laws, fitted.
struct WaveformSet {
  WaveformFit fit;
  double log_odds = 0;  ///< ln of its probability, but for a constant that all sets of a search share
};

/// Tells whether two laws of one family describe the same thing to a waveform, by which alone one of them is
/// told: a sine beside a cubic, or a tilt beside a spring stiffer to one side.
bool say_the_same(const WaveformLaw& one, const WaveformLaw& other);

/// Tells whether a law of a fit says what one before it says.
bool says_it_twice(const WaveformFit& fit, std::size_t which);

/// Returns ln of the prior of the laws of a fit and of the share that the data leave of it; -infinity where
/// one of them cannot be what it is fitted to be. `candidates`: how many laws were in question.
double log_prior_odds(const WaveformFit& fit, double candidates, double swing_frequency);

/// Returns ln odds beforehand of one law more among so many, with what the data usually leave of its prior
/// (e^-3): a guess by which fits are put in order before they are made.
double log_odds_of_one_more(double laws_in_question);

/// Fits and weighs the sets of laws of one search.
class WaveformSets {
 public:
  /// `few`: fits of one damping or two, which no search within a larger fit may lose. What is handed in must
  /// outlive it.
  WaveformSets(const std::vector<WaveformRun>& runs, double laws_in_question,
               const std::vector<WaveformFit>& few, const WaveformOptions& options)
      : runs_(runs), laws_in_question_(laws_in_question), few_(few), options_(options) {}

  /// Returns the sets of laws among those of the whole that are in question by what dropping laws costs to
  /// second order, fitted. Most probable first.
  std::vector<WaveformSet> within(const WaveformFit& whole) const;
  /// Returns how much chi2 rises without each law of a fit.
  std::vector<double> gains_of(const WaveformFit& fit) const;

 private:
  /// Returns WaveformSet::log_odds of a fit; -infinity where it cannot be simulated or believed.
  double log_odds_of(const WaveformFit& fit) const;
  /// Adds a fit of one or two dampings, fitted by themselves, with all of the whole that damps nothing.
  void add_with_extras(const WaveformFit& few, const WaveformFit& whole,
                       std::vector<WaveformSet>& sets) const;
  /// Adds a fit to the sets; of fits of the same laws the more probable one stays.
  void keep(WaveformFit fit, std::vector<WaveformSet>& sets) const;
  /// Adds the most probable set without each of its laws, until none of these is more probable: the guesses
  /// of second order are taken about the whole, where a needless law may hold the others away from their
  /// minimum.
  void without_the_needless(std::vector<WaveformSet>& sets) const;
  /// Returns the rise of chi2 where the laws that are not in the set are zero (Wald); infinite where one that
  /// stays would have a sign that it cannot have, or the set says something twice.
  double dropped(const WaveformFit& whole, unsigned set) const;
  /// Fits the laws of the set (bit i: the i-th of the whole) from their values in the whole.
  WaveformFit part_of(const WaveformFit& whole, unsigned set, int evaluations = 40) const;

  const std::vector<WaveformRun>& runs_;
  double laws_in_question_;
  const std::vector<WaveformFit>& few_;
  const WaveformOptions& options_;
};

}  // namespace shakedown
