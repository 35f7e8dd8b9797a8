// SPDX-License-Identifier: MIT
// Tells what counted fractions and p-values allow to say, given their number.
#pragma once
#include <string>
#include <vector>

namespace shakedown {

/// Holds `hits` of `trials`, with Wilson's 95 % interval (E. B. Wilson, J. Am. Stat. Assoc. 22, 209 (1927));
/// 0 to 1 without trials.
struct Share {
  int hits = 0, trials = 0;
  double value = 0, low = 0, high = 1;
};
/// Returns the share of so many hits in so many trials.
Share share_of(int hits, int trials);

/// Returns "9 of 10 (90 %, 95 %: 60 to 98 %)".
std::string in_words(const Share& share);

/// Returns P(D >= observed) of Kolmogorov's distance between these values and the uniform distribution on (0,
/// 1), with Stephens' correction for small numbers (J. R. Stat. Soc. B 32, 115 (1970)); 1 without values.
double uniformity_p_value(std::vector<double> values);

}  // namespace shakedown
