// SPDX-License-Identifier: MIT
#include "diagnosis.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "experiment_file.hpp"
#include "linear_screen.hpp"
#include "next_experiment.hpp"
#include "packing_choice.hpp"
#include "parameter_knobs.hpp"
#include "quantity.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

/// Below this a model is rejected.
constexpr double rejected = 0.01;
/// Misfit (chi2 over that of the model's own runs) that two codes of the same physics may have: hard and soft friction differ by 1.3.
constexpr double codes_differ = 1.2;
/// Below this an effect with a signature of its own is looked for.
constexpr double doubtful = 0.05;
/// A step up the ladder must bring chi2 down by this much and this share: a free parameter and the choice among some twenty effects.
constexpr double least_gain = 14, least_share = 0.08;
constexpr int most_effects = 3;
constexpr std::size_t most_cells = 12;
constexpr std::size_t most_tried = 4;
/// Differences of chi2 below this are within the emulators' own noise.
constexpr double too_close = 15;
constexpr double quick_elastic_speed = 1e-2;  // m/s

std::string effect_of(const std::string& key) { return key.substr(0, key.find('.')); }

class Pipeline {
 public:
  Pipeline(const Setup& setup, const Experiment& experiment, const Engine& engine, const DiagnoseOptions& options)
      : user_(setup), base_(setup), experiment_(experiment), options_(options), audit_(audit(experiment)) {
    workshop_ = {&engine, options.known, options.threads, options.stop, {}, &result_.runs_simulated};
    workshop_.done = [this](int) {
      if (options_.progress && result_.runs_simulated % 64 == 0)
        options_.progress(stage_, static_cast<double>(result_.runs_simulated) / static_cast<double>(options_.budget));
    };
  }

  Diagnosis run() {
    // Ensembles see no difference up to here, and low restitutions cost several times less.
    base_.hard.pair_elastic_speed = std::max(base_.hard.pair_elastic_speed, quick_elastic_speed);
    const auto start = std::chrono::steady_clock::now();
    result_.notes = audit_.warnings;
    stage_ = "momentum balance";
    result_.momentum = audit_momentum(experiment_, audit_, setups_of_runs(user_, experiment_, options_.known));
    judge();
    finish();
    advise_experiments();
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result_;
  }

 private:
  bool momentum_clean() const { return !result_.momentum.possible || result_.momentum.as_given.p_value > rejected; }

  std::vector<MeasuredFeatures> features() const {
    return features_of(experiment_, audit_, setups_of_runs(base_, experiment_, options_.known));
  }

  void choose_packing();
  void judge();
  Refit fit(const std::string& step, const std::vector<Knob>& knobs, int rounds, int count = 192, const Refit* judged_by = nullptr);
  void add_momentum_terms();
  bool possible(const FoundTerm& term) const;
  /// A candidate that was fitted.
  struct Rival {
    std::string effect;
    double doubt;
    Setup setup;
    std::vector<Knob> knobs;
    Refit fit;
    double gain, held_out_gain;
    bool decided;
    double score() const { return gain + 0.5 * (std::isfinite(held_out_gain) ? std::clamp(held_out_gain, -gain, gain) : 0.0) - doubt; }
  };
  bool add_best_candidate(Refit& best);
  Rival try_candidate(const ScreenedEffect& effect, const Candidate& candidate, const Setup& before, const std::vector<Knob>& fitted, const Refit& best);
  Rival decide(Rival rival, const Refit& best);
  void rank(Rival& rival, const Refit& best);
  void prune(Refit& best);
  void keep(const Refit& refit);
  void finish();
  void conclude_unknown();
  void advise_experiments();
  void note_failures(const Refit& fit);

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
  bool refitted_ = false;
  std::optional<Candidate> runner_up_;  // to the effect added last
  int batch_ = 0;
};

void Pipeline::choose_packing() {
  const Packing packing = packing_before_release(user_, experiment_, audit_, options_.known);
  if (packing == user_.release.packing) return;
  base_.release.packing = packing;
  result_.parameters.push_back({"release.packing", 0, 0, 0, "", std::string(name_of(packing))});
  result_.notes.push_back("before release the grains' centre lies where packing '" + std::string(name_of(packing)) + "' has it, not '" +
                          std::string(name_of(user_.release.packing)) + "'");
}

