// SPDX-License-Identifier: MIT
#include "diagnosis.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "experiment_file.hpp"
#include "initial_state.hpp"
#include "linear_screen.hpp"
#include "quantity.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

/// Below this a model is rejected.
constexpr double rejected = 0.01;
/// A step up the ladder must bring chi2 down by this much and this share: a free parameter and the choice among some twenty effects.
constexpr double least_gain = 14, least_share = 0.08;
constexpr int most_effects = 3;

std::string effect_of(const std::string& key) { return key.substr(0, key.find('.')); }

class Pipeline {
 public:
  Pipeline(const Setup& setup, const Experiment& experiment, const Engine& engine, const DiagnoseOptions& options)
      : user_(setup), base_(setup), experiment_(experiment), options_(options), audit_(audit(experiment)) {
    workshop_ = {&engine, options.known, options.threads, options.stop, {}, &result_.runs_simulated};
    workshop_.done = [this](int) {
      if (options_.progress && result_.runs_simulated % 64 == 0)
        options_.progress(stage_, std::min(1.0, static_cast<double>(result_.runs_simulated) / static_cast<double>(options_.budget)));
    };
  }

  Diagnosis run() {
    const auto start = std::chrono::steady_clock::now();
    result_.notes = audit_.warnings;
    stage_ = "momentum balance";
    result_.momentum = audit_momentum(experiment_, audit_, setups_of_runs(user_, experiment_, options_.known));
    judge();
    finish();
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result_;
  }

 private:
  bool momentum_clean() const { return !result_.momentum.possible || result_.momentum.as_given.p_value > rejected; }
  bool momentum_refits() const { return !result_.momentum.possible || (result_.momentum.terms.empty() && !result_.momentum.unexplained); }

  std::vector<MeasuredFeatures> features() const {
    return features_of(experiment_, audit_, setups_of_runs(base_, experiment_, options_.known));
  }

  void choose_packing();
  void judge();
  Refit fit(const std::string& step, const std::vector<Knob>& knobs, int rounds, int count = 192);
  void add_momentum_terms();
  bool add_best_candidate(Refit& best);
  void prune(Refit& best);
  void keep(const Refit& refit);
  void finish();
  void conclude_unknown();

  Setup user_, base_;
  const Experiment& experiment_;
  const DiagnoseOptions& options_;
  Audit audit_;
  Workshop workshop_;
  Diagnosis result_;
  std::string stage_;
  std::vector<Knob> chosen_;       // of the effects added
  std::vector<Knob> theta_;        // what the user may refit, at its latest values
  Refit final_;
  int batch_ = 0;
};

/// The grains' centre in the box before anything has moved tells the packing: the arrangements differ by millimetres.
void Pipeline::choose_packing() {
  if (!user_.release.initial_grains.empty() || user_.grains.count == 0) return;
  double offset = 0, weight = 0;
  for (std::size_t r = 0; r < experiment_.runs.size(); ++r) {
    const MeasuredRun& run = experiment_.runs[r];
    if (!run.has_com()) continue;
    for (std::size_t i = 0; i < run.time.size() && run.time[i] < 0.03; ++i) {
      const double apart = audit_.runs[r].x_com[i] - audit_.runs[r].x_box[i];
      if (!std::isfinite(apart)) continue;
      offset += apart - run.box_length / 2;  // from the outer wall, the same for every length in a layer
      weight += 1;
    }
  }
  if (weight < 5) return;
  offset /= weight;
  const auto offset_of = [&](Packing packing) {
    Setup setup = user_;
    setup.release.packing = packing;
    double sum = 0, count = 0;
    for (const Setup& run : setups_of_runs(setup, experiment_, options_.known)) {
      const State state = initial_state(run);
      sum += centre_of_mass_x(state) - state.x_box - run.box.length / 2;
      ++count;
    }
    return sum / count;
  };
  const double given = std::abs(offset_of(user_.release.packing) - offset);
  if (given < 0.6e-3) return;
  for (const Packing packing : {Packing::fcc, Packing::square, Packing::random, Packing::spread}) {
    if (packing == user_.release.packing || std::abs(offset_of(packing) - offset) > std::min(0.6e-3, given / 2)) continue;
    base_.release.packing = packing;
    result_.parameters.push_back({"release.packing", 0, 0, 0, "", std::string(name_of(packing))});
    result_.notes.push_back("before release the grains' centre lies where packing '" + std::string(name_of(packing)) + "' has it, not '" +
                            std::string(name_of(user_.release.packing)) + "'");
    return;
  }
}

