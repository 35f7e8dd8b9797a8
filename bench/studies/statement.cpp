// SPDX-License-Identifier: MIT
#include "statement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace shakedown {

namespace {

/// Two-sided 95 % point of Student's distribution.
double student(int degrees) {
  constexpr std::array<double, 10> small{12.706, 4.303, 3.182, 2.776, 2.571,
                                         2.447,  2.365, 2.306, 2.262, 2.228};
  if (degrees <= 10) return small[static_cast<std::size_t>(degrees - 1)];
  return 1.96 + 2.37 / degrees + 2.8 / (degrees * degrees);  // within 0.001
}

}  // namespace

std::string_view name_of(Judgement judgement) {
  return judgement == Judgement::holds ? "holds" : judgement == Judgement::fails ? "fails" : "cannot be told";
}

Finding finding_of(std::string what, const Statistic& statistic, std::string unit, double factor) {
  const double mean = factor * statistic.mean;
  const double half =
      statistic.n < 2 ? std::nan("")
                      : student(statistic.n - 1) * std::abs(factor) * statistic.sd / std::sqrt(statistic.n);
  return {std::move(what), mean, mean - half, mean + half, std::move(unit)};
}

Finding exact(std::string what, double value, std::string unit) {
  return {std::move(what), value, value, value, std::move(unit)};
}

Judgement judge(const Finding& finding, double low, double high) {
  if (std::isnan(finding.value)) return Judgement::cannot_tell;
  const double from = std::isnan(finding.low) ? finding.value : finding.low,
               to = std::isnan(finding.high) ? finding.value : finding.high;
  if (from >= low && to <= high) return Judgement::holds;
  return to < low || from > high ? Judgement::fails : Judgement::cannot_tell;
}

Judgement all_of(const std::vector<Judgement>& judgements) {
  const auto has = [&](Judgement wanted) {
    return std::find(judgements.begin(), judgements.end(), wanted) != judgements.end();
  };
  return has(Judgement::fails)                               ? Judgement::fails
         : has(Judgement::cannot_tell) || judgements.empty() ? Judgement::cannot_tell
                                                             : Judgement::holds;
}

}  // namespace shakedown
