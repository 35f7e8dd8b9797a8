// SPDX-License-Identifier: MIT
#include "scale_errors.hpp"

#include <algorithm>
#include <cmath>

#include "distributions.hpp"
#include "nuisance.hpp"

namespace shakedown {

namespace {

/// Describes something that multiplies the balance, with its standard deviation, SI.
struct CommonFactor {
  std::string key;
  double deviation = 0, step = 0;  ///< step: by which it is moved to see what that does
};

std::vector<CommonFactor> factors_of(const Measurement& measurement, KnownEffects known) {
  constexpr double small = 0.01;  // relative
  std::vector<CommonFactor> list;
  for (const CameraNuisance& camera : camera_nuisances(measurement, known))
    if (scales_all_lengths(known, camera.key)) list.push_back({camera.key, camera.deviation(), small});
  const bool empty = std::all_of(measurement.runs.begin(), measurement.runs.end(),
                                 [](const Measurement::Run& run) { return run.setup.grains.count == 0; });
  if (const ValueWithError mass = known_mass(measurement, "box.mass"); empty && mass.error > 0)
    list.push_back({"box.mass", mass.error, small * mass.value});
  return list;
}

bool is_same(const MomentumTerm& term, const FoundTerm& found) { return term.key() == found.key(); }

/// Returns the values of the terms found, fitted once more to this measurement; empty where one has no
/// column.
std::vector<double> nuisance_values(const Measurement& measurement, KnownEffects known,
                                    const NuisanceValues& already, const MomentumOptions& options,
                                    const MomentumAudit& audit) {
  std::vector<std::string> only;
  for (const FoundTerm& found : audit.terms) only.push_back(found.effect);
  const BalanceProblem balance(measurement, known, already, only);
  const double window = options.window_periods / balance.frequency();
  SelectionProblem p = balance.windows_of(window, window * options.hop);
  if (audit.only_moving) p.problem.keep_moving(30 * balance.noise());
  p.problem.set_wander(audit.wander);
  p.problem.set_covariance({});
  std::vector<ChosenTerm> chosen{{0, 0}};
  for (const FoundTerm& found : audit.terms) {
    int which = -1;
    for (int term = 1; p.is_known(term) && found.frequency == 0; ++term)
      if (which < 0 && is_same(p.known[static_cast<std::size_t>(term)], found)) which = term;
    if (which < 0 && found.frequency == 0) return {};
    chosen.push_back({which, found.frequency});
  }
  const Regression fit = regress(p.problem.impulse(), columns_of(p, chosen));
  std::vector<double> values;
  Eigen::Index column = 1;
  for (std::size_t i = 1; i < chosen.size(); ++i) {
    values.push_back(chosen[i].term < 0 ? fit.strength.segment(column, 2).norm()
                                        : p.known[static_cast<std::size_t>(chosen[i].term)].parameter_at(
                                              fit.strength[column]));
    column += width_of(chosen[i]);
  }
  return values;
}

}  // namespace

void allow_for_scales(const Measurement& measurement, KnownEffects known, const NuisanceValues& already,
                      const MomentumOptions& options, MomentumAudit& audit) {
  if (audit.terms.empty() || audit.unlisted) return;
  const std::vector<CommonFactor> factors = factors_of(measurement, known);
  if (factors.empty()) return;
  const std::vector<double> here = nuisance_values(measurement, known, already, options, audit);
  if (here.empty()) return;
  for (const CommonFactor& factor : factors) {
    const std::vector<double> moved = nuisance_values(
        read_with(measurement, {{factor.key, factor.step}}, known), known, already, options, audit);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      // The change is taken in parts of the value: the fit here may differ a little from the one that was
      // told.
      FoundTerm& term = audit.terms[i];
      const double change = here[i] != 0 ? term.value * (moved[i] - here[i]) / here[i] : 0;
      const double wide = normal_95 * std::abs(change) * factor.deviation / factor.step;
      term.low = term.value - std::hypot(term.value - term.low, wide);
      term.high = term.value + std::hypot(term.high - term.value, wide);
    }
  }
}

}  // namespace shakedown
