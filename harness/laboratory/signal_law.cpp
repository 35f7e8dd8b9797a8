// SPDX-License-Identifier: MIT
#include "signal_law.hpp"

#include <algorithm>
#include <cmath>

#include "audit.hpp"
#include "experiment_file.hpp"
#include "momentum.hpp"
#include "parameter_knobs.hpp"
#include "refit.hpp"

namespace shakedown {

namespace {

double kept(double chi2, double degrees) { return std::sqrt(std::max(chi2 - degrees, 0.0)); }

}  // namespace

Signal signal_to_noise(const HiddenCase& hidden, std::uint64_t seed, const SignalSettings& settings,
                       const TrialTools& tools) {
  const Laboratory laboratory{tools.laboratory, tools.known, seed, tools.threads, tools.stop};
  const Experiment experiment = make_measurements(hidden.truth, settings.runs, {}, laboratory);
  const Audit found = audit(experiment);
  const std::vector<Setup> setups = setups_of_runs(hidden.believed, experiment, tools.known);
  const std::vector<std::string> effects = hidden_effects(hidden);
  MomentumOptions by_balance;
  by_balance.formulas = false;
  const MomentumAudit momentum = audit_momentum(experiment, found, setups, by_balance);
  if (std::find(effects.begin(), effects.end(), "unknown") != effects.end())
    return {momentum.possible ? kept(momentum.final_fit.chi2, momentum.final_fit.degrees) : 0, 0};
  Signal signal;
  if (momentum.possible) signal.by_balance = kept(momentum.refitted.chi2, momentum.refitted.degrees);
  if (signal.by_balance > settings.enough) return signal;
  const bool told = momentum.possible && momentum.refitted.degrees > 0;
  const double frequency = told ? momentum.frequency : hidden.believed.spring.frequency;
  RefitOptions options;
  options.count = options.confirming = settings.count;
  const Workshop workshop{tools.model, tools.known, tools.threads, tools.stop, {}, nullptr};
  const Refit fit = refit(features_of(experiment, found, setups),
                          free_parameters(hidden.believed, frequency, 0.01 * frequency), workshop, options);
  signal.by_ensembles = kept(fit.chi2, fit.degrees);
  return signal;
}

double SignalLaw::signal_at(double strength_of_it, double noise) const {
  return signal * std::pow(strength_of_it / strength, power) / (by_balance ? noise : 1);
}

double SignalLaw::strength_for(double signal_wanted, double noise) const {
  return strength * std::pow(signal_wanted * (by_balance ? noise : 1) / signal, 1 / power);
}

SignalLaw signal_law(const Hideable& hideable, const Setup& believed, std::uint64_t seed,
                     const SignalSettings& settings, const TrialTools& tools) {
  constexpr double too_little = 12, wanted = 20, too_much = 40;
  constexpr int most_rounds = 3;
  const auto signal_at = [&](double strength, int round, double enough) {
    SignalSettings here = settings;
    here.enough = enough;
    return signal_to_noise({believed, changed(believed, at_strength(hideable, strength), tools.known)},
                           seed + static_cast<std::uint64_t>(round), here, tools);
  };
  SignalLaw law;
  Signal signal;
  for (int round = 1; round <= most_rounds; ++round) {
    const bool last = round == most_rounds;
    // before, only to find the way
    signal = signal_at(law.strength, round - 1, last ? std::numeric_limits<double>::infinity() : too_much);
    if (last || (signal.most() > too_little && signal.most() < too_much)) break;
    const double next = std::min(law.strength * std::clamp(wanted / std::max(signal.most(), 3.0), 0.05, 4.0),
                                 hideable.strongest);
    if (next == law.strength) break;
    law.strength = next;
  }
  law.signal = signal.most();
  law.by_balance = signal.by_balance >= signal.by_ensembles;
  if (law.by_balance || law.signal == 0) return law;
  const double half = signal_at(0.5 * law.strength, most_rounds, settings.enough).most();
  law.power = std::clamp(std::log2(law.signal / std::max(half, 1e-3)), 1.0, 2.0);
  return law;
}

double relative_noise(const RecordingSettings& recording, const Setup& setup) {
  const double grains = setup.grains.count * setup.grains.mass;
  const auto noise = [&](const RecordingSettings& camera) {
    return std::hypot(setup.box.mass * camera.box_noise, camera.centre ? grains * camera.centre_noise : 0.0);
  };
  return noise(recording) / noise(RecordingSettings{});
}

}  // namespace shakedown
