// SPDX-License-Identifier: MIT
#include "verdict.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "distributions.hpp"
#include "rules.hpp"

namespace shakedown {

namespace {

double error_of(std::string_view observable, const std::vector<Validation>& rows) {
  double square = 0, count = 0;
  for (const Validation& row : rows)
    if (row.observable == observable) square += row.error * row.error, ++count;
  return std::sqrt(square / count);  // NaN without rows
}

}  // namespace

void compare_with_given(const std::vector<Validation>& given, const std::vector<Validation>& fitted,
                        Difference& box) {
  const double before = error_of("box", given), after = error_of("box", fitted);
  if (std::isnan(before) || std::isnan(after)) return;
  box.as_given = before, box.error = after;
}

double share_taken_away(double before, double after) {
  constexpr double own = 1;
  const double share = (before - after) / (before - own);
  return before > own && std::isfinite(share) ? share : 1;
}

Verdict verdict_of(const Findings& findings) {
  const ModelJudgement judgement = judgement_of(findings.features, findings.balance, findings.left);
  if (findings.unlisted) return Verdict::unknown;
  // What takes nearly all of the misfit away is found, though the rest may have no name.
  constexpr double nearly_all = 0.9;
  if (findings.anything_missing && (judgement.standing != Standing::fails || findings.explained > nearly_all))
    return Verdict::missing;
  if (judgement.standing == Standing::fails || !judgement.complete) return Verdict::unknown;
  if (findings.camera_stands_out) return Verdict::measurement;
  return findings.refitted ? Verdict::refit : Verdict::adequate;
}

double worst_p_value(const Findings& findings) {
  const double of_features = findings.features.misfit < findings.features.undecided_below
                                 ? std::max<double>(findings.features.p_value, rules::holds)
                                 : findings.far_p_value;
  const double of_tests =
      findings.balance.why_not.empty() ? std::min(of_features, findings.balance.p_value) : of_features;
  return std::min(of_tests, p_value_of_left(findings.left));
}

double p_value_of_left(const std::vector<Difference>& left) {
  double worst = 1;
  for (const Difference& one : left)
    if (times_floor(one) > most_left)
      worst = std::min(
          worst, chi_squared_tail(least_independent * std::pow(times_floor(one), 2), least_independent));
  return worst;
}

bool explains(double p_value, double scatter, double scatter_before, double error, double floor) {
  if (p_value > rules::holds || scatter <= 2 * rules::codes_differ) return true;
  constexpr double most = 0.6;  // of the misfit: more than half must go
  return scatter <= most * scatter_before && error <= rules::explains * floor;
}

bool no_error_falls(const std::vector<Validation>& before, const std::vector<Validation>& after) {
  const auto rises = [&](std::string_view observable) {
    return error_of(observable, after) > error_of(observable, before);  // false of what has no rows
  };
  return rises("box") && rises("centre");
}

bool adds_nothing(double p_value, const std::vector<Validation>& before,
                  const std::vector<Validation>& after) {
  return p_value <= rules::holds && no_error_falls(before, after);
}

std::vector<NuisanceFound> standing_out(const std::vector<NuisanceFound>& nuisances) {
  std::vector<NuisanceFound> found;
  for (const NuisanceFound& nuisance : nuisances)
    if (nuisance.error > 0 && std::abs(nuisance.value) > rules::stands_out * nuisance.error)
      found.push_back(nuisance);
  std::stable_sort(found.begin(), found.end(), [](const NuisanceFound& a, const NuisanceFound& b) {
    return std::abs(a.value / a.error) > std::abs(b.value / b.error);
  });
  return found;
}

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate: return "adequate";
    case Verdict::refit: return "refit";
    case Verdict::measurement: return "measurement";
    case Verdict::missing: return "missing";
    case Verdict::unknown: return "unknown";
  }
  return "";
}

}  // namespace shakedown
