// SPDX-License-Identifier: MIT
// Counted fractions and p-values, with what their number allows to say.
#pragma once
#include <string>
#include <vector>

namespace shakedown {

/// `hits` of `trials`, with Wilson's 95 % interval (E. B. Wilson, J. Am. Stat. Assoc. 22, 209 (1927)); 0 to 1
/// without trials.
struct Share {
  int hits = 0, trials = 0;
  double value = 0, low = 0, high = 1;
};
Share share_of(int hits, int trials);

/// "9 of 10 (90 %, 95 %: 60 to 98 %)"
std::string in_words(const Share& share);

/// P(D >= observed) of Kolmogorov's distance between these values and the uniform distribution on (0, 1);
/// Stephens' correction for small numbers (J. R. Stat. Soc. B 32, 115 (1970)). 1 without values.
double uniformity_p_value(std::vector<double> values);

}  // namespace shakedown
