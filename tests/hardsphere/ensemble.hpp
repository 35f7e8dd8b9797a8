// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <thread>
#include <vector>

#include "hard_engine.hpp"

namespace shakedown {

/// Runs 0 ... n - 1 of a setup on the hard engine, two at a time.
inline std::vector<Trajectory> hard_ensemble(const Setup& setup, int n) {
  std::vector<Trajectory> runs(static_cast<std::size_t>(n));
  const auto engine = make_hard_engine();
  const auto every_other = [&](int first) {
    for (int run = first; run < n; run += 2) {
      RunOptions options;
      options.run = run;
      runs[static_cast<std::size_t>(run)] = engine->run(setup, options);
    }
  };
  std::jthread other(every_other, 1);
  every_other(0);
  return runs;
}

/// Mean and standard deviation of one.
struct MeanOfRuns {
  double sum = 0, squares = 0;
  int n = 0;
  void add(double value) { sum += value, squares += value * value, ++n; }
  double mean() const { return sum / n; }
  double deviation() const { return std::sqrt(std::max(0.0, (squares - sum * sum / n) / (n - 1))); }
  double error() const { return deviation() / std::sqrt(n); }
};

}  // namespace shakedown