Refit Pipeline::fit(const std::string& step, const std::vector<Knob>& knobs, int rounds, int count, const Refit* judged_by) {
  stage_ = step;
  RefitOptions options;
  options.rounds = rounds;
  options.count = count;
  options.judged_by = judged_by;
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
          knob.width = std::clamp(2 * value.error, 0.1 * knob.width, knob.width);
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

const EffectRecord* record_of(const std::string& effect, std::span<const EffectRecord* const> known) {
  for (const EffectRecord* record : known)
    if (record->name == effect) return record;
  return nullptr;
}

bool Pipeline::possible(const FoundTerm& term) const {
  const EffectRecord* record = record_of(term.effect, options_.known);
  const Parameter* parameter = record ? record->find(term.parameter) : nullptr;
  return parameter == nullptr || term.effect == "oscillating_acceleration" || (term.value >= parameter->low && term.value <= parameter->high);
}

/// Forces that the momentum balance convicts go in first, at the strength that it finds.
void Pipeline::add_momentum_terms() {
  for (const FoundTerm& term : result_.momentum.terms) {
    // A drag that pushes, a mass below zero: no such effect, though the balance takes it.
    if (!possible(term)) continue;
    if (!options_.effects.empty() && std::find(options_.effects.begin(), options_.effects.end(), term.effect) == options_.effects.end()) continue;
    if (std::find(result_.missing.begin(), result_.missing.end(), term.effect) != result_.missing.end()) continue;  // a second sine
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
    const EffectRecord* record = record_of(term.effect, options_.known);
    const Parameter* parameter = record ? record->find(term.parameter) : nullptr;
    if (parameter == nullptr || (parameter->kind != ParameterKind::number && parameter->kind != ParameterKind::vector)) continue;
    const double error = (term.high - term.low) / 3.92;
    chosen_.push_back({key, term.value, std::max(4 * error, 0.05 * std::abs(term.value)), parameter->low, parameter->high, true});
  }
}

void Pipeline::judge() {
  choose_packing();
  const bool packing_changed = base_.release.packing != user_.release.packing;
  const Refit given = fit("the model as given", as_given(base_), 1, 128);
  result_.ladder.push_back(step_of("as given", given));
  final_ = given;
  note_failures(given);
  if (given.p_value > 0.03 && momentum_clean()) {
    result_.verdict = packing_changed ? Verdict::refit : Verdict::adequate;
    return;
  }
  // A force that no list has: the balance names it, and no ensemble can.
  if (result_.momentum.unexplained || result_.momentum.unlisted) return conclude_unknown();
  const double frequency = result_.momentum.possible ? result_.momentum.frequency : user_.spring.frequency;
  refitted_ = true;
  theta_ = free_parameters(base_, frequency, (result_.momentum.possible ? 0.004 : 0.01) * frequency);
  std::erase_if(theta_, [&](const Knob& knob) { return std::find(options_.fixed.begin(), options_.fixed.end(), knob.key) != options_.fixed.end(); });
  add_momentum_terms();
  Refit best = fit(chosen_.empty() && result_.missing.empty() ? "refitting the parameters" : "refitting with the forces that the momentum balance convicts",
                   together(theta_, chosen_), 3);
  std::string step = "refitted";
  for (const std::string& effect : result_.missing) step += " + " + effect;
  result_.ladder.push_back(step_of(step, best));
  keep(best);
  if (result_.missing.empty()) note_failures(best);  // else those of the model as given stay
  while (best.p_value <= doubtful && static_cast<int>(result_.missing.size()) < most_effects && add_best_candidate(best)) {
  }
  prune(best);
  if (result_.missing.empty()) {
    result_.verdict = best.p_value > rejected || best.scatter < codes_differ ? Verdict::refit : Verdict::unknown;
    if (result_.verdict == Verdict::refit && best.p_value <= rejected)
      result_.notes.push_back("a small misfit remains, as between two codes of the same physics; no known effect explains it");
  }
  else result_.verdict = Verdict::missing;
  // An effect that leaves most of the misfit is no explanation.
  const double before = result_.ladder.size() > 1 ? result_.ladder[1].scatter : 1;
  if (result_.verdict == Verdict::missing && result_.momentum.terms.empty() && best.p_value <= rejected && best.scatter > 2.5 &&
      best.scatter > 0.6 * before)
    return conclude_unknown();
  if (result_.verdict == Verdict::unknown) conclude_unknown();
}

/// Without the effect the restitutions were led astray: the box reaches from there to what the user gave.
std::vector<Knob> covering_the_users_values(std::vector<Knob> knobs) {
  for (Knob& knob : knobs) {
    if (knob.believed_error == 0) continue;
    const double apart = std::abs(knob.centre - knob.believed);
    knob.centre = (knob.centre + knob.believed) / 2;
    knob.width = apart / 2 + 0.08;
  }
  return knobs;
}

/// Tries the most promising effects with everything refitted; takes the best when it pays. False: none does.
bool Pipeline::add_best_candidate(Refit& best) {
  std::vector<Candidate> candidates = candidates_for(base_, options_.effects, options_.known);
  // What the momentum balance sees better it has judged already.
  if (result_.momentum.possible) std::erase_if(candidates, [](const Candidate& candidate) { return candidate.seen_by_momentum; });
  // What showed nothing before is not looked for again.
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return std::any_of(result_.ranking.begin(), result_.ranking.end(), [&](const RankedEffect& r) { return r.effect == candidate.effect; }) &&
           std::none_of(result_.ranking.begin(), result_.ranking.end(),
                        [&](const RankedEffect& r) { return r.effect == candidate.effect && r.gain > least_gain / 3; });
  });
  stage_ = "ranking the effects";
  const std::vector<Knob> fitted = together(theta_, chosen_);
  std::vector<ScreenedEffect> screened = screen(features(), fitted, candidates, workshop_, 320, 100000 * ++batch_);
  for (const ScreenedEffect& effect : screened) result_.ranking.push_back({effect.effect, effect.gain, std::nan(""), std::nan(""), effect.value, effect.look_alikes});
  const Setup before = base_;
  std::vector<Rival> rivals;
  const auto promise = [&](const ScreenedEffect& effect) { return effect.gain - candidates[effect.candidate].doubt; };
  std::stable_sort(screened.begin(), screened.end(), [&](const ScreenedEffect& a, const ScreenedEffect& b) { return promise(a) > promise(b); });
  double best_score = 0;
  for (const ScreenedEffect& effect : screened) {
    if (rivals.size() >= most_tried || result_.runs_simulated > options_.budget) break;
    // Linear gains rank well enough to leave out what promises half of what another has already brought.
    if (effect.gain < least_gain / 2 || promise(effect) < std::max(0.25 * promise(screened.front()), 0.5 * best_score)) continue;
    try {
      rivals.push_back(try_candidate(effect, candidates[effect.candidate], before, fitted, best));
      best_score = std::max(best_score, rivals.back().score());
    } catch (const PhysicsError& error) {
      result_.notes.push_back(effect.effect + " could not be tried: " + error.what());
    }
  }
  std::stable_sort(rivals.begin(), rivals.end(), [](const Rival& a, const Rival& b) { return a.score() > b.score(); });
  // Too close to call: more simulations for both.
  if (rivals.size() > 1 && rivals[0].score() - rivals[1].score() < too_close && rivals[0].score() > least_gain) {
    rivals.resize(2);
    for (Rival& rival : rivals) rival = decide(rival, best);
    if (rivals[1].score() > rivals[0].score()) std::swap(rivals[0], rivals[1]);
  }
  base_ = before;
  if (rivals.empty()) return false;
  runner_up_.reset();
  if (rivals.size() > 1 && rivals[1].score() > 0)
    for (const Candidate& candidate : candidates)
      if (candidate.effect == rivals[1].effect && !candidate.knobs.empty()) runner_up_ = candidate;
  const Rival& winner = rivals.front();
  // A model that is rejected must be mended; one that is merely doubtful needs a better reason.
  // Beside friction, whose two models leave a difference, too.
  const bool doubt = best.p_value > rejected || std::find(result_.missing.begin(), result_.missing.end(), "grain_friction") != result_.missing.end();
  const double least = doubt ? 2 * least_gain : least_gain;
  if (winner.gain < least * std::max(1.0, winner.fit.scatter) || winner.gain < least_share * best.judged_chi2) return false;
  base_ = winner.setup;
  for (const Knob& knob : winner.knobs) chosen_.push_back(knob);
  result_.missing.push_back(winner.effect);
  keep(winner.fit);
  for (const Knob& knob : chosen_) set_knob(base_, knob, options_.known);  // present from now on, so that it is no candidate again
  best = winner.decided ? winner.fit : fit("refitting with " + winner.effect, together(theta_, chosen_), 2, 256);
  keep(best);
  std::string step = "refitted";
  for (const std::string& effect : result_.missing) step += " + " + effect;
  result_.ladder.push_back(step_of(step, best));
  return true;
}

