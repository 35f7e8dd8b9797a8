// SPDX-License-Identifier: MIT
#include "fitted.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "course.hpp"
#include "drawn_curves.hpp"
#include "effects.hpp"
#include "fit_report.hpp"
#include "free_parameters.hpp"
#include "knobs_report.hpp"
#include "momentum.hpp"
#include "refit.hpp"
#include "refit_options.hpp"
#include "release_known.hpp"
#include "swing.hpp"
#include "swing_judged.hpp"
#include "turned_model.hpp"

namespace shakedown {

namespace {

/// Returns the runs of these names, or the others. No names stand for all runs.
Measurement part_of(const Measurement& whole, const std::vector<std::string>& names, bool others) {
  Measurement part = whole;
  if (names.empty()) {
    if (others) part.runs.clear();
    return part;
  }
  std::erase_if(part.runs, [&](const Measurement::Run& run) {
    return (std::find(names.begin(), names.end(), run.recorded.name) != names.end()) == others;
  });
  return part;
}

/// Fits boxes without grains; returns nothing where no run swings long enough.
std::optional<Fit> by_waveform(const Setup& setup, const Measurement& recorded,
                               const std::vector<Knob>& knobs, const FitOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const Measurement used = part_of(recorded, options.on, false);
  const MomentumAudit balance = audit_momentum(used, all_effects());
  const std::optional<JudgedSwing> judged = judged_swing(setup, used, knobs, balance, all_effects());
  if (!judged) return {};
  Fit fit;
  fit.parameters = parameters_of(judged->refit, knobs, all_effects());
  fit.correlation = correlation_of(judged->refit.covariance);
  fit.used = judged->refit.runs;
  const Measurement others = part_of(recorded, options.on, true);
  if (!others.runs.empty()) fit.left_out = foretold_swings(*judged, others, balance, all_effects());
  fit.p_value = judged->refit.p_value;
  fit.scatter = judged->refit.scatter;
  fit.judgement = judged->judgement;
  fit.start = setup;
  fit.fitted = judged->fitted;
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return fit;
}

}  // namespace

FitOptions usual_fit_options() {
  FitOptions options;
  options.known = all_effects();
  return options;
}

namespace {

struct AskedCurve {
  const CurveLaw* law;
  std::string contacts;
};

std::vector<AskedCurve> curves_asked(const FitQuestion& asked) {
  std::vector<AskedCurve> curves;
  if (!asked.restitution_curve.empty())
    curves.push_back({&restitution_against_speed(), asked.restitution_curve});
  if (!asked.friction_curve.empty()) curves.push_back({&friction_against_slip(), asked.friction_curve});
  return curves;
}

Setup with_curves(const FitQuestion& asked, Setup setup) {
  for (const AskedCurve& curve : curves_asked(asked))
    setup = with_contact_curve(*curve.law, setup, curve.contacts, all_effects());
  return setup;
}

/// Returns the knobs that are asked for. `setup`: with its curves.
std::vector<Knob> knobs_asked(const FitQuestion& asked, const Setup& setup) {
  std::vector<Knob> knobs = free_parameters(asked.free, setup, all_effects());
  for (const AskedCurve& curve : curves_asked(asked))
    for (Knob& knob : knobs_of_curve(*curve.law, setup, all_effects())) knobs.push_back(std::move(knob));
  return knobs;
}

Fit fitted_by_ensembles(const Setup& setup, const Measurement& measurement, const FitQuestion& asked,
                        const Engine& engine, const FitOptions& options) {
  std::vector<Knob> knobs = knobs_asked(asked, setup);
  Fit fit = fit_parameters(setup, measurement, knobs, engine, options);
  const std::vector<AskedCurve> curves = curves_asked(asked);
  if (curves.empty()) return fit;
  std::int64_t runs = fit.runs;
  double seconds = fit.seconds;
  const auto hold_those_that_turn = [&] {
    bool turns = false;
    for (const AskedCurve& curve : curves)
      if (std::optional<std::vector<Knob>> held =
              held_to_one_side(*curve.law, knobs, values_of(fit), all_effects())) {
        knobs = std::move(*held);
        turns = true;
      }
    return turns;
  };
  for (std::size_t i = 0; i < curves.size() && hold_those_that_turn(); ++i) {
    fit = fit_parameters(setup, measurement, knobs, engine, options);
    runs += fit.runs;
    seconds += fit.seconds;
  }
  for (const AskedCurve& curve : curves) fit.curves.push_back(curve_of(*curve.law, fit, all_effects()));
  // The fit with a constant foretells no runs left out.
  const Fit level = fit_parameters(setup, part_of(measurement, options.on, false),
                                   free_parameters(asked.free, setup, all_effects()), engine, options);
  fit.constant = {level.p_value, level.scatter, level.judgement.standing, fit.judgement.standing};
  fit.runs = runs + level.runs;
  fit.seconds = seconds + level.seconds;
  return fit;
}

}  // namespace

void check(const FitQuestion& asked, const Setup& setup) {
  const Setup curved = with_curves(asked, setup);
  (void)knobs_asked(asked, curved);
  const std::vector<Knob> free = free_parameters(asked.free, curved, all_effects());
  for (const AskedCurve& curve : curves_asked(asked))
    if (!moves_the_level(*curve.law, curved, free, all_effects()))
      throw InputError({{{"--free", 0, 0},
                         asked.free,
                         "leaves the level of the " + std::string(curve.law->coefficient) +
                             " fixed, so that a curve would stand for it",
                         "free its coefficients too, joined by &"}});
}

Fit fitted_and_judged(const Setup& given, const Measurement& recorded, const FitQuestion& asked,
                      const Engine& engine, const FitOptions& options) {
  const Setup setup = with_curves(asked, given);
  const std::vector<Knob> knobs = knobs_asked(asked, setup);
  refuse_unknown_runs(recorded, options.on);
  if (is_empty(setup, recorded))
    if (std::optional<Fit> fit = by_waveform(setup, recorded, knobs, options)) return std::move(*fit);
  const Measurement measurement = from_first_turns(
      with_measured_release(
          curves_asked(asked).empty() ? recorded : with_setup(recorded, setup, all_effects()), all_effects()),
      engine);
  FitOptions with_wander = options;
  with_wander.wander = audit_momentum(measurement, all_effects()).wander_of_tracks();
  Fit found = fitted_by_ensembles(setup, measurement, asked, engine, with_wander);
  const MomentumAudit balance =
      audit_momentum(with_setup(measurement, found.fitted, all_effects()), all_effects());
  if (!found.used.empty())
    found.judgement =
        judgement_of(found.solution.test(), balance.test_of(balance.as_given), differences_of(found.used));
  return found;
}

namespace {

/// Returns the fit as its page needs it, beside the model as given; nothing of boxes without grains.
std::optional<LastFit> last_fit_of(const Fit& fit, const Measurement& measurement, const Engine& engine,
                                   const Execution& execution) {
  if (fit.measured.empty()) return {};
  const Workshop workshop{&engine, all_effects(), execution};
  RefitOptions once;
  constexpr int count = 64;
  once.count = count, once.rounds = once.most_rounds = 1;
  return LastFit{
      measurement,
      EnsembleFit{fit.fitted, fit.measured, compare_at(fit.measured, {}, workshop, once), fit.solution},
      {}};
}

/// Returns what a reader may turn: the keys that were fitted, camera and weights.
ReportKnobs knobs_of_fit(const Fit& fit, const std::optional<LastFit>& last, const Engine& engine,
                         const Execution& execution) {
  if (!last) return {};
  TurnedOptions options;
  options.known = all_effects();
  options.execution = execution;
  constexpr double share_of_time = 0.2, least = 20;  // beside that of the fit itself; s
  options.seconds = std::max(least, share_of_time * fit.seconds);
  return knobs_of(turned_model(*last->ensembles, fit.start, engine, options), *last, fit.fitted);
}

}  // namespace

Report report_of(const Fit& fit, const Setup& given, const Measurement& recorded, const Engine& engine,
                 const Execution& execution) {
  const bool empty = is_empty(given, recorded);
  const Measurement measurement = from_first_turns(empty ? with_setup(recorded, fit.fitted, all_effects())
                                                         : with_measured_release(recorded, all_effects()),
                                                   engine);
  const std::optional<LastFit> last = last_fit_of(fit, measurement, engine, execution);
  return report_of(fit, measurement,
                   drawn_curves(measurement, &given, fit.fitted, last ? &*last : nullptr, engine, execution),
                   knobs_of_fit(fit, last, engine, execution));
}

}  // namespace shakedown
