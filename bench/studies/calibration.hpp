// SPDX-License-Identifier: MIT
// Whether the probabilities and intervals of a blind suite's answers mean what they say.
#pragma once
#include <vector>

#include "opened_case.hpp"
#include "score_table.hpp"

namespace shakedown {

/// -ln of the probability that the answer gives to the truth, at least one in a thousand, so that one answer
/// that is sure and wrong does not outweigh all others: 0 is perfect, 6.9 the worst. A case without an answer
/// has the worst.
double log_score(const OpenedCase& one);

/// Mean log score, of all cases and by kind.
void log_scores(const std::vector<OpenedCase>& cases, ScoreTable& table);

/// Of answers that give their first hypothesis about the same probability: how often it is the truth. Kept
/// where the 95 % interval of that share (Wilson) holds the mean of the probabilities.
void reliability(const std::vector<OpenedCase>& cases, ScoreTable& table);

/// How many standard deviations the truth lies from the middle of a 95 % interval, whose halves may differ.
double deviations_from_middle(const FoundInterval& interval, double truth);

/// Of strengths named exactly: the share of truths within the central 50, 80, 95 and 99 % that the intervals
/// stand for.
void coverage_by_quantile(const std::vector<OpenedCase>& cases, ScoreTable& table);

/// The truth of a strength as the interval counts it: an angle in the interval's own turn.
double truth_beside(const std::string& key, double truth, const FoundInterval& interval);

}  // namespace shakedown
