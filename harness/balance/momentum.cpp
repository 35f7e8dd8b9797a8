// SPDX-License-Identifier: MIT
#include "momentum.hpp"

#include <algorithm>
#include <cmath>

#include "linear_audit.hpp"

namespace shakedown {

namespace {

NuisanceValues values_of(const MomentumAudit& audit) {
  NuisanceValues values;
  for (const NuisanceFound& nuisance : audit.nuisances) values[nuisance.name] = nuisance.value;
  return values;
}

/// Nuisances that moved by more than a part of their error from what the runs were read with.
bool has_moved(const MomentumAudit& audit, const NuisanceValues& read_with) {
  constexpr double part = 0.3;
  return std::any_of(audit.nuisances.begin(), audit.nuisances.end(), [&](const NuisanceFound& n) {
    const auto before = read_with.find(n.name);
    return std::abs(n.value - (before == read_with.end() ? 0 : before->second)) > part * n.error;
  });
}

}  // namespace

ModelTest MomentumAudit::test_of(const BalanceFit& fit) const {
  return {fit.p_value, fit.chi2_per_degree(), possible ? "" : why_not};
}

MomentumAudit audit_momentum(const Measurement& measurement, std::span<const EffectRecord* const> known,
                             const MomentumOptions& options) {
  constexpr int most_rounds = 3;
  MomentumOptions on_the_way = options;
  on_the_way.formulas = false;
  const MomentumAudit first = linear_audit(measurement, known, on_the_way, {});
  if (!first.possible) return first;
  on_the_way.wander = first.wander;
  NuisanceValues already;
  MomentumAudit audit = first;
  for (int round = 1; round < most_rounds && has_moved(audit, already); ++round) {
    already = values_of(audit);
    audit = linear_audit(read_with(measurement, already, known), known, on_the_way, already);
  }
  // What is not linear in the camera looks like a wander: it is chosen again where the camera has moved.
  MomentumOptions last = options;
  if (already.empty()) last.wander = first.wander;
  if (!already.empty() || options.formulas)
    audit = linear_audit(read_with(measurement, already, known), known, last, already);
  // What the setup says as it is, is seen with the camera as it is.
  audit.as_given = first.as_given;
  audit.refitted = first.refitted;
  audit.rest_as_given = first.rest_as_given;
  for (std::size_t run = 0; run < audit.runs.size() && run < first.runs.size(); ++run) {
    const BalanceFit final_fit = audit.runs[run].final_fit;
    audit.runs[run] = first.runs[run];
    audit.runs[run].final_fit = final_fit;
  }
  return audit;
}

}  // namespace shakedown
