// SPDX-License-Identifier: MIT
#include "trial.hpp"

#include <algorithm>
#include <set>

#include "effects.hpp"
#include "known_effects.hpp"
#include "verdict.hpp"

namespace shakedown {

Experiment measured_in(const Trial& trial, const TrialTools& tools) {
  const Laboratory laboratory{tools.laboratory, tools.known, trial.seed, tools.execution};
  Experiment experiment = make_measurements(trial.hidden.truth, trial.runs, trial.recording, laboratory);
  experiment.known = trial.known;
  if (tools.damage) tools.damage(experiment);
  return experiment;
}

Diagnosis diagnose_trial(const Trial& trial, const TrialTools& tools) {
  DiagnoseOptions options;
  options.budget = tools.budget;
  options.execution = tools.execution;
  options.known = tools.known;
  options.strength_uncertainty = tools.strength_uncertainty;
  options.fixed = tools.fixed;
  options.ensembles = tools.ensembles;
  return diagnose(trial.hidden.believed,
                  measurement_of(trial.hidden.believed, measured_in(trial, tools), tools.known), *tools.model,
                  options);
}

std::vector<std::string> effects_standing_out(const std::vector<NuisanceFound>& camera) {
  std::vector<std::string> effects;
  for (const NuisanceFound& found : standing_out(camera)) {
    const std::string effect = found.name.substr(0, found.name.find('.'));
    if (const EffectRecord* record = find_effect(effect);
        record != nullptr && record->acts_on == ActsOn::camera)
      effects.push_back(effect);
  }
  return effects;
}

TrialJudgement judge(const std::vector<std::string>& hidden, bool other_parameters, Verdict verdict,
                     const std::vector<std::string>& missing, const std::vector<std::string>& measured) {
  std::set<std::string> found(missing.begin(), missing.end());
  for (const EffectRecord* record : all_effects())
    if (record->nuisance) found.erase(std::string(record->name));
  const std::set<std::string> truth(hidden.begin(), hidden.end());
  TrialJudgement judgement;
  judgement.detected = verdict == Verdict::missing || verdict == Verdict::unknown;
  judgement.invented = std::any_of(found.begin(), found.end(),
                                   [&](const std::string& effect) { return !truth.contains(effect); });
  if (truth.empty())
    judgement.named =
        found.empty() && (verdict == Verdict::refit || (verdict == Verdict::adequate && !other_parameters));
  else if (truth.contains("unknown"))
    judgement.named = verdict == Verdict::unknown;
  else if (verdict == Verdict::measurement)
    judgement.named =
        found.empty() && std::all_of(truth.begin(), truth.end(), [&](const std::string& effect) {
          return std::find(measured.begin(), measured.end(), effect) != measured.end();
        });
  else
    judgement.named = verdict == Verdict::missing && found == truth;
  return judgement;
}

std::vector<std::string> physics_among(const std::vector<std::string>& effects, KnownEffects known) {
  std::vector<std::string> physics;
  for (const std::string& effect : effects) {
    const EffectRecord* record = known.find(effect);
    if (record == nullptr || (record->acts_on != ActsOn::camera && !record->nuisance))
      physics.push_back(effect);
  }
  std::sort(physics.begin(), physics.end());
  return physics;
}

Power power_of(Trial trial, int repeats, const TrialTools& tools,
               const std::function<void(int done, const std::string& answer)>& told) {
  const std::vector<std::string> hidden = hidden_effects(trial.hidden);
  Power power;
  int detected = 0, named = 0;
  for (int i = 0; i < repeats; ++i, ++trial.seed) {
    const Diagnosis diagnosis = diagnose_trial(trial, tools);
    const TrialJudgement judgement = judge(hidden, has_other_parameters(trial.hidden), diagnosis.verdict,
                                           diagnosis.missing, effects_standing_out(diagnosis.camera));
    detected += judgement.detected;
    named += judgement.named;
    std::string answer(name_of(diagnosis.verdict));
    for (const std::string& effect : diagnosis.missing)
      answer += (answer.ends_with("missing") ? " " : " + ") + effect;
    const auto same = std::find_if(power.answers.begin(), power.answers.end(),
                                   [&](const auto& one) { return one.first == answer; });
    if (same == power.answers.end())
      power.answers.emplace_back(answer, 1);
    else
      ++same->second;
    if (told) told(i + 1, answer);
  }
  power.detected = share_of(detected, repeats);
  power.named = share_of(named, repeats);
  std::stable_sort(power.answers.begin(), power.answers.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return power;
}

}  // namespace shakedown