Refit Pipeline::fit(const std::string& step, const std::vector<Knob>& knobs, int rounds, int count) {
  stage_ = step;
  RefitOptions options;
  options.rounds = rounds;
  options.count = count;
  options.first_run = 100000 * ++batch_;
  return refit(features(), knobs, workshop_, options);
}

/// Takes a fit as the state of knowledge: the knobs start from it next time.
void Pipeline::keep(const Refit& refit) {
  final_ = refit;
  for (const FittedValue& value : refit.values)
    for (std::vector<Knob>* knobs : {&theta_, &chosen_})
      for (Knob& knob : *knobs)
        if (knob.key == value.key) {
          knob.centre = value.value;
          knob.width = std::clamp(5 * value.error, 0.15 * knob.width, knob.width);
        }
}

LadderStep step_of(const std::string& name, const Refit& fit) {
  return {name, fit.error_box(), fit.error_centre(), fit.held_out_error_box, fit.floor_box(), fit.floor_centre(), fit.p_value, fit.scatter};
}

std::vector<Knob> together(const std::vector<Knob>& a, const std::vector<Knob>& b) {
  std::vector<Knob> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

/// Forces that the momentum balance convicts go in first, at the strength that it finds.
void Pipeline::add_momentum_terms() {
  for (const FoundTerm& term : result_.momentum.terms) {
    if (!options_.effects.empty() && std::find(options_.effects.begin(), options_.effects.end(), term.effect) == options_.effects.end()) continue;
    result_.missing.push_back(term.effect);
    const std::string component = term.effect == "constant_acceleration" ? ".x" : "";
    if (term.effect == "oscillating_acceleration") {
      set_number(base_, "oscillating_acceleration.amplitude.x", term.value, options_.known);
      set_number(base_, "oscillating_acceleration.frequency", term.frequency, options_.known);
      set_number(base_, "oscillating_acceleration.phase", term.phase, options_.known);
      continue;
    }
    const std::string key = term.effect + "." + term.parameter + component;
    set_number(base_, key, term.value, options_.known);
    const EffectRecord* record = nullptr;
    for (const EffectRecord* known : options_.known)
      if (known->name == term.effect) record = known;
    const Parameter* parameter = record ? record->find(term.parameter) : nullptr;
    if (parameter == nullptr || (parameter->kind != ParameterKind::number && parameter->kind != ParameterKind::vector)) continue;
    const double error = (term.high - term.low) / 3.92;
    chosen_.push_back({key, term.value, std::max(4 * error, 0.05 * std::abs(term.value)), parameter->low, parameter->high, true});
  }
}

void Pipeline::judge() {
  choose_packing();
  const bool packing_changed = base_.release.packing != user_.release.packing;
  const Refit given = fit("the model as given", {}, 1, 128);
  result_.ladder.push_back(step_of("as given", given));
  final_ = given;
  if (given.p_value > 0.03 && momentum_clean()) {
    result_.verdict = packing_changed ? Verdict::refit : Verdict::adequate;
    return;
  }
  // A force that no list has: the balance names it, and no ensemble can.
  if (result_.momentum.unexplained || result_.momentum.unlisted) return conclude_unknown();
  const double frequency = result_.momentum.possible ? result_.momentum.frequency : user_.spring.frequency;
  theta_ = {{"restitution.grain_grain", base_.restitution.grain_grain, 0.15, 0.2, 0.999, true},
            {"restitution.grain_wall", base_.restitution.grain_wall, 0.15, 0.2, 0.999, true},
            {"spring.frequency", frequency, result_.momentum.possible ? 0.004 * frequency : 0.01 * frequency, 0.5 * frequency, 2 * frequency, true}};
  add_momentum_terms();
  Refit best = fit(chosen_.empty() && result_.missing.empty() ? "refitting the parameters" : "refitting with the forces that the momentum balance convicts",
                   together(theta_, chosen_), 3);
  std::string step = "refitted";
  for (const std::string& effect : result_.missing) step += " + " + effect;
  result_.ladder.push_back(step_of(step, best));
  keep(best);
  while (best.p_value <= rejected && static_cast<int>(result_.missing.size()) < most_effects && add_best_candidate(best)) {
  }
  prune(best);
  if (result_.missing.empty()) result_.verdict = best.p_value > rejected ? Verdict::refit : Verdict::unknown;
  else result_.verdict = Verdict::missing;
  // An effect that leaves most of the misfit is no explanation.
  const double before = result_.ladder.size() > 1 ? result_.ladder[1].scatter : 1;
  if (result_.verdict == Verdict::missing && result_.momentum.terms.empty() && best.p_value <= rejected && best.scatter > 2.5 &&
      best.scatter > 0.6 * before)
    return conclude_unknown();
  if (result_.verdict == Verdict::unknown) conclude_unknown();
}

/// Tries the most promising effects with everything refitted; takes the best when it pays. False: none does.
bool Pipeline::add_best_candidate(Refit& best) {
  std::vector<Candidate> candidates = candidates_for(base_, options_.effects, options_.known);
  // What the momentum balance sees better it has judged already.
  if (result_.momentum.possible) std::erase_if(candidates, [](const Candidate& candidate) { return candidate.seen_by_momentum; });
  stage_ = "ranking the effects";
  const std::vector<Knob> fitted = together(theta_, chosen_);
  const std::vector<ScreenedEffect> screened = screen(features(), fitted, candidates, workshop_, 400, 100000 * ++batch_);
  for (const ScreenedEffect& effect : screened) result_.ranking.push_back({effect.effect, effect.gain, std::nan(""), std::nan(""), effect.value, effect.look_alikes});
  const Setup before = base_;
  Refit winner = best;
  Setup winning_setup = base_;
  std::vector<Knob> winning_knobs;
  std::string winning_effect;
  int tried = 0;
  for (const ScreenedEffect& effect : screened) {
    if (tried >= 5 || result_.runs_simulated > options_.budget) break;
    if (effect.gain < least_gain / 2) continue;
    const Candidate& candidate = candidates[effect.candidate];
    base_ = prepared(before, candidate, options_.known);
    std::vector<Knob> added = candidate.knobs;
    for (Knob& knob : added) {  // start where the linear estimate points
      knob.centre = std::clamp(effect.value, knob.low, knob.high);
      knob.width = std::max(knob.width, 0.5 * std::abs(effect.value));
    }
    ++tried;
    std::vector<Knob> wide = fitted;
    for (Knob& knob : wide)
      if (knob.key.starts_with("restitution")) knob.width = 0.12;
    const Refit with = fit("trying " + candidate.effect, together(wide, added), 2, 160);
    for (RankedEffect& ranked : result_.ranking)
      if (ranked.effect == effect.effect && std::isnan(ranked.held_out_gain)) {
        ranked.gain = best.chi2 - with.chi2;
        ranked.held_out_gain = best.held_out_chi2 - with.held_out_chi2;
        ranked.standard_error = 2 * std::sqrt(std::abs(ranked.held_out_gain));
        ranked.value = with.values.size() > fitted.size() ? with.values.back().value : 0;
      }
    if (with.scatter < winner.scatter) {
      winner = with;
      winning_setup = base_;
      winning_knobs = added;
      winning_effect = candidate.effect;
    }
  }
  base_ = before;
  const double gain = (best.scatter - winner.scatter) * winner.degrees;
  if (winning_effect.empty() || gain < least_gain * std::max(1.0, winner.scatter) || gain < least_share * best.scatter * winner.degrees) return false;
  base_ = winning_setup;
  for (const Knob& knob : winning_knobs) chosen_.push_back(knob);
  result_.missing.push_back(winning_effect);
  keep(winner);
  best = fit("refitting with " + winning_effect, together(theta_, chosen_), 2);
  keep(best);
  std::string step = "refitted";
  for (const std::string& effect : result_.missing) step += " + " + effect;
  result_.ladder.push_back(step_of(step, best));
  return true;
}

/// Each effect but the last must still be needed beside those added after it.
void Pipeline::prune(Refit& best) {
  if (result_.missing.size() < 2) return;
  for (std::size_t i = 0; i + 1 < result_.missing.size(); ++i) {
    const std::string effect = result_.missing[i];
    if (std::any_of(result_.momentum.terms.begin(), result_.momentum.terms.end(), [&](const FoundTerm& t) { return t.effect == effect; })) continue;
    const Setup before = base_;
    std::erase_if(base_.effects, [&](const EffectChoice& choice) { return choice.record->name == effect; });
    std::vector<Knob> rest = chosen_;
    std::erase_if(rest, [&](const Knob& knob) { return effect_of(knob.key) == effect; });
    const Refit without = fit("is " + effect + " still needed?", together(theta_, rest), 2, 160);
    if (without.p_value <= rejected && (without.scatter - best.scatter) * best.degrees > least_gain) {
      base_ = before;
      continue;
    }
    chosen_ = rest;
    result_.missing.erase(result_.missing.begin() + static_cast<std::ptrdiff_t>(i));
    best = without;
    keep(best);
    result_.ladder.push_back(step_of("without " + effect, best));
    return prune(best);
  }
}

void Pipeline::conclude_unknown() {
  result_.verdict = Verdict::unknown;
  result_.missing.clear();
  if (result_.momentum.formulas.empty()) return;
  const ForceFormula& found = result_.momentum.formulas.front();
  std::string constants;
  for (const FormulaConstant& c : found.constants)
    constants += (constants.empty() ? "" : ", ") + c.name + " = \"" + write_quantity(c.value, c.unit) + "\"";
  result_.force_formula = "[[effect]]\nname = \"user_force\"\non = \"box\"\nforce = \"" + found.formula + "\"\nconstants = {" + constants + "}\n";
  for (const std::string& alike : found.look_alikes) result_.notes.push_back("the force could as well be " + alike);
}

std::string unit_of(const std::string& key, std::span<const EffectRecord* const> known) {
  const std::string first = key.substr(0, key.find('&'));
  if (const SetupKey* found = find_setup_key(first)) return std::string(found->unit.empty() ? "" : found->unit == "Hz" ? "Hz" : found->unit);
  for (const EffectRecord* record : known)
    if (record->name == effect_of(first)) {
      std::string parameter = first.substr(first.find('.') + 1);
      if (const std::size_t dot = parameter.find('.'); dot != parameter.npos) parameter.resize(dot);
      if (const Parameter* found = record->find(parameter)) return std::string(found->unit);
    }
  return "";
}

void Pipeline::finish() {
  result_.amended = base_;
  for (const FittedValue& value : final_.values) {
    std::string keys = value.key;
    for (std::size_t at = 0; at < keys.size();) {
      const std::size_t end = std::min(keys.find('&', at), keys.size());
      const std::string key = keys.substr(at, end - at);
      result_.parameters.push_back({key, value.value, value.low, value.high, unit_of(key, options_.known), ""});
      set_number(result_.amended, key, value.value, options_.known);
      at = end + 1;
    }
  }
  result_.sentence = "";
  const auto percent = [](double p) { return std::to_string(static_cast<int>(std::round(100 * p))) + " %"; };
  switch (result_.verdict) {
    case Verdict::adequate:
      result_.sentence = "The model holds as given: what remains is within camera noise and the spread from run to run (" +
                         percent(final_.p_value) + " of the model's own runs fit no better).";
      break;
    case Verdict::refit: result_.sentence = "No effect is missing: other values of the parameters explain the measurements."; break;
    case Verdict::missing: {
      std::string names;
      for (const std::string& effect : result_.missing) names += (names.empty() ? "" : " and ") + effect;
      result_.sentence = "Missing in the model: " + names + ". With it the rms error of the box falls from " +
                         std::to_string(result_.ladder.front().error_box * 1e3).substr(0, 4) + " to " +
                         std::to_string(final_.error_box() * 1e3).substr(0, 4) + " mm (noise and run-to-run spread: " +
                         std::to_string(final_.floor_box() * 1e3).substr(0, 4) + " mm).";
      break;
    }
    case Verdict::unknown:
      result_.sentence = result_.momentum.unexplained || result_.momentum.unlisted
                             ? "Something that is not in the library acts on the box: no known force brings the momentum balance into order."
                             : "None of the known effects explains the measurements; momentum is in order, so it lies inside the contacts.";
      break;
  }
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate: return "adequate";
    case Verdict::refit: return "refit";
    case Verdict::missing: return "missing";
    case Verdict::unknown: return "unknown";
  }
  return "";
}

Diagnosis diagnose(const Setup& setup, const Experiment& experiment, const Engine& engine, const DiagnoseOptions& options) {
  return Pipeline(setup, experiment, engine, options).run();
}

}  // namespace shakedown