/// One candidate with everything refitted.
Pipeline::Rival Pipeline::try_candidate(const ScreenedEffect& effect, const Candidate& candidate, const Setup& before, const std::vector<Knob>& fitted,
                                        const Refit& best) {
  base_ = prepared(before, candidate, options_.known);
  std::vector<Knob> added = candidate.knobs;
  for (Knob& knob : added) {  // start where the linear estimate points
    knob.centre = std::clamp(effect.value, knob.low, knob.high);
    knob.width = std::max(knob.width, 0.5 * std::abs(effect.value));
  }
  Rival rival{candidate.effect, candidate.doubt, base_, added, fit("trying " + candidate.effect, together(covering_the_users_values(fitted), added), 2, 160, &best), 0, 0, false};
  rank(rival, best);
  return rival;
}

/// The same again, closer and with more simulations.
Pipeline::Rival Pipeline::decide(Rival rival, const Refit& best) {
  base_ = rival.setup;
  std::vector<Knob> knobs = rival.fit.knobs;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    knobs[k].centre = rival.fit.values[k].value;
    knobs[k].width = std::clamp(2 * rival.fit.values[k].error, 0.3 * knobs[k].width, knobs[k].width);
  }
  rival.fit = fit("comparing " + rival.effect + " closely", knobs, 1, 256, &best);
  rival.decided = true;
  rank(rival, best);
  return rival;
}

