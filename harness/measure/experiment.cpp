// SPDX-License-Identifier: MIT
#include "experiment.hpp"

#include <cmath>

#include "robust_statistics.hpp"

namespace shakedown {

double typical_rate(const std::vector<double>& time) {
  const double interval = typical_interval(time);
  return std::isfinite(interval) ? 1 / interval : 0;
}

bool starts_anywhere(const MeasuredRun& run, const Setup& setup) {
  return run.start == Start::anywhere || (run.start == Start::not_said && setup.grains.count == 0);
}

std::vector<KnownValue> known_of(const Experiment& experiment, const MeasuredRun& run) {
  std::vector<KnownValue> known = run.known;
  for (const KnownValue& one : experiment.known)
    if (!find_known(run.known, one.key)) known.push_back(one);
  return known;
}

}  // namespace shakedown
