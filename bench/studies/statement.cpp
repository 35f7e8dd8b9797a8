// SPDX-License-Identifier: MIT
#include "statement.hpp"

#include <algorithm>
#include <cmath>

#include "distributions.hpp"

namespace shakedown {

std::string_view name_of(Judgement judgement) {
  return judgement == Judgement::holds ? "holds" : judgement == Judgement::fails ? "fails" : "cannot be told";
}

Finding finding_of(std::string what, const Statistic& statistic, std::string unit, double factor) {
  const double mean = factor * statistic.mean;
  const double half = statistic.n < 2 ? std::nan("")
                                      : student_95(statistic.n - 1) * std::abs(factor) * statistic.sd /
                                            std::sqrt(statistic.n);
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
