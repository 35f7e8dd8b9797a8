// SPDX-License-Identifier: MIT
// Sets of laws within a fit of many: fitted, weighed, and rid of what is needless.
#pragma once
#include <vector>

#include "waveform_search.hpp"

namespace shakedown {

/// ln odds beforehand of one law more among so many, with what the data usually leave of its prior (e^-3): a
/// guess by which fits are put in order before they are made.
double log_odds_of_one_more(double laws_in_question);

class WaveformSets {
 public:
  /// `few`: fits of one damping or two, which no search within a larger fit may lose. What is handed in must
  /// outlive it.
  WaveformSets(const std::vector<WaveformRun>& runs, double laws_in_question,
               const std::vector<WaveformFit>& few, const WaveformOptions& options)
      : runs_(runs), laws_in_question_(laws_in_question), few_(few), options_(options) {}

  /// Every set of laws among those of the whole, by what dropping laws costs to second order; those in
  /// question are fitted. Most probable first.
  std::vector<WaveformSet> within(const WaveformFit& whole) const;
  /// Of each law of a fit: what chi2 loses without it.
  std::vector<double> gains_of(const WaveformFit& fit) const;

 private:
  double log_odds_of(const WaveformFit& fit) const;
  /// One or two dampings, fitted by themselves, with all of the whole that damps nothing.
  void add_with_extras(const WaveformFit& few, const WaveformFit& whole,
                       std::vector<WaveformSet>& sets) const;
  /// Of fits of the same laws the more probable one.
  void keep(WaveformFit fit, std::vector<WaveformSet>& sets) const;
  /// The most probable set without each of its laws, until none of these is more probable: the guesses of
  /// second order are taken about the whole, where a needless law may hold the others away from their
  /// minimum.
  void without_the_needless(std::vector<WaveformSet>& sets) const;
  /// Rise of chi2 where the laws that are not in the set are zero (Wald); infinite where one that stays would
  /// have a sign that it cannot have, or the set says something twice.
  double dropped(const WaveformFit& whole, unsigned set) const;
  /// The laws of the set (bit i: the i-th of the whole) fitted from their values in the whole.
  WaveformFit part_of(const WaveformFit& whole, unsigned set, int evaluations = 40) const;

  const std::vector<WaveformRun>& runs_;
  double laws_in_question_;
  const std::vector<WaveformFit>& few_;
  const WaveformOptions& options_;
};

}  // namespace shakedown