void Pipeline::rank(Rival& rival, const Refit& best) {
  rival.gain = best.judged_chi2 - rival.fit.judged_chi2;
  rival.held_out_gain = best.judged_held_out_chi2 - rival.fit.judged_held_out_chi2;
  // The latest entry: an earlier one tells how it stood before other effects joined.
  for (auto entry = result_.ranking.rbegin(); entry != result_.ranking.rend(); ++entry) {
    RankedEffect& ranked = *entry;
    if (ranked.effect != rival.effect) continue;
    ranked.gain = rival.gain;
    ranked.held_out_gain = rival.held_out_gain;
    ranked.standard_error = 2 * std::sqrt(std::abs(rival.held_out_gain));
    ranked.value = rival.knobs.empty() ? 0 : rival.fit.values.back().value;
    break;
  }
}

void Pipeline::note_failures(const Refit& fit) {
  result_.where.clear();
  for (const FailureCell& cell : fit.cells)
    if (cell.p_value < 0.05 && result_.where.size() < most_cells) result_.where.push_back(cell);
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

/// The experiment that would tell what these data tell badly.
void Pipeline::advise_experiments() {
  std::vector<std::string>& list = result_.next_experiments;
  for (const FoundTerm& term : result_.momentum.terms)
    if (!term.look_alikes.empty())
      list.push_back("the box alone, grains.count = 0, ringing down: tells " + term.effect + " from " + term.look_alikes.front() + " without any grains");
  if (result_.verdict == Verdict::unknown)
    list.push_back(result_.force_formula.empty() ? "the same box with half the grains and with none: what stays acts on the box, what goes lies in the contacts"
                                                 : "the box alone, grains.count = 0, ringing down: shows whether the force acts on the box or on the grains");
  for (const FittedValue& value : final_.values)
    if (refitted_ && value.key.starts_with("restitution") && value.error > 0.03) {
      list.push_back("N = 20, L = 40 mm: tells the two restitutions apart, which these runs know only together (" + value.key + " +- " +
                     write_number(std::round(value.error * 1e3) / 1e3) + ")");
      break;
    }
  if (result_.verdict != Verdict::missing || !runner_up_ || chosen_.empty()) return;
  stage_ = "which experiment would decide";
  const std::vector<Knob> found(chosen_.end() - 1, chosen_.end());
  const RunAudit& camera = audit_.runs.front();
  std::vector<Design> designs = possible_designs(result_.amended);
  const std::string effect = effect_of(found.front().key);
  for (Design& design : designs) std::erase_if(design.setup.effects, [&](const EffectChoice& choice) { return choice.record->name == runner_up_->effect; });
  for (const Advice& advice : advise(designs, theta_, found, *runner_up_, camera.box.standard_deviation, camera.com.standard_deviation, workshop_, 96, 100000 * ++batch_))
    if (list.size() < 4 && advice.sigmas > 1)
      list.push_back(advice.words + ": tells " + effect + " from " + runner_up_->effect + " at " + write_number(std::round(advice.sigmas * 10) / 10) + " sigma a run");
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
  result_.amended.hard.pair_elastic_speed = user_.hard.pair_elastic_speed;
  for (const FittedValue& value : final_.values) {
    if (!refitted_) break;  // as given, within what codes differ by: nothing to change
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
