// SPDX-License-Identifier: MIT
#include "waveform_sets.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "least_squares.hpp"
#include "rules.hpp"

namespace shakedown {

namespace {

void sort_by_odds(std::vector<WaveformSet>& sets) {
  std::stable_sort(sets.begin(), sets.end(),
                   [](const WaveformSet& a, const WaveformSet& b) { return a.log_odds > b.log_odds; });
}

}  // namespace

double log_odds_of_one_more(double laws_in_question) {
  return std::log(rules::expected_effects / laws_in_question) - 3;
}

double WaveformSets::log_odds_of(const WaveformFit& fit) const {
  if (!fit.possible) return -std::numeric_limits<double>::infinity();
  return log_prior_odds(fit, laws_in_question_, fit.frequency()) - fit.chi2 / 2;
}

std::vector<WaveformSet> WaveformSets::within(const WaveformFit& whole) const {
  const std::size_t n = whole.laws.size();
  struct Guess {
    unsigned set;
    double chi2;
  };
  std::vector<Guess> guesses;
  for (unsigned set = 0; set < 1u << n; ++set)
    if (const double rise = dropped(whole, set); std::isfinite(rise))
      guesses.push_back({set, whole.chi2 + rise});
  const double each = log_odds_of_one_more(laws_in_question_);
  const auto merit = [&](const Guess& g) {
    return -g.chi2 / 2 + each * static_cast<double>(std::popcount(g.set));
  };
  std::stable_sort(guesses.begin(), guesses.end(),
                   [&](const Guess& a, const Guess& b) { return merit(a) > merit(b); });
  constexpr std::size_t most_kept = 8, most_fitted = 24;
  constexpr double in_question = 30;  // ln odds; the second order is wrong by as much
  std::vector<WaveformSet> sets;
  double first = 0;  // merit of the first set that is possible
  for (std::size_t i = 0; i < std::min(guesses.size(), most_fitted) && sets.size() < most_kept; ++i) {
    if (!sets.empty() && merit(guesses[i]) < first - in_question) break;
    WaveformFit fit = part_of(whole, guesses[i].set);
    const double odds = log_odds_of(fit);
    if (!std::isfinite(odds)) continue;
    if (sets.empty()) first = merit(guesses[i]);
    sets.push_back({std::move(fit), odds});
  }
  for (const WaveformFit& few : few_) add_with_extras(few, whole, sets);
  sort_by_odds(sets);
  without_the_needless(sets);
  return sets;
}
void WaveformSets::add_with_extras(const WaveformFit& few, const WaveformFit& whole,
                                   std::vector<WaveformSet>& sets) const {
  WaveformFit both = few;
  std::vector<double> value(few.value.begin(), few.value.end());
  for (std::size_t i = 0; i < whole.laws.size(); ++i) {
    const WaveformLaw& law = whole.laws[i];
    if ((law.term.never_negative && !law.term.inverse && !law.is_mode) ||
        std::find(both.laws.begin(), both.laws.end(), law) != both.laws.end())
      continue;
    both.laws.push_back(law);
    if (says_it_twice(both, both.laws.size() - 1)) {
      both.laws.pop_back();
      continue;
    }
    for (Eigen::Index k = 0; k < law.width(); ++k) value.push_back(whole.value[whole.first_of(i) + k]);
  }
  WaveformFit fit =
      fit_waveform(runs_, both.laws, Eigen::Map<Eigen::VectorXd>(value.data(), std::ssize(value)), options_);
  keep(std::move(fit), sets);
}

void WaveformSets::keep(WaveformFit fit, std::vector<WaveformSet>& sets) const {
  const double odds = log_odds_of(fit);
  if (!std::isfinite(odds)) return;
  const auto same = std::find_if(sets.begin(), sets.end(), [&](const WaveformSet& set) {
    return set.fit.laws.size() == fit.laws.size() &&
           std::is_permutation(set.fit.laws.begin(), set.fit.laws.end(), fit.laws.begin());
  });
  if (same == sets.end())
    sets.push_back({std::move(fit), odds});
  else if (odds > same->log_odds)
    *same = {std::move(fit), odds};
}

void WaveformSets::without_the_needless(std::vector<WaveformSet>& sets) const {
  for (std::size_t laws = SIZE_MAX; !sets.empty() && sets.front().fit.laws.size() < laws;) {
    const WaveformFit best = sets.front().fit;
    laws = best.laws.size();
    const unsigned all = (1u << laws) - 1;
    for (std::size_t i = 0; i < laws; ++i) keep(part_of(best, all & ~(1u << i)), sets);
    sort_by_odds(sets);
  }
}

double WaveformSets::dropped(const WaveformFit& whole, unsigned set) const {
  std::vector<Eigen::Index> out;
  WaveformFit kept;
  for (std::size_t i = 0; i < whole.laws.size(); ++i) {
    if ((set >> i & 1) != 0) {
      kept.laws.push_back(whole.laws[i]);
      if (says_it_twice(kept, kept.laws.size() - 1)) return INFINITY;
      continue;
    }
    const Eigen::Index width = std::min<Eigen::Index>(2, whole.laws[i].width());
    for (Eigen::Index k = 0; k < width; ++k) out.push_back(whole.first_of(i) + k);
  }
  Eigen::VectorXd value = whole.value;
  double rise = 0;
  if (!out.empty()) {
    const Eigen::VectorXd gone = whole.value(out);
    const Eigen::MatrixXd covariance = whole.covariance(out, out);
    const Eigen::VectorXd pull = shortest_coefficients(covariance, gone);
    rise = gone.dot(pull);
    value -= whole.covariance(Eigen::all, out) * pull;
  }
  for (std::size_t i = 0; i < whole.laws.size(); ++i)
    if ((set >> i & 1) != 0 && whole.laws[i].term.never_negative && !whole.laws[i].is_mode &&
        value[whole.first_of(i)] <= -std::sqrt(whole.covariance(whole.first_of(i), whole.first_of(i))))
      return INFINITY;
  return rise;
}
WaveformFit WaveformSets::part_of(const WaveformFit& whole, unsigned set, int evaluations) const {
  std::vector<WaveformLaw> laws;
  std::vector<Eigen::Index> kept;
  const Eigen::Index of_runs = 3 * std::ssize(runs_);
  for (Eigen::Index k = 0; k <= of_runs; ++k) kept.push_back(k);
  for (std::size_t i = 0; i < whole.laws.size(); ++i)
    if ((set >> i & 1) != 0) {
      laws.push_back(whole.laws[i]);
      for (Eigen::Index k = 0; k < laws.back().width(); ++k) kept.push_back(whole.first_of(i) + k);
    }
  WaveformOptions few = options_;
  few.evaluations = evaluations;
  WaveformFit fit = fit_waveform(runs_, laws, whole.value(kept), few);
  return fit;
}

std::vector<double> WaveformSets::gains_of(const WaveformFit& fit) const {
  std::vector<double> gains;
  const unsigned all = (1u << fit.laws.size()) - 1;
  for (std::size_t i = 0; i < fit.laws.size(); ++i)
    gains.push_back(part_of(fit, all & ~(1u << i), 10).chi2 - fit.chi2);
  return gains;
}

}  // namespace shakedown
