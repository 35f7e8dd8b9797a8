// SPDX-License-Identifier: MIT
#include "from_balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "distributions.hpp"
#include "effect_strength.hpp"
#include "known_effects.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

/// Adds a sine whose amplitude, frequency and phase may move by their errors: over a run of length T a
/// relative error of the amplitude goes with sqrt(6) / (pi T) as much in the frequency, and twice as much in
/// the phase at the release (rad).
void add_sine(const FoundTerm& term, const SearchedHarmonic& harmonic, double longest, KnownEffects known,
              DiagnosisState& state) {
  constexpr double root_six_over_pi = 0.78;
  const double error = std::max((term.high - term.low) / (2 * normal_95), 0.01 * std::abs(term.value)),
               relative = std::min(1.0, error / std::abs(term.value));
  const auto knob = [&](std::string_view parameter, double value, double error_of_it, double most_width) {
    const std::string key = term.effect + "." + std::string(parameter);
    set_number(state.setup, key, value, known);
    const double width = std::min(4 * error_of_it, most_width);
    const Parameter& bounds = *known.find_parameter(key);
    state.found.push_back({key, value, width, std::max(bounds.low, value - 10 * width),
                           std::min(bounds.high, value + 10 * width), false, value, error_of_it});
  };
  constexpr double any = std::numeric_limits<double>::infinity(),
                   about_a_line = 0.5;  // rad: as far as a sine follows its slope to an eighth
  knob(harmonic.amplitude, term.value, error, any);
  knob(harmonic.frequency, term.frequency, relative * root_six_over_pi / std::max(longest, 1.0), any);
  knob(harmonic.phase, term.phase, 2 * relative, about_a_line);
}

/// Adds a note that is not there yet: the same terms go in beside several states of one diagnosis.
void add_once(std::vector<std::string>& notes, const std::string& note) {
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

}  // namespace

bool allowed(const DiagnoseOptions& options, const std::string& effect) {
  return options.effects.empty() ||
         std::find(options.effects.begin(), options.effects.end(), effect) != options.effects.end();
}

DiagnosisState with_balance(DiagnosisState state, const std::vector<FoundTerm>& terms,
                            const Measurement& measurement, const Engine& engine,
                            const DiagnoseOptions& options, std::vector<std::string>& notes) {
  double longest = 0;
  for (const Measurement::Run& run : measurement.runs)
    if (!run.recorded.time.empty())
      longest = std::max(longest, run.recorded.time.back() - run.recorded.time.front());
  for (const FoundTerm& term : terms) {
    if (!allowed(options, term.effect)) continue;
    const EffectRecord* record = options.known.find(term.effect);
    if (record == nullptr) continue;
    if (!is_modelled(engine, *record)) {
      add_once(notes, "the momentum balance finds " + term.effect + ", which the " +
                          std::string(engine.name()) +
                          " engine does not model: ensembles are fitted without it");
      state.missing.push_back(term.effect);
      continue;
    }
    const bool is_second_sine =
        term.frequency > 0 && std::any_of(state.found.begin(), state.found.end(), [&](const Knob& knob) {
          return effect_of(knob.key) == term.effect;
        });
    if (is_second_sine) {  // a setup has one of each effect
      add_once(notes, "the momentum balance finds two sines: ensembles are fitted with the first alone");
      continue;
    }
    const bool had_already = find_choice(state.setup, term.effect) != nullptr;
    if (had_already)
      add_once(notes, "the momentum balance asks for another " + term.key() + ": it is refitted");
    else
      state.missing.push_back(term.effect);
    if (term.frequency > 0) {
      add_sine(term, *search_of(*record).harmonic, longest, options.known, state);
      continue;
    }
    for (const auto& [key, value] : term.besides) set_number(state.setup, key, value, options.known);
    set_number(state.setup, term.key(), term.value, options.known);
    const double error = (term.high - term.low) / (2 * normal_95);
    const Parameter* parameter = options.known.find_parameter(term.key());
    state.found.push_back({term.key(), term.value, std::max(4 * error, 0.05 * std::abs(term.value)),
                           parameter->low, parameter->high, true, term.value, error});
    std::erase_if(state.camera, [&](const Knob& knob) { return knob.key == term.key(); });
  }
  return state;
}

std::vector<std::string> effects_of(const MomentumAudit& balance) {
  std::vector<std::string> effects;
  for (const FoundTerm& term : balance.terms) effects.push_back(term.effect);
  return effects;
}

std::vector<Hypothesis> hypotheses_of(const MomentumAudit& balance) {
  std::vector<Hypothesis> table;
  for (const WeighedSet& set : balance.sets)
    table.push_back({set.effects, std::log(std::max(set.probability, 1e-300)), set.probability});
  if (table.empty()) table.push_back({{}, 0, 1});
  return table;
}

}  // namespace shakedown
