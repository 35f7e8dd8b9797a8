// SPDX-License-Identifier: MIT
#include "grain_count.hpp"

#include <algorithm>
#include <cmath>

#include "linear_audit.hpp"

namespace shakedown {

namespace {

Measurement counted(Measurement measurement, int difference) {
  for (Measurement::Run& run : measurement.runs)
    if (run.setup.grains.count > 0) run.setup.grains.count += difference;
  return measurement;
}

bool may_be_fewer(const Measurement& measurement) {
  int most = 0;
  for (const Measurement::Run& run : measurement.runs) {
    if (run.setup.grains.count == 1) return false;
    most = std::max(most, run.setup.grains.count);
  }
  return most > 1;
}

}  // namespace

std::vector<GrainCount> grain_counts(const Measurement& measurement, KnownEffects known,
                                     const MomentumAudit& audit) {
  if (!audit.possible || !may_be_fewer(measurement)) return {};
  MomentumOptions nothing_missing;
  nothing_missing.formulas = false;
  nothing_missing.effects = {"nothing"};
  nothing_missing.wander = audit.wander;
  const auto chi2 = [&](int difference) {
    return linear_audit(counted(measurement, difference), known, nothing_missing, {}).refitted.chi2;
  };
  const double as_given = chi2(0);
  std::vector<GrainCount> counts;
  for (const int difference : {-1, 1}) counts.push_back({difference, (as_given - chi2(difference)) / 2});
  std::sort(counts.begin(), counts.end(),
            [](const GrainCount& a, const GrainCount& b) { return a.log_odds > b.log_odds; });
  return counts;
}

int miscount_in_question(const std::vector<GrainCount>& counts, const MomentumAudit& audit) {
  if (counts.empty() || audit.unlisted) return 0;
  const bool as_probable = std::log(miscounted) + counts.front().log_odds >= std::max(0.0, audit.log_odds);
  return as_probable ? counts.front().difference : 0;
}

}  // namespace shakedown
