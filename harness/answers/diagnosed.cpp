// SPDX-License-Identifier: MIT
#include "diagnosed.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "diagnose_report.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "engines.hpp"
#include "knobs_report.hpp"
#include "measured_against_model.hpp"
#include "parameter_knobs.hpp"
#include "setup_file.hpp"
#include "suggestion.hpp"
#include "turned_model.hpp"

namespace shakedown {

void check_diagnosed_names(const std::vector<std::string>& effects, const std::vector<std::string>& fixed) {
  std::vector<Violation> found;
  std::vector<std::string_view> known;
  for (const EffectRecord* effect : all_effects()) known.push_back(effect->name);
  for (const std::string& name : effects)
    if (find_effect(name) == nullptr)
      found.push_back({{"--effects", 0, 0},
                       name,
                       "is not an effect",
                       did_you_mean(name, known) + "`shakedown effects` lists them"});
  std::vector<std::string> fitted;
  for (const Knob& knob : free_parameters(Setup{})) fitted.push_back(knob.key);
  for (const std::string& name : fixed)
    if (std::find(fitted.begin(), fitted.end(), name) == fitted.end())
      found.push_back({{"--fixed", 0, 0},
                       name,
                       "is not fitted anyway",
                       "restitution.grain_grain, restitution.grain_wall and spring.frequency are"});
  if (!found.empty()) throw InputError(std::move(found));
}

DiagnoseOptions usual_diagnose_options() {
  DiagnoseOptions options;
  options.known = all_effects();
  options.strength_uncertainty = &strength_uncertainty;
  options.lasting_contacts = engine_named("soft");
  return options;
}

std::string amended_setup(const Diagnosis& diagnosis) {
  std::string text = "# Amended by `shakedown diagnose`: " + diagnosis.sentence + "\n";
  for (const DiagnosedParameter& p : diagnosis.parameters)
    text += p.word.empty() ? fmt::format("#   {} = {:.6g} {} (95 %: {:.6g} to {:.6g})\n", p.name, p.value,
                                         p.unit, p.low, p.high)
                           : fmt::format("#   {} = {}\n", p.name, p.word);
  return text + write_setup(diagnosis.amended);
}

namespace {

/// Returns the suspects that a reader may want to turn: those that explain most, what was found left out.
std::vector<std::string> suspects_of(const Diagnosis& diagnosis) {
  constexpr std::size_t most = 6;
  std::vector<std::string> names;
  for (const RankedEffect& ranked : diagnosis.ranking) {
    const auto is_it = [&](const std::string& name) { return name == ranked.effect; };
    if (names.size() < most && std::none_of(names.begin(), names.end(), is_it) &&
        std::none_of(diagnosis.missing.begin(), diagnosis.missing.end(), is_it))
      names.push_back(ranked.effect);
  }
  return names;
}

ReportKnobs knobs_of_diagnosis(const Diagnosis& diagnosis, const Setup& user, const Engine& engine,
                               const PageOptions& page) {
  if (!diagnosis.last_fit) return {};
  const LastFit& fit = *diagnosis.last_fit;
  if (fit.swing)
    return knobs_of(turned_numbers(*fit.swing, user, diagnosis.missing, all_effects()), fit,
                    diagnosis.amended);
  TurnedOptions options;
  options.known = all_effects();
  options.missing = diagnosis.missing;
  options.suspects = suspects_of(diagnosis);
  constexpr double share_of_time = 0.2, least = 20;  // beside that of the diagnosis itself; s
  options.seconds = std::max(least, share_of_time * page.seconds);
  options.execution = page.execution;
  return knobs_of(turned_model(*fit.ensembles, user, engine, options), fit, diagnosis.amended);
}

}  // namespace

Report report_of(const Diagnosis& diagnosis, const Measurement& measurement, const Setup& given,
                 const PageOptions& page) {
  const std::unique_ptr<Engine> engine = engine_named(diagnosis.engine);
  const LastFit* fit = diagnosis.last_fit.get();
  const Measurement& shown = fit != nullptr ? fit->measurement : measurement;
  return report_of(diagnosis, measurement, given,
                   drawn_curves(shown, &given, diagnosis.amended, fit, *engine, page.execution),
                   knobs_of_diagnosis(diagnosis, given, *engine, page));
}

}  // namespace shakedown
