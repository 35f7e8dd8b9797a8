// SPDX-License-Identifier: MIT
#include "sets_weighed.hpp"

#include <algorithm>
#include <cmath>

#include "shape_found.hpp"
#include "wander_choice.hpp"

namespace shakedown {

namespace {

constexpr Eigen::Index least_windows = 20;
/// Standard deviations of the camera's noise by which a box must move to be judged where a dry friction acts:
/// one that sticks obeys no sgn v.
constexpr double moves = 30;

class SetSearch {
 public:
  SetSearch(const BalanceProblem& balance, const MomentumOptions& options)
      : balance_(balance),
        options_(options),
        window_(options.window_periods / balance.frequency()),
        found_{balance.windows_of(window_, window_ * options.hop), {}, false} {}

  std::optional<SetsWeighed> run() {
    if (found_.problem.problem.windows() <= least_windows) return {};
    if (std::any_of(balance_.runs().begin(), balance_.runs().end(),
                    [](const MomentumRun& run) { return run.dry_friction; }))
      keep_moving();
    take_wander();
    weigh();
    if (!found_.only_moving && acts_dry() && keep_moving()) {
      take_wander();
      weigh();
    }
    weigh_beside_what_acts();
    if (find_shapes(found_.problem, acting())) weigh();
    look_for_fast_sines();
    return std::move(found_);
  }

 private:
  const std::vector<ChosenTerm>& acting() const { return found_.sets.front().chosen; }

  bool acts_dry() const {
    const SelectionProblem& p = found_.problem;
    return std::any_of(acting().begin(), acting().end(), [&](const ChosenTerm& c) {
      return p.is_known(c.term) && c.term > 0 && p.known[static_cast<std::size_t>(c.term)].dry;
    });
  }

  bool keep_moving() {
    SelectionProblem moving = found_.problem;
    moving.problem.keep_moving(moves * balance_.noise());
    if (moving.problem.windows() <= least_windows) return false;
    found_.problem = std::move(moving);
    return found_.only_moving = true;
  }

  void take_wander() {
    if (!options_.wander) return choose_wander(found_.problem, balance_.noise());
    found_.problem.problem.set_wander(*options_.wander);
    found_.problem.problem.set_covariance({});
  }

  /// Weighs sets of known strengths, with up to most_sines sines.
  void weigh(std::vector<ChosenTerm> base = {{0, 0}}) {
    const SelectionProblem& p = found_.problem;
    found_.sets = compare_sets(p, base);
    for (int sines = static_cast<int>(base.size()) - 1; sines < options_.most_sines && p.typical_sine > 0;
         ++sines) {
      const SineFound sine = best_sine(p, {acting(), {}, 0}, options_.lowest_frequency,
                                       std::min(options_.highest_frequency, p.highest_frequency));
      if (sine.log_odds <= 0) break;
      base.push_back({-1, sine.frequency});
      found_.sets = compare_sets(p, base);
      sharpen(base);
    }
  }

  /// Returns ln evidence of the best set beside `base`, up to a constant.
  static double log_evidence(const SelectionProblem& p, const std::vector<ChosenTerm>& base,
                             const std::vector<BalanceHypothesis>& sets) {
    return sets.front().log_odds - regress(p.problem.impulse(), columns_of(p, base)).chi2 / 2;
  }

  /// Improves the frequency of the last sine, which was found beside the strengths that did best without it:
  /// now with all sets that may act beside it there, by steps that shrink to a fiftieth of a turn by the end
  /// of the recording.
  void sharpen(std::vector<ChosenTerm>& base) {
    const SelectionProblem& p = found_.problem;
    double most = log_evidence(p, base, found_.sets);
    const double turn = 1 / std::max(p.problem.longest(), 1.0);  // Hz
    const double from = base.back().frequency;
    const auto go = [&](double by) {
      std::vector<ChosenTerm> moved = base;
      moved.back().frequency += by;
      if (std::abs(moved.back().frequency - from) > turn) return false;  // another sine's place
      std::vector<BalanceHypothesis> sets = compare_sets(p, moved);
      const double here = log_evidence(p, moved, sets);
      if (here <= most) return false;
      most = here, base = std::move(moved), found_.sets = std::move(sets);
      return true;
    };
    for (double step = turn / 4; step > turn / 50; step /= 2)
      for (const double direction : {-1.0, 1.0})
        while (go(direction * step)) {
        }
  }

  /// Weighs wander and set beside each other: a wander takes up what it is not weighed beside (sines, more
  /// than two strengths, the noise that a force lets in). Each step makes wander and set together more
  /// probable. Where the wander stays, what a friction lets in is still to be known before sines are looked
  /// for: it looks like one.
  void weigh_beside_what_acts() {
    constexpr int most_rounds = 4;  // set and wander may go to and fro between two that are as probable
    for (int round = 0; round < most_rounds && acting().size() > 1; ++round) {
      const bool moved = !options_.wander && choose_wander_beside(found_.problem, balance_.noise(), acting());
      if (!moved && (round > 0 || !acts_dry())) return;
      if (!moved) fit_terms(found_.problem, acting());
      weigh();
    }
  }

  /// Looks for faster sines than these windows see, in shorter ones, which must still hold ten frames.
  void look_for_fast_sines() {
    constexpr double least_frames = 10;
    const double shorter = window_ / 3;
    const SelectionProblem& p = found_.problem;
    const bool enough_frames =
        std::all_of(balance_.runs().begin(), balance_.runs().end(), [&](const MomentumRun& run) {
          return run.time.size() == 0 || shorter > least_frames * run.interval;
        });
    if (!(p.typical_sine > 0) || options_.highest_frequency <= p.highest_frequency || !enough_frames) return;
    SelectionProblem fast = balance_.windows_of(shorter, shorter * options_.hop);
    if (found_.only_moving) fast.problem.keep_moving(moves * balance_.noise());
    if (fast.problem.windows() <= least_windows) return;
    fast.problem.set_wander(p.problem.wander());
    fit_terms(fast, acting());  // what these forces let in is noise of a sine
    const SineFound sine = best_sine(fast, {acting(), {}, 0}, p.highest_frequency,
                                     std::min(options_.highest_frequency, fast.highest_frequency));
    if (sine.log_odds <= 0) return;
    found_.problem = std::move(fast);
    weigh({{0, 0}, {-1, sine.frequency}});
    weigh_beside_what_acts();
  }

  const BalanceProblem& balance_;
  const MomentumOptions& options_;
  const double window_;  // s
  SetsWeighed found_;
};

}  // namespace

std::optional<SetsWeighed> weigh_sets(const BalanceProblem& balance, const MomentumOptions& options) {
  return SetSearch(balance, options).run();
}

}  // namespace shakedown
