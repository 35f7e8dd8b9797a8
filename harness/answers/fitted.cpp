// SPDX-License-Identifier: MIT
#include "fitted.hpp"

#include <algorithm>

#include "drawn_curves.hpp"
#include "effects.hpp"
#include "fit_report.hpp"
#include "free_parameters.hpp"
#include "knobs_report.hpp"
#include "momentum.hpp"

namespace shakedown {

FitOptions usual_fit_options() {
  FitOptions options;
  options.known = all_effects();
  return options;
}

Fit fitted_and_judged(const Setup& setup, const Measurement& measurement, const std::string& free,
                      const Engine& engine, const FitOptions& options) {
  Fit found =
      fit_parameters(setup, measurement, free_parameters(free, setup, all_effects()), engine, options);
  const MomentumAudit balance =
      audit_momentum(with_setup(measurement, found.fitted, all_effects()), all_effects());
  if (!found.used.empty())
    found.judgement = judgement_of({found.p_value, found.scatter, ""}, balance.test_of(balance.as_given),
                                   differences_of(found.used));
  return found;
}

namespace {

/// The keys that were fitted are there to be turned.
ReportKnobs knobs_of(const Fit& fit, const Setup& given, const Measurement& measurement, const Engine& engine,
                     int threads, const std::atomic<bool>* stop) {
  if (fit.measured.empty()) return {};
  const Workshop workshop{&engine, all_effects(), threads, stop, {}, nullptr};
  RefitOptions once;
  constexpr int count = 64;
  once.count = count, once.rounds = once.most_rounds = 1;
  const LastFit last{
      measurement,
      EnsembleFit{fit.fitted, fit.measured, compare_at(fit.measured, {}, workshop, once), fit.solution},
      {}};
  TurnedOptions options;
  options.known = all_effects();
  options.threads = threads;
  options.stop = stop;
  constexpr double share_of_time = 0.2, least = 20;  // beside that of the fit itself; s
  options.seconds = std::max(least, share_of_time * fit.seconds);
  return knobs_of(turned_model(*last.ensembles, given, engine, options), last, fit.fitted);
}

}  // namespace

Report report_of(const Fit& fit, const Setup& given, const Measurement& measurement, const Engine& engine,
                 int threads, const std::atomic<bool>* stop) {
  return report_of(fit, measurement, drawn_curves(measurement, &given, fit.fitted, engine, threads, stop),
                   knobs_of(fit, given, measurement, engine, threads, stop));
}

}  // namespace shakedown
