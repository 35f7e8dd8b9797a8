// SPDX-License-Identifier: MIT
#include "state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "camera_features.hpp"
#include "errors.hpp"
#include "in_order.hpp"
#include "refit.hpp"
#include "refit_options.hpp"
#include "rules.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"

namespace shakedown {

std::vector<Knob> together(std::vector<Knob> a, const std::vector<Knob>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool is_believed(const Knob& knob) { return knob.believed_error > 0 && find_setup_key(knob.key) != nullptr; }

std::pair<double, double> strength_of(const Refit& fit, std::size_t value) {
  const Knob& knob = fit.knobs[value];
  const double at = fit.values[value].value, error = fit.values[value].error;
  if (std::isinf(knob.absent)) return {1 / (at * at), 2 * error / std::abs(at * at * at)};
  if (!knob.absent_key.empty())
    for (std::size_t k = 0; k < fit.values.size(); ++k)
      if (fit.values[k].key == knob.absent_key) {
        const auto a = static_cast<Eigen::Index>(value), b = static_cast<Eigen::Index>(k);
        const double variance =
            fit.covariance(a, a) + fit.covariance(b, b) - fit.covariance(a, b) - fit.covariance(b, a);
        return {at - fit.values[k].value, std::sqrt(std::max(0.0, variance))};
      }
  return {at - knob.absent, error};
}

double told_by(const Refit& fit, const std::string& effect) {
  double most = 0;
  for (std::size_t k = 0; k < fit.values.size(); ++k) {
    if (effect_of(fit.values[k].key) != effect) continue;
    const auto [strength, error] = strength_of(fit, k);
    if (strength != 0) most = std::max(most, std::abs(strength) / error);
  }
  return most;
}

bool is_told(const Refit& fit, const std::string& effect, double standard_errors) {
  return told_by(fit, effect) > standard_errors;
}

std::vector<std::string> hardly_told(const DiagnosisState& state,
                                     const std::vector<std::string>& from_balance, std::size_t added) {
  constexpr double beyond_doubt = 2;  // standard errors: what a 95 % interval leaves out
  const std::size_t spared = added == 1 ? 1 : 0;
  std::vector<std::string> list;
  for (std::size_t i = 0; i + spared < state.missing.size(); ++i) {
    const std::string& effect = state.missing[i];
    if (std::find(from_balance.begin(), from_balance.end(), effect) == from_balance.end() &&
        !is_told(state.fit, effect, beyond_doubt))
      list.push_back(effect);
  }
  std::stable_sort(list.begin(), list.end(), [&](const std::string& a, const std::string& b) {
    return told_by(state.fit, a) < told_by(state.fit, b);
  });
  return list;
}

std::vector<Knob> DiagnosisState::knobs() const { return together(together(theta, found), camera); }

DiagnosisState DiagnosisState::settled(KnownEffects known) const {
  DiagnosisState at = *this;
  at.scatter_at_start = fit.scatter;
  for (std::vector<Knob>* list : {&at.theta, &at.found})
    for (Knob& knob : *list)
      for (const FittedValue& value : fit.values)
        if (knob.key == value.key) {
          knob.centre = value.value;
          knob.width = std::clamp(2 * value.error, 0.1 * knob.width, knob.width);
        }
  // It is present from now on, so that it is no candidate again.
  for (const Knob& knob : at.found) set_knob(at.setup, knob, known);
  return at;
}

bool is_rejected(const Refit& fit) {
  return fit.p_value <= rules::holds && !(fit.scatter < fit.codes_differ);
}

bool is_far_off(const Refit& fit) { return is_rejected(fit) && fit.scatter > effort::far_off; }

bool is_led_astray(const DiagnosisState& state) {
  // However little of the misfit a single effect makes: chi2 of hundreds of features hardly shows it.
  return state.fit.p_value <= rules::doubtful &&
         std::any_of(state.theta.begin(), state.theta.end(), [](const Knob& knob) {
           return is_believed(knob) &&
                  std::abs(knob.centre - knob.believed) > effort::astray * knob.believed_error;
         });
}

DiagnosisState as_believed(DiagnosisState state) {
  constexpr double of_a_restitution = 0.5, of_the_frequency = 0.15;  // of the first fit's box
  for (const Knob& before : state.before_fits)
    for (Knob& knob : state.theta) {
      if (knob.key != before.key) continue;
      knob = before;
      knob.width *= knob.key == "spring.frequency" ? of_the_frequency : of_a_restitution;
    }
  state.scatter_at_start = std::numeric_limits<double>::infinity();
  return state;
}

LadderStep step_of(const std::string& name, const Refit& fit) {
  return {name,
          fit.error_box(),
          fit.error_centre(),
          fit.held_out_error_box,
          fit.floor_box(),
          fit.floor_centre(),
          fit.p_value,
          fit.scatter};
}

DiagnosisTools::DiagnosisTools(const Measurement& measurement, const Engine& engine,
                               const DiagnoseOptions& options)
    : measurement_(measurement),
      options_(options),
      budget_(options.budget > 0 ? options.budget : usual_budget(measurement)),
      start_(std::chrono::steady_clock::now()),
      clock_at_start_(std::clock()) {
  workshop_.engine = &engine;
  workshop_.known = options.known;
  workshop_.execution = options.execution;
  workshop_.pool = &pool_;
  workshop_.store.journal = options.journal;
  workshop_.meter.done = [this](int more) {
    runs_ += more;
    if (options_.progress && runs_ % 64 == 0) options_.progress(stage_, share_spent());
  };
}

double DiagnosisTools::share_spent() const {
  const double runs = static_cast<double>(runs_) / static_cast<double>(budget_);
  return options_.seconds > 0 ? std::max(runs, share_of_time()) : runs;
}

double DiagnosisTools::share_of_time() const {
  if (!(options_.seconds > 0)) return 0;
  // Work counts, waiting for cores that others use does not; but nobody waits for more than this many times
  // as long.
  constexpr double patience = 1.6;
  const double clock = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double worked = static_cast<double>(std::clock() - clock_at_start_) / CLOCKS_PER_SEC;
  return std::max(worked / threads_or_all(options_.execution.threads), clock / patience) / options_.seconds;
}

void DiagnosisTools::limit_to(double share) {
  limit_ = share;
  workshop_.meter.ask_for = [this, share](std::int64_t more) {
    if (more > 0 && static_cast<double>(runs_ + more) > share * static_cast<double>(budget_))
      throw BudgetSpent("as many simulations were made as may be");
    if (share_of_time() > share) throw BudgetSpent("the time is up");
  };
}

void DiagnosisTools::without_limit() {
  limit_ = 1;
  workshop_.meter.ask_for = nullptr;
}

std::vector<MeasuredFeatures> DiagnosisTools::features(const Setup& setup) const {
  return features_of(measurement_, setup);
}

std::vector<MeasuredFeatures> DiagnosisTools::features_of(const Measurement& measurement,
                                                          const Setup& setup) const {
  std::vector<MeasuredFeatures> list =
      features_with_camera(with_setup(measurement, setup, options_.known), options_.known);
  add_wander(wander_, list);
  add_columns(damper_errors_, damper_columns_, options_.known, list);
  return list;
}

std::vector<Knob> DiagnosisTools::weigh_damper(const Setup& setup) {
  std::vector<DamperError> errors = damper_errors(measurement_);
  if (errors.empty()) return {};
  begin(damper_weighed);
  damper_columns_ = columns_of(errors, features(setup), simulations_of_a_column, next_batch(), workshop_);
  damper_errors_ = std::move(errors);
  return knobs_of(damper_errors_, setup);
}

RefitOptions DiagnosisTools::options_of(const DiagnosisState& state, Effort effort) {
  if (state.dear && !effort.whole)
    effort.count = std::min(effort.count, effort::most_when_dear),
    effort.confirming = std::min(effort.confirming, effort::most_when_dear);
  RefitOptions options;
  options.rounds = effort.rounds;
  if (effort.once) options.most_rounds = effort.rounds;
  options.count = effort.count;
  options.most_looks = effort.looks;
  options.confirming = effort.confirming;
  options.scatter_at_start = state.scatter_at_start;
  if (effort.beside) options.look_beside_below = rules::doubtful;
  options.first_run = next_batch();
  return options;
}

Refit DiagnosisTools::fit(const DiagnosisState& state, const std::string& stage,
                          const std::vector<Knob>& knobs, Effort effort, const Refit* judged_by,
                          double look_again_below) {
  stage_ = stage;
  RefitOptions options = options_of(state, effort);
  options.judged_by = judged_by;
  options.look_again_below = look_again_below;
  const double spent = share_spent();
  const std::int64_t before = runs_;
  const Refit fitted = refit(features(state.setup), knobs, workshop_, options);
  if (runs_ > before)
    share_of_a_simulation_[state.missing] = (share_spent() - spent) / static_cast<double>(runs_ - before);
  return fitted;
}

Refit DiagnosisTools::fit_of_first(double seconds, const DiagnosisState& state, const Engine& engine,
                                   Effort effort) {
  Workshop workshop = workshop_;
  workshop.engine = &engine;
  workshop.pool = nullptr;  // it does not tell engines apart
  return refit(features_of(up_to(measurement_, seconds), state.setup), state.knobs(), workshop,
               options_of(state, effort));
}

Refit DiagnosisTools::look_beside(const DiagnosisState& state, const std::string& stage) {
  stage_ = stage;
  return shakedown::look_beside(state.fit, features(state.setup), workshop_,
                                options_of(state, effort::beside));
}

namespace {

std::int64_t different_setups(const Measurement& measurement) {
  std::set<std::string> different;
  for (const Measurement::Run& run : measurement.runs) {
    Setup of_run = run.setup;
    of_run.run.duration = 1;  // repeats that end at different times share simulations
    different.insert(digest(of_run));
  }
  return std::ssize(different);
}

}  // namespace

Effort DiagnosisTools::affordable(const DiagnosisState& state, const Effort& usual,
                                  const Effort& in_haste) const {
  const auto took = share_of_a_simulation_.find(state.missing);
  if (limit_ < 1 || took == share_of_a_simulation_.end()) return usual;
  const std::int64_t simulations = different_setups(measurement_) * (simulations_of(usual) + usual.count);
  return took->second * static_cast<double>(simulations) > 1 - share_spent() ? in_haste : usual;
}

std::int64_t usual_budget(const Measurement& measurement) {
  constexpr std::int64_t for_each_setup = 10000, at_least = 4;
  return for_each_setup * std::max(at_least, different_setups(measurement));
}

std::int64_t least_budget(const Measurement& measurement) {
  constexpr std::int64_t fits = 2;
  return fits * effort::least.count * different_setups(measurement);
}

}  // namespace shakedown
