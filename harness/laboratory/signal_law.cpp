// SPDX-License-Identifier: MIT
#include "signal_law.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "camera_features.hpp"
#include "candidates.hpp"
#include "ideal_signal.hpp"
#include "momentum.hpp"
#include "parameter_knobs.hpp"
#include "refit.hpp"

namespace shakedown {

namespace {

double kept(double chi2, double degrees) { return std::sqrt(std::max(chi2 - degrees, 0.0)); }

/// Holds the hidden case as a camera of the default noise sees it, and what of it needs no ensembles.
struct Sight {
  Measurement measurement;
  MomentumAudit momentum;
};

Sight sight_of(const HiddenCase& hidden, std::uint64_t seed, const std::vector<PlannedRun>& runs,
               const TrialTools& tools) {
  Sight sight;
  const Laboratory laboratory{tools.laboratory, tools.known, seed, tools.execution};
  sight.measurement =
      measurement_of(hidden.believed, make_measurements(hidden.truth, runs, {}, laboratory), tools.known);
  MomentumOptions options;
  options.formulas = false;
  sight.momentum = audit_momentum(sight.measurement, tools.known, options);
  return sight;
}

/// Fits the free parameters, and `effects` beside them.
Refit refit_of(const Sight& sight, const Setup& believed, const std::vector<Candidate>& effects,
               const RefitOptions& options, const TrialTools& tools) {
  const MomentumAudit& momentum = sight.momentum;
  const bool told = momentum.possible && momentum.refitted.degrees > 0;
  const double frequency = told ? momentum.frequency : believed.spring.frequency;
  std::vector<Knob> knobs = free_parameters(believed, frequency, 0.01 * frequency);
  Measurement measurement = sight.measurement;
  for (const Candidate& effect : effects) {
    knobs.insert(knobs.end(), effect.fitted_knobs().begin(), effect.fitted_knobs().end());
    for (Measurement::Run& run : measurement.runs) run.setup = prepared(run.setup, effect, tools.known);
  }
  const Workshop workshop{tools.model, tools.known, tools.execution};
  const std::vector<Knob> camera = camera_knobs(believed, measurement, tools.known);
  std::copy_if(camera.begin(), camera.end(), std::back_inserter(knobs), [&](const Knob& of_camera) {
    return std::none_of(knobs.begin(), knobs.end(),
                        [&](const Knob& knob) { return knob.key == of_camera.key; });
  });
  return refit(features_with_camera(measurement, tools.known), knobs, workshop, options);
}

}  // namespace

Signal signal_to_noise(const HiddenCase& hidden, std::uint64_t seed, const SignalSettings& settings,
                       const TrialTools& tools) {
  const Sight sight = sight_of(hidden, seed, settings.runs, tools);
  const MomentumAudit& momentum = sight.momentum;
  const std::vector<std::string> effects = hidden_effects(hidden);
  if (std::find(effects.begin(), effects.end(), "unknown") != effects.end())
    return {momentum.possible ? kept(momentum.final_fit.chi2, momentum.final_fit.degrees) : 0, 0};
  Signal signal;
  if (momentum.possible) signal.by_balance = kept(momentum.refitted.chi2, momentum.refitted.degrees);
  if (signal.by_balance > settings.enough) return signal;
  RefitOptions options;
  options.count = options.confirming = settings.count;
  const Refit fit = refit_of(sight, hidden.believed, {}, options, tools);
  signal.by_ensembles = kept(fit.chi2, fit.degrees);
  return signal;
}

double distance_of_imitation(const HiddenCase& hidden, const std::string& imitation, std::uint64_t seed,
                             const SignalSettings& settings, const TrialTools& tools) {
  const std::string truth = hidden_effects(hidden).at(0);
  const Sight sight = sight_of(hidden, seed, settings.runs, tools);
  const auto alone = [&](const std::string& effect) -> const SingleTerm* {
    const auto found = std::find_if(sight.momentum.ranking.begin(), sight.momentum.ranking.end(),
                                    [&](const SingleTerm& term) { return term.effect == effect; });
    return found == sight.momentum.ranking.end() ? nullptr : &*found;
  };
  if (alone(truth) && alone(imitation)) return kept(alone(truth)->gain, alone(imitation)->gain);
  RefitOptions options;
  options.count = options.confirming = settings.count;
  const auto with = [&](const std::string& effect) {
    return refit_of(sight, hidden.believed,
                    candidates_for(hidden.believed, {effect}, tools.known, *tools.model), options, tools);
  };
  const Refit as_it_is = with(truth);
  options.judged_by = &as_it_is;
  // A signal is what the data tell, whatever is believed.
  const Refit imitated = with(imitation);
  return kept(imitated.judged_chi2 - imitated.disbelief, as_it_is.judged_chi2 - as_it_is.disbelief);
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
  const bool of_the_camera = hideable.effect->acts_on == ActsOn::camera;
  const auto signal_at = [&](double strength, int round, double enough) -> Signal {
    if (hideable.formula.empty() && !of_the_camera) {
      const IdealSettings ideal{.runs = settings.runs,
                                .count = std::max(8, settings.count / 4),
                                .seed = seed + static_cast<std::uint64_t>(round)};
      const double seen = std::max(
          0.0,
          ideal_signal(believed, changed(believed, at_strength(hideable, strength, believed), tools.known),
                       ideal, tools));
      // Forces on the box are seen against the camera's noise, what happens in contacts against chaos.
      const bool forced = hideable.effect->acts_on == ActsOn::box || hideable.effect->acts_on == ActsOn::all;
      return forced ? Signal{seen, 0} : Signal{0, seen};
    }
    SignalSettings here = settings;
    here.enough = enough;
    return signal_to_noise(
        {believed, changed(believed, at_strength(hideable, strength, believed), tools.known)},
        seed + static_cast<std::uint64_t>(round), here, tools);
  };
  SignalLaw law;
  Signal signal;
  for (int round = 1; round <= most_rounds; ++round) {
    const bool last = round == most_rounds;
    // Rounds before the last only find the way.
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
