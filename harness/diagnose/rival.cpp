// SPDX-License-Identifier: MIT
#include "rival.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numbers>
#include <tuple>

#include "distributions.hpp"
#include "key_unit.hpp"
#include "nuisance.hpp"
#include "rules.hpp"

namespace shakedown {

namespace {

/// Widens the box of the restitutions, which were led astray without the effect: it reaches from there to
/// what the user gave.
std::vector<Knob> covering_the_users_values(std::vector<Knob> knobs) {
  for (Knob& knob : knobs) {
    if (!is_believed(knob)) continue;
    const double apart = std::abs(knob.centre - knob.believed);
    knob.centre = (knob.centre + knob.believed) / 2;
    knob.width = apart / 2 + 0.8 * knob.believed_error;
  }
  return knobs;
}

/// Returns the knobs of a candidate at the strength that its signature asks for, where its fit begins.
std::vector<Knob> knobs_of(const Candidate& candidate, const ScreenedEffect& screened) {
  std::vector<Knob> added = candidate.fitted_knobs();
  for (Knob& knob : added) {
    if (std::isinf(knob.absent))  // a length, known by what it does
      knob.width *= screened.value / knob.centre;
    else
      knob.width = std::max(knob.width, 0.5 * std::abs(screened.value - knob.absent));
    knob.centre = std::clamp(screened.value, knob.low, knob.high);
  }
  return added;
}

/// Leaves out what is among `these`: an exact knob of the camera that the candidate itself moves is no
/// nuisance beside it.
std::vector<Knob> without(std::vector<Knob> knobs, const std::vector<Knob>& these) {
  std::erase_if(knobs, [&](const Knob& knob) {
    return std::any_of(these.begin(), these.end(), [&](const Knob& other) { return other.key == knob.key; });
  });
  return knobs;
}

std::vector<Knob> knobs_of_fit(const DiagnosisState& before, const DiagnosisState& with) {
  return together(together(covering_the_users_values(before.theta), with.found), with.camera);
}

/// Returns the fitted strength of a rival, as the prior counts it.
StrengthSeen strength_fitted(const Rival& rival) {
  StrengthSeen seen = rival.screened.seen;
  const std::vector<Knob> added = rival.candidate->fitted_knobs();
  const Refit& fit = rival.state.fit;
  for (std::size_t k = 0; k < fit.values.size(); ++k)
    for (const Knob& knob : added)
      if (fit.values[k].key == knob.key && rival.candidate->knobs.size() > 0) {
        std::tie(seen.value, seen.error) = strength_of(fit, k);
        if (seen.one_sided) seen.value = std::abs(seen.value);
      }
  return seen;
}

/// Returns what a fit leaves of each run's features, m.
std::vector<Eigen::VectorXd> left_by(const Refit& fit) {
  std::vector<Eigen::VectorXd> left;
  for (const RunComparison& run : fit.runs) left.push_back(run.residual);
  return left;
}

/// Returns chi2 of the same, in the metric of these covariances of each run.
double chi2_of(const std::vector<Eigen::VectorXd>& left, const std::vector<Eigen::MatrixXd>& covariances) {
  double sum = 0;
  for (std::size_t r = 0; r < left.size(); ++r)
    sum += Eigen::LLT<Eigen::MatrixXd>(covariances[r]).matrixL().solve(left[r]).squaredNorm();
  return sum;
}

double log_determinant(const std::vector<Eigen::MatrixXd>& covariances) {
  double sum = 0;
  for (const Eigen::MatrixXd& covariance : covariances)
    sum += 2 * Eigen::LLT<Eigen::MatrixXd>(covariance).matrixLLT().diagonal().array().log().sum();
  return sum;
}

/// Returns by how much the deviance of a short fit may be too high where the effect is there.
double short_fit_errs(const Rival& rival) { return (effort::short_fits_err - 1) * rival.short_own_chi2; }

/// Tells whether the data accept its short fit and, where it was made, its longer one.
bool may_hold(const Rival& rival) { return rival.short_holds && (!rival.attempted || holds(rival)); }

bool some_may_hold(const std::vector<Rival>& rivals) {
  return std::any_of(rivals.begin(), rivals.end(), may_hold);
}

/// Returns the factor by which a difference of ln odds that is known to within `error` shrinks when its odds
/// are averaged over what it may be (D. J. C. MacKay, Neural Computation 4, 720 (1992)).
double averaged_over(double error) { return 1 / std::sqrt(1 + std::numbers::pi / 8 * error * error); }

}  // namespace

bool is_arithmetic(const Rival& rival) { return rival.candidate->fitted_knobs().front().exact; }

bool is_found(const Rival& rival) { return rival.fitted && rival.log_odds > 0; }

bool holds(const Rival& rival) { return rival.fitted && rival.state.fit.p_value > rules::holds; }

bool is_weighed_by_left(const Rival& rival) {
  return rival.fitted && rival.weighed_by_left && !std::isfinite(rival.log_ratio);
}

Effort affordable(const Rival& rival, Effort usual, double left) {
  const double needed = rival.short_share * simulations_of(usual) / simulations_of(effort::least);
  return needed > left ? effort::attempt_when_dear : usual;  // NaN: no short fit says
}

double signatures_err_by(double best) {
  return std::max(std::log(10), effort::signature_errs * std::abs(best));
}

std::vector<Knob> at_values(const Refit& fit) {
  std::vector<Knob> knobs = fit.knobs;
  for (std::size_t k = 0; k < knobs.size(); ++k)
    if (!knobs[k].exact) knobs[k].centre = fit.values[k].value;
  return knobs;
}

DiagnosisState with_rival(const DiagnosisState& before, const Rival& rival, DiagnosisTools& tools) {
  const Candidate& candidate = *rival.candidate;
  DiagnosisState state = before;
  state.setup = prepared(before.setup, candidate, tools.known());
  const std::vector<Knob> added = knobs_of(candidate, rival.screened);
  // At no strength the effect would be forgotten with what its presence needs besides: the range of an
  // attraction, and whether the walls attract.
  for (const Knob& knob : added)
    if (!knob.exact) set_knob(state.setup, knob, tools.known());
  state.found = together(before.found, added);
  state.camera = without(before.camera, added);
  state.dear = before.dear || candidate.dear;
  // Runs with the effect have another spread, by which a scatter is told.
  state.scatter_at_start = std::numeric_limits<double>::infinity();
  if (std::find(state.missing.begin(), state.missing.end(), candidate.effect) == state.missing.end())
    state.missing.push_back(candidate.effect);  // else it is one more component
  return state;
}

void fit_shortly(Rival& rival, const DiagnosisState& before, DiagnosisTools& tools) {
  DiagnosisState state = with_rival(before, rival, tools);
  const double spent = tools.share_spent();
  rival.chi2_without = before.fit.own_chi2;  // by which the short fit is judged
  state.fit = tools.fit(state, "looking at " + rival.candidate->effect, knobs_of_fit(before, state),
                        effort::least, &before.fit);
  rival.short_chi2 = state.fit.judged_chi2;
  rival.short_left = left_by(state.fit);
  rival.short_own_chi2 = chi2_of(rival.short_left, state.fit.covariances);
  rival.short_deviance = rival.short_own_chi2 + log_determinant(state.fit.covariances);
  rival.short_holds = state.fit.p_value > rules::holds;
  rival.short_share = tools.share_spent() - spent;
  rival.held_out_gain = before.fit.judged_held_out_chi2 - state.fit.judged_held_out_chi2;
  rival.shortly = std::move(state);
}

bool take_short_fit(const std::vector<Rival>& rivals, Rival& rival) {
  if (!rival.shortly || !is_alone_in_question(rivals, rival)) return false;
  rival.state = std::move(*rival.shortly);
  rival.shortly.reset();
  rival.fitted = rival.weighed_by_left = true;
  return true;
}

void fit_rival(Rival& rival, const DiagnosisState& before, DiagnosisTools& tools, EffectScreen& screen,
               double lowest, Effort effort) {
  const Candidate& candidate = *rival.candidate;
  DiagnosisState& state = rival.state = with_rival(before, rival, tools);
  const std::vector<Knob> knobs = knobs_of_fit(before, state);
  const std::string stage = "trying " + candidate.effect;
  state.fit = tools.fit(state, stage, knobs, effort, &before.fit, lowest);
  rival.fitted = true;
  rival.held_out_gain = before.fit.judged_held_out_chi2 - state.fit.judged_held_out_chi2;
  if (is_arithmetic(rival)) return;
  const ScreenEffort& weighing = state.dear ? effort::rank_when_dear : effort::rank;
  try {
    rival.log_ratio =
        screen.log_likelihood_ratio(tools.features(state.setup), at_values(state.fit), weighing.nothing);
  } catch (const BudgetSpent&) {
    // The signature's evidence stands, except where the model without is so far off that it says little.
    rival.weighed_by_left = std::isfinite(rival.chi2_without);
  }
}

/// The table is of what the signatures say, and of fitted models where they were weighed. The chi2 of two
/// fits differ by chaos alone as much as effects that matter do.
void weigh_rival(Rival& rival, double candidates) {
  rival.weighed = rival.fitted || rival.screened.weighed;
  const StrengthSeen& seen = rival.screened.seen;
  rival.log_odds = prior_log_odds(seen.odds, candidates);
  if (rival.screened.weighed) rival.log_odds += rival.screened.log_evidence - rival.nothing_gained;
  // A short fit is made where the model without is so far off that signatures say little.
  const bool shortly = is_weighed_by_left(rival);
  if (!shortly && !std::isfinite(rival.log_ratio)) return;
  StrengthSeen fitted = strength_fitted(rival);
  fitted.gain = shortly ? rival.chi2_without - rival.state.fit.judged_chi2
                        : 2 * (rival.log_ratio - rival.nothing_gained);
  rival.log_odds = log_odds_of(fitted, candidates);
}

void weigh_beside_the_best(std::vector<Rival>& rivals, double candidates) {
  const auto counts = [](const Rival& rival) {
    return is_found(rival) && (std::isfinite(rival.log_ratio) || is_weighed_by_left(rival)) && holds(rival);
  };
  const Rival* best = nullptr;
  for (const Rival& rival : rivals)
    if (counts(rival) && (best == nullptr || rival.log_odds > best->log_odds)) best = &rival;
  if (best == nullptr) return;
  const std::vector<Eigen::MatrixXd>& covariances = best->state.fit.covariances;
  const auto prior = [&](const Rival& rival) { return prior_log_odds(rival.screened.seen.odds, candidates); };
  const double of_fits = averaged_over(rules::emulator_noise / 2),
               of_best = chi2_of(left_by(best->state.fit), covariances), from = best->log_odds - prior(*best),
               signature = best->screened.log_evidence;
  // Signatures err at least by what the best one's fit shows that its own was wrong by.
  const double gained = is_weighed_by_left(*best) ? (best->chi2_without - best->state.fit.judged_chi2) / 2
                                                  : best->log_ratio,
               of_signatures =
                   averaged_over(std::max(signatures_err_by(signature), std::abs(gained - signature)));
  const auto beside_the_best = [&](const Rival& rival, double chi2, double factor) {
    return from + prior(rival) + factor * (of_best - chi2) / 2;
  };
  for (Rival& rival : rivals) {
    if (&rival == best) continue;
    if (rival.fitted && !is_arithmetic(rival)) {
      const double weighed = beside_the_best(rival, chi2_of(left_by(rival.state.fit), covariances), of_fits);
      // A fit that the data reject gets no credit for its gain.
      rival.log_odds =
          counts(rival) || is_weighed_by_left(rival) ? weighed : std::min(rival.log_odds, weighed);
    } else if (!rival.fitted && !rival.short_left.empty()) {
      const double left = chi2_of(rival.short_left, covariances), err = effort::short_fits_differ * left / 2;
      rival.log_odds =
          beside_the_best(rival, left, averaged_over(std::hypot(err, rules::emulator_noise / 2)));
    } else if (!rival.fitted && rival.screened.weighed && best->screened.weighed && !is_arithmetic(rival)) {
      rival.log_odds = from + prior(rival) + of_signatures * (rival.screened.log_evidence - signature);
    }
  }
}

std::vector<Rival*> in_question(std::vector<Rival>& rivals) {
  const bool only_those_that_may_hold = some_may_hold(rivals);
  std::vector<Rival*> list;
  for (Rival& rival : rivals)
    if (std::isfinite(rival.short_deviance) &&
        (only_those_that_may_hold ? may_hold(rival) : !rival.short_holds))
      list.push_back(&rival);
  const auto best = std::min_element(list.begin(), list.end(), [](const Rival* a, const Rival* b) {
    return a->short_deviance < b->short_deviance;
  });
  if (best == list.end()) return list;
  const double as_likely = (*best)->short_deviance + short_fit_errs(**best);
  std::erase_if(list,
                [&](const Rival* rival) { return rival->attempted || rival->short_deviance > as_likely; });
  std::stable_sort(list.begin(), list.end(),
                   [](const Rival* a, const Rival* b) { return a->log_odds > b->log_odds; });
  return list;
}

bool is_alone_in_question(const std::vector<Rival>& rivals, const Rival& one) {
  const bool only_those_that_may_hold = some_may_hold(rivals);
  if (only_those_that_may_hold && !may_hold(one)) return false;
  const double as_likely = one.short_deviance + short_fit_errs(one);
  return effort::short_fits_err * one.short_chi2 < one.chi2_without &&
         std::none_of(rivals.begin(), rivals.end(), [&](const Rival& rival) {
           return rival.candidate->effect != one.candidate->effect &&
                  (only_those_that_may_hold ? may_hold(rival) : !rival.short_holds) &&
                  rival.short_deviance <= as_likely;
         });
}

Rival* first_to_fit(const std::vector<Rival*>& by_odds) {
  if (by_odds.empty()) return nullptr;
  Rival* first = by_odds.front();
  if (is_arithmetic(*first)) return first;
  const double as_good = first->log_odds - signatures_err_by(first->log_odds);
  for (Rival* rival : by_odds)
    if (!is_arithmetic(*rival) && rival->log_odds >= as_good &&
        rival->screened.seen.odds > first->screened.seen.odds)
      first = rival;
  return first;
}

double probability_among(const std::vector<Rival>& rivals, const Rival& one) {
  std::vector<Hypothesis> table{{{}, 0, 0}};
  for (const Rival& rival : rivals)
    if (std::isfinite(rival.log_odds)) table.push_back({{rival.candidate->effect}, rival.log_odds, 0});
  weigh(table);
  double sum = 0;
  for (const Hypothesis& h : table)
    if (h.effects == std::vector<std::string>{one.candidate->effect}) sum += h.probability;
  return sum;
}

PromisedEffect promised_by(const Rival& rival, const DiagnoseOptions& options) {
  const Candidate& candidate = *rival.candidate;
  PromisedEffect promised{candidate.effect, candidate.fixed, {}};
  const double strength = candidate.strength_of(rival.screened.value),
               relative = options.strength_uncertainty ? options.strength_uncertainty(candidate.effect) : 0,
               half = normal_95 * std::hypot(rival.screened.seen.error, relative * strength);
  const auto [low, high] =
      std::minmax({candidate.value_of(strength - half), candidate.value_of(strength + half)});
  for (const std::string& key : joined_keys(candidate.fitted_knobs().front().key))
    promised.strengths.push_back(
        {key, rival.screened.value, low, high, si_unit_of_key(key, options.known), ""});
  return promised;
}

RankedEffect ranked_as(const Rival& rival) {
  RankedEffect ranked{rival.candidate->effect, rival.screened.gain,       std::nan(""), std::nan(""),
                      rival.screened.value,    rival.screened.look_alikes};
  if (!rival.fitted) return ranked;
  ranked.fitted = true;
  if (std::isfinite(rival.log_ratio)) ranked.gain = 2 * (rival.log_ratio - rival.nothing_gained);
  if (is_weighed_by_left(rival)) ranked.gain = rival.chi2_without - rival.state.fit.judged_chi2;
  ranked.held_out_gain = rival.held_out_gain;
  // This is the error of a difference of two chi2 of nested models.
  ranked.standard_error = 2 * std::sqrt(std::abs(rival.held_out_gain));
  for (const FittedValue& value : rival.state.fit.values)
    for (const Knob& knob : rival.candidate->fitted_knobs())
      if (value.key == knob.key) ranked.value = value.value;
  return ranked;
}

}  // namespace shakedown
