// SPDX-License-Identifier: MIT
// Whether two samples have the same mean for practical purposes: equivalence within a stated margin, which is
// more than "no significant difference" (that two tiny samples always reach).
#pragma once
#include <string>

#include "statistic.hpp"

namespace shakedown {

enum class Agreement {
  equivalent,   ///< the 95 % interval of the difference lies inside +-margin
  differ,       ///< it lies outside
  cannot_tell,  ///< it reaches over the margin's edge, or a sample has fewer than two values: more runs
  no_number     ///< neither sample has such a number
};
const char* to_string(Agreement verdict);

/// Difference of the means of two independent samples and its Welch interval; all in the unit of the samples.
struct Equivalence {
  Agreement verdict = Agreement::no_number;
  double difference = std::numeric_limits<double>::quiet_NaN();      ///< first - second
  double standard_error = std::numeric_limits<double>::quiet_NaN();  ///< NaN when it cannot be told
  double low = std::numeric_limits<double>::quiet_NaN();             ///< ends of the 95 % interval
  double high = std::numeric_limits<double>::quiet_NaN();
  double margin = 0;
  /// Runs of each by which the interval would fit on one side of the margin's edge if mean and spread stayed;
  /// 0 when that is settled or unknown.
  double runs_needed = 0;
};

/// Compares two means. Samples of the same runs share initial states, which only makes the true error smaller
/// than Welch's.
Equivalence equivalence_of(const Statistic& first, const Statistic& second, double margin);

/// Returns "equivalent", "differ by 4.2 standard errors", "cannot tell: more runs (about 30)".
std::string in_words(const Equivalence& equivalence);

}  // namespace shakedown
