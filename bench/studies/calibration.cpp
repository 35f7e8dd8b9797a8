// SPDX-License-Identifier: MIT
#include "calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "distributions.hpp"
#include "effects.hpp"
#include "key_unit.hpp"

namespace shakedown {

namespace {

using Kept = BlindFigure::Verdict;

struct Mean {
  double sum = 0;
  int number = 0;
  void add(double value) { sum += value, ++number; }
  double value() const { return sum / number; }
};

void row_of_scores(const std::string& what, const Mean& mean, ScoreTable& table) {
  table.plain(what, "-",
              mean.number == 0 ? "no such case" : fmt::format("{:.2f} ({} cases)", mean.value(), mean.number),
              Kept::not_measured);
}

/// Tells whether a case is judged by probabilities: answers of a program that tells none are not.
bool tells_probabilities(const OpenedCase& one) { return one.lost || !one.hypotheses.empty(); }

}  // namespace

double log_score(const OpenedCase& one) {
  constexpr double least = 1e-3;
  return -std::log(std::max(one.lost ? 0 : one.probability_of_truth(), least));
}

void log_scores(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  Mean all;
  std::array<Mean, blind_kind_names.size()> by_kind;
  for (const OpenedCase& one : cases) {
    if (!tells_probabilities(one)) continue;
    all.add(log_score(one));
    by_kind[static_cast<std::size_t>(one.kind)].add(log_score(one));
  }
  row_of_scores("mean log score, 0 is perfect", all, table);
  for (std::size_t kind = 0; kind < by_kind.size(); ++kind)
    if (by_kind[kind].number > 0)
      row_of_scores(fmt::format("mean log score of {}", blind_kind_names[kind]), by_kind[kind], table);
}

void reliability(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  constexpr std::array<double, 5> bounds{0, 0.5, 0.8, 0.95, 1.01};
  for (std::size_t row = 0; row + 1 < bounds.size(); ++row) {
    Mean said;
    Count right;
    for (const OpenedCase& one : cases) {
      if (one.hypotheses.empty()) continue;
      const double probability = one.hypotheses.front().probability;
      if (probability < bounds[row] || probability >= bounds[row + 1]) continue;
      said.add(probability);
      right.add(one.most_probable_is_right());
    }
    if (right.trials == 0) continue;
    const Share share = share_of(right.hits, right.trials);
    table.plain(fmt::format("reliability: first answers with probability {:.2f} to {:.2f} are right",
                            bounds[row], std::min(bounds[row + 1], 1.0)),
                fmt::format("{:.0f} %", 100 * said.value()), in_words(share),
                share.low <= said.value() && said.value() <= share.high ? Kept::met : Kept::missed);
  }
}

double deviations_from_middle(const FoundInterval& interval, double truth) {
  const double half = 0.5 * (interval.high - interval.low);
  if (!(half > 0)) return truth == interval.low ? 0 : std::numeric_limits<double>::infinity();
  return std::abs(truth - (interval.low + half)) / half * normal_95;
}

double truth_beside(const std::string& key, double truth, const FoundInterval& interval) {
  if (unit_of_key(key, all_effects()) != "rad") return truth;
  constexpr double turn = 2 * std::numbers::pi;
  return truth + turn * std::round((0.5 * (interval.low + interval.high) - truth) / turn);
}

void coverage_by_quantile(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  constexpr std::array<std::pair<double, double>, 4> quantiles{
      {{0.5, 0.674}, {0.8, 1.282}, {0.95, normal_95}, {0.99, 2.576}}};
  for (const auto& [expected, deviations] : quantiles) {
    Count within;
    for (const OpenedCase& one : cases) {
      if (!one.exact()) continue;
      for (const auto& [key, truth] : one.strengths)
        if (const auto found = one.found.find(key); found != one.found.end())
          within.add(deviations_from_middle(found->second, truth_beside(key, truth, found->second)) <=
                     deviations);
    }
    const Share share = share_of(within.hits, within.trials);
    table.plain(
        fmt::format("coverage: strengths within the central {:.0f} % (named exactly)", 100 * expected),
        fmt::format("{:.0f} %", 100 * expected), within.trials == 0 ? "no such case" : in_words(share),
        within.trials < 20                                ? Kept::not_measured
        : share.low <= expected && expected <= share.high ? Kept::met
                                                          : Kept::missed);
  }
}

}  // namespace shakedown
