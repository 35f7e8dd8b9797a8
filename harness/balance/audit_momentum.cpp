// SPDX-License-Identifier: MIT
#include "momentum.hpp"

#include <algorithm>
#include <cmath>

#include "linear_audit.hpp"
#include "nuisance.hpp"
#include "scale_errors.hpp"

namespace shakedown {

namespace {

/// Relative change of the spring's frequency beyond which forces that the stiffness scales (an origin) are
/// worked out with the one found; 1 % makes 2 % of them.
constexpr double far_off = 0.01;

/// Returns what the runs are read with next: the nuisances found, and a frequency that lies far from the
/// setup's.
NuisanceValues values_of(const MomentumAudit& audit, double frequency) {
  NuisanceValues values;
  if (audit.frequency > 0 && std::abs(audit.frequency / frequency - 1) > far_off)
    values["spring.frequency"] = audit.frequency - frequency;
  for (const NuisanceFound& nuisance : audit.nuisances)
    if (std::isfinite(nuisance.value)) values[nuisance.name] = nuisance.value;
  return values;
}

/// Tells whether the frequency, or a nuisance by more than a part of its error, moved from what the runs were
/// read with.
bool has_moved(const MomentumAudit& audit, const NuisanceValues& read_with, double frequency) {
  constexpr double part = 0.3;
  const auto stated = read_with.find("spring.frequency");
  const double read_at = frequency + (stated == read_with.end() ? 0 : stated->second);
  // Frames too far apart may give a stiffness that is none, and no frequency.
  if (audit.frequency > 0 && std::abs(audit.frequency / read_at - 1) > far_off) return true;
  return std::any_of(audit.nuisances.begin(), audit.nuisances.end(), [&](const NuisanceFound& n) {
    const auto before = read_with.find(n.name);
    return std::abs(n.value - (before == read_with.end() ? 0 : before->second)) > part * n.error;
  });
}

}  // namespace

ModelTest MomentumAudit::test_of(const BalanceFit& fit) const {
  return {fit.p_value, fit.chi2_per_degree(), possible ? "" : why_not};
}

MomentumAudit audit_momentum(const Measurement& measurement, KnownEffects known,
                             const MomentumOptions& options) {
  constexpr int most_rounds = 3;
  MomentumOptions on_the_way = options;
  on_the_way.formulas = false;
  if (const auto wander = known_wander(measurement); wander && !on_the_way.wander)
    on_the_way.wander = Wander{wander->deviation, wander->time};
  const bool wander_known = on_the_way.wander.has_value();
  const MomentumAudit first = linear_audit(measurement, known, on_the_way, {});
  if (!first.possible) return first;
  on_the_way.wander = first.wander;
  const double frequency = measurement.runs.front().setup.spring.frequency;
  NuisanceValues already;
  MomentumAudit audit = first;
  for (int round = 1; round < most_rounds && has_moved(audit, already, frequency); ++round) {
    already = values_of(audit, frequency);
    audit = linear_audit(read_with(measurement, already, known), known, on_the_way, already);
  }
  // What is not linear in the camera looks like a wander, which is chosen again where the camera has moved.
  MomentumOptions last = options;
  if (already.empty() || wander_known) last.wander = first.wander;
  if (!already.empty() || options.formulas)
    audit = linear_audit(read_with(measurement, already, known), known, last, already);
  // The setup as it is, is judged with the camera as it is.
  audit.as_given = first.as_given;
  audit.refitted = first.refitted;
  audit.rest_as_given = first.rest_as_given;
  for (std::size_t run = 0; run < audit.runs.size() && run < first.runs.size(); ++run) {
    const BalanceFit final_fit = audit.runs[run].final_fit;
    audit.runs[run] = first.runs[run];
    audit.runs[run].final_fit = final_fit;
  }
  allow_for_scales(read_with(measurement, already, known), known, already, options, audit);
  return audit;
}

}  // namespace shakedown
