// SPDX-License-Identifier: MIT
// Keeps the rows of a score: what was counted, what was aimed at.
#pragma once
#include <string>
#include <vector>

#include "blind_suite.hpp"

namespace shakedown {

struct Count {
  int hits = 0, trials = 0;
  void add(bool hit) { hits += hit, ++trials; }  ///< counts one more trial
};

class ScoreTable {
 public:
  /// Add a row whose aim is a share of hits of at most, or at least, the limit.
  void at_most(const std::string& what, const Count& count, double limit);
  void at_least(const std::string& what, const Count& count, double limit);
  /// Adds a row whose aim is a share between the limits. It is judged from 20 trials on, as fewer cannot come
  /// between 90 and 98 %.
  void between(const std::string& what, const Count& count, double low, double high);
  void plain(const std::string& what, const std::string& aim, const std::string& found,
             BlindFigure::Verdict kept);
  /// Adds a figure that has no aim.
  void beside(const std::string& what, const Count& count);

  std::vector<BlindFigure> rows;
};

}  // namespace shakedown
