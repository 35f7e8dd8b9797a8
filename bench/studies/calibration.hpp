// SPDX-License-Identifier: MIT
// Tells whether the probabilities and intervals of a blind suite's answers mean what they say.
#pragma once
#include <vector>

#include "opened_case.hpp"
#include "score_table.hpp"

namespace shakedown {

/// Returns -ln of the probability that the answer gives to the truth, at least one in a thousand, so that one
/// answer that is sure and wrong does not outweigh all others: 0 is perfect, 6.9 the worst. A case without an
/// answer has the worst.
double log_score(const OpenedCase& one);

/// Adds the mean log score, of all cases and by kind.
void log_scores(const std::vector<OpenedCase>& cases, ScoreTable& table);

/// Adds how often the first hypothesis is the truth, among answers that give it about the same probability. A
/// row is met where the 95 % interval of that share (Wilson) holds the mean of the probabilities.
void reliability(const std::vector<OpenedCase>& cases, ScoreTable& table);

/// Returns how many standard deviations the truth lies from the middle of a 95 % interval, of which one is
/// half the interval over 1.96.
double deviations_from_middle(const FoundInterval& interval, double truth);

/// Adds the coverage at 50, 80, 95 and 99 %: the share of truths, of strengths named exactly, within the
/// central parts that the intervals stand for.
void coverage_by_quantile(const std::vector<OpenedCase>& cases, ScoreTable& table);

/// Returns the truth of a strength as the interval counts it: an angle in the interval's own turn.
double truth_beside(const std::string& key, double truth, const FoundInterval& interval);

}  // namespace shakedown
