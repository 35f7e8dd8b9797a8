// SPDX-License-Identifier: MIT
#include "diagnosis.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <tuple>

#include "known_effects.hpp"
#include "packing_choice.hpp"
#include "parameter_knobs.hpp"
#include "pipeline.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

/// Errors of the box in floors (noise and run-to-run spread) that what is explained leaves at most: right
/// answers left up to 1.5, charged grains called a blade's arc 5 to 15.
constexpr double explained_to = 4;

/// Of a term with its 95 % interval.
double error_of(const FoundTerm& term) { return (term.high - term.low) / 3.92; }

Audit audited(const Experiment& experiment, MethodFault fault) {
  Audit found = audit(experiment);
  if (fault == MethodFault::noise_tenfold)
    for (RunAudit& run : found.runs) run.box.standard_deviation *= 10, run.com.standard_deviation *= 10;
  return found;
}

}  // namespace

Pipeline::Pipeline(const Setup& setup, const Experiment& experiment, const Engine& engine,
                   const DiagnoseOptions& options)
    : user_(setup),
      base_(setup),
      experiment_(experiment),
      options_(options),
      budget_(options.budget > 0 ? options.budget : usual_budget(setup, experiment, options.known)),
      audit_(audited(experiment, options.fault)) {
  workshop_ = {&engine, options.known,           options.threads, options.stop,
               {},      &result_.runs_simulated, &pool_,          options.fault};
  workshop_.journal = options.journal;
  workshop_.done = [this](int) {
    if (options_.progress && result_.runs_simulated % 64 == 0)
      options_.progress(stage_, static_cast<double>(result_.runs_simulated) / static_cast<double>(budget_));
  };
}

Diagnosis Pipeline::run() {
  // Ensembles see no difference up to here, and low restitutions and drag on grains cost several times less.
  base_.hard.pair_elastic_speed = std::max(base_.hard.pair_elastic_speed, quick_elastic_speed);
  base_.hard.kick_interval = std::max(base_.hard.kick_interval, quick_kick_interval);
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

void Pipeline::choose_packing() {
  const auto [packing, apart, fits] = packing_before_release(user_, experiment_, audit_, options_.known);
  if (!fits)
    result_.notes.push_back(
        "before release the grains' centre lies " + write_quantity(std::round(apart * 1e4) / 1e4, "mm") +
        " from where any packing has it: how the grains lay is unknown, and what acts on the first strokes "
        "alone "
        "(camera_scale, initial_box_velocity, camera_time_offset) may be that; give the runs their own "
        "initial_grains");
  if (packing == user_.release.packing) return;
  base_.release.packing = packing;
  result_.parameters.push_back({"release.packing", 0, 0, 0, "", std::string(name_of(packing))});
  result_.notes.push_back("before release the grains' centre lies where packing '" +
                          std::string(name_of(packing)) + "' has it, not '" +
                          std::string(name_of(user_.release.packing)) + "'");
}

Refit Pipeline::fit(const std::string& step, const std::vector<Knob>& knobs, Effort effort,
                    const Refit* judged_by, double look_again_below) {
  stage_ = step;
  if (dear_)
    effort.count = std::min(effort.count, most_when_dear),
    effort.confirming = std::min(effort.confirming, most_when_dear);
  RefitOptions options;
  options.rounds = effort.rounds;
  options.count = effort.count;
  options.judged_by = judged_by;
  options.confirming = effort.confirming;
  options.look_again_below = look_again_below;
  // What others must beat is looked for with more effort than they are.
  if (effort.beside) options.look_beside_below = doubtful;
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
  return {name,
          fit.error_box(),
          fit.error_centre(),
          fit.held_out_error_box,
          fit.floor_box(),
          fit.floor_centre(),
          fit.p_value,
          fit.scatter};
}

std::vector<Knob> together(const std::vector<Knob>& a, const std::vector<Knob>& b) {
  std::vector<Knob> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

/// The balance finds what is lacking beyond what the setup has of an effect.
double Pipeline::whole_strength(const FoundTerm& term, const std::string& key) const {
  if (!find_choice(base_, term.effect)) return term.value;
  const double already = get_number(base_, key, options_.known);
  if (term.effect == "camera_com_bias") return 1 - (1 - already) * (1 - term.value);
  if (term.effect == "camera_arc") return 1 / std::hypot(1 / already, 1 / term.value);
  return already + term.value;
}

std::string key_of(const FoundTerm& term) {
  return term.effect + "." + term.parameter + (term.effect == "constant_acceleration" ? ".x" : "");
}

bool Pipeline::possible(const FoundTerm& term) const {
  const EffectRecord* record = find_record(options_.known, term.effect);
  const Parameter* parameter = record ? record->find(term.parameter) : nullptr;
  if (parameter == nullptr) return true;
  // Two sines are no sine.
  if (term.effect == "oscillating_acceleration") return !find_choice(base_, term.effect);
  const double value = whole_strength(term, key_of(term));
  return value >= parameter->low && value <= parameter->high;
}

/// A sine is known to its error in all three: over a run of length T a relative error of the amplitude goes
/// with sqrt(6) / (pi T) as much in the frequency, and twice as much in the phase at the release (rad).
void Pipeline::add_sine(const FoundTerm& term) {
  double longest = 0;
  for (const MeasuredRun& run : experiment_.runs)
    if (!run.time.empty()) longest = std::max(longest, run.time.back() - run.time.front());
  const double error = std::max(error_of(term), 0.01 * std::abs(term.value)),
               relative = std::min(1.0, error / std::abs(term.value));
  const auto knob = [&](const char* key, double value, double known_to) {
    set_number(base_, key, value, options_.known);
    const double width = 4 * known_to;
    chosen_.push_back({key, value, width, value - 10 * width, value + 10 * width, false, value,
                       balance_is_believed * known_to});
  };
  knob("oscillating_acceleration.amplitude.x", term.value, error);
  knob("oscillating_acceleration.frequency", term.frequency, relative * 0.78 / std::max(longest, 1.0));
  knob("oscillating_acceleration.phase", term.phase, 2 * relative);
}

/// Forces that the momentum balance convicts go in first, at the strength that it finds, and stay near it:
/// chaos does not touch the balance, and it knows them five times better than the ensembles do, which would
/// bend them to take up what else is missing.
void Pipeline::add_momentum_terms() {
  const std::vector<FoundTerm>& terms = result_.momentum.terms;
  for (const FoundTerm& term : terms) {
    // A drag that pushes, a mass below zero: no such effect, though the balance takes it.
    if (!possible(term)) continue;
    if (!options_.effects.empty() &&
        std::find(options_.effects.begin(), options_.effects.end(), term.effect) == options_.effects.end())
      continue;
    // Of several sines the strongest.
    if (std::any_of(terms.begin(), terms.end(), [&](const FoundTerm& other) {
          return other.effect == term.effect && other.gain > term.gain;
        }))
      continue;
    const std::string key = key_of(term);
    const bool had_already = find_choice(base_, term.effect) != nullptr;
    if (had_already)
      result_.notes.push_back("the momentum balance asks for another " + key + ": it is refitted");
    else
      result_.missing.push_back(term.effect);
    if (term.effect == "oscillating_acceleration") {
      add_sine(term);
      continue;
    }
    const double value = whole_strength(term, key);
    set_number(base_, key, value, options_.known);
    // One spring for all runs, whatever their release.
    if (term.effect == "spring_cubic" && !had_already && result_.momentum.reference_displacement > 0)
      set_number(base_, "spring_cubic.reference", result_.momentum.reference_displacement, options_.known);
    const EffectRecord* record = find_record(options_.known, term.effect);
    const Parameter* parameter = record ? record->find(term.parameter) : nullptr;
    if (parameter == nullptr ||
        (parameter->kind != ParameterKind::number && parameter->kind != ParameterKind::vector))
      continue;
    const double error = error_of(term);
    chosen_.push_back({key, value, std::max(4 * error, 0.05 * std::abs(term.value)), parameter->low,
                       parameter->high, true, value, balance_is_believed * error});
  }
}

/// What was looked for beyond that stays in the ranking alone.
void Pipeline::accept_as_given(const Refit& given) {
  result_.verdict = base_.release.packing != user_.release.packing ? Verdict::refit : Verdict::adequate;
  result_.ladder.resize(1);
  refitted_ = false;
  final_ = given;
  note_failures(given);
}

void Pipeline::judge() {
  choose_packing();
  release_scale_ = scale_at_release(user_, experiment_, audit_, options_.known);
  workshop_.ensembles = options_.ensembles;  // every diagnosis of this setup begins with the same simulations
  const Refit given = fit("the model as given", as_given(base_), only_look);
  workshop_.ensembles = nullptr;
  result_.ladder.push_back(step_of("as given", given));
  final_ = given;
  note_failures(given);
  const bool adequate = given.p_value > holds && result_.momentum.holds();
  if (adequate && given.p_value > holds_well) return accept_as_given(given);
  // A force that no list has: the balance names it, and no ensemble can.
  if (result_.momentum.unexplained || result_.momentum.unlisted) return conclude_unknown();
  const double frequency = result_.momentum.possible ? result_.momentum.frequency : user_.spring.frequency;
  refitted_ = true;
  theta_ = free_parameters(base_, frequency, (result_.momentum.possible ? 0.004 : 0.01) * frequency);
  if (options_.fault == MethodFault::no_refit) theta_.clear();
  std::erase_if(theta_, [&](const Knob& knob) {
    return std::find(options_.fixed.begin(), options_.fixed.end(), knob.key) != options_.fixed.end();
  });
  add_momentum_terms();
  Refit best = fit(chosen_.empty() && result_.missing.empty()
                       ? "refitting the parameters"
                       : "refitting with the forces that the momentum balance convicts",
                   together(theta_, chosen_), to_refit);
  std::string step = "refitted";
  for (const std::string& effect : result_.missing) step += " + " + effect;
  result_.ladder.push_back(step_of(step, best));
  keep(best);
  if (result_.missing.empty()) note_failures(best);  // else those of the model as given stay
  // A fit may end along the valley of the restitutions where fresh simulations find nothing gained: effects
  // are to beat the better of the two.
  if (adequate && chosen_.empty() && given.p_value > best.p_value) best = given;
  const auto without_effects = std::tuple(base_, theta_, chosen_, first_boxes_, final_, result_.missing);
  for (bool looked = false, searched = false;;) {
    // An accepted model is searched once: chi2 of hundreds of features does not see what a single effect
    // would take away. Beside what makes every run dear only a model that is rejected is searched on.
    const auto lacking = [&] { return best.p_value <= (dear_ ? rejected : doubtful); };
    while ((!looked || lacking()) && static_cast<int>(result_.missing.size()) < most_effects) {
      looked = true;
      searched = searched || lacking();
      if (!add_best_candidate(best)) break;
    }
    prune(best);
    if (result_.missing.empty() || concluded_) break;
    best = conclude("refitting with what was found", best);
    concluded_ = true;
    keep(best);
    result_.ladder.back() = step_of(result_.ladder.back().step, best);
    if (searched) break;  // else this fit may show what the quick one did not
  }
  if (result_.missing.empty() && adequate) return accept_as_given(given);
  if (result_.missing.empty()) {
    result_.verdict =
        best.p_value > rejected || best.scatter < codes_differ ? Verdict::refit : Verdict::unknown;
  } else
    result_.verdict = Verdict::missing;
  // An effect that leaves most of the misfit, or errors far above the noise, is no explanation, and its
  // strength is not the model's to keep.
  const double before = result_.ladder.size() > 1 ? result_.ladder[1].scatter : 1;
  if (result_.verdict == Verdict::missing && best.p_value <= rejected && best.scatter > 2.5 &&
      (best.scatter > 0.6 * before || best.error_box() > explained_to * best.floor_box())) {
    // what the balance convicts keeps its concluding fit where nothing else was added
    if (result_.missing != std::get<5>(without_effects))
      std::tie(base_, theta_, chosen_, first_boxes_, final_, result_.missing) = without_effects;
    if (result_.missing.empty()) return conclude_unknown();
  }
  if (result_.verdict == Verdict::unknown) return conclude_unknown();
  if (final_.p_value <= rejected && final_.scatter < codes_differ)
    result_.notes.push_back(
        "a small misfit remains, as between two codes of the same physics; no known effect explains it");
}

void Pipeline::note_failures(const Refit& fit) {
  result_.where.clear();
  for (const FailureCell& cell : fit.cells)
    if (cell.p_value < 0.05 && result_.where.size() < most_cells) result_.where.push_back(cell);
}

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate: return "adequate";
    case Verdict::refit: return "refit";
    case Verdict::missing: return "missing";
    case Verdict::unknown: return "unknown";
  }
  return "";
}

std::int64_t usual_budget(const Setup& setup, const Experiment& experiment,
                          std::span<const EffectRecord* const> known) {
  std::set<std::string> different;
  for (Setup& of_run : setups_of_runs(setup, experiment, known)) {
    of_run.run.duration = 1;  // repeats that end at different times share simulations
    different.insert(digest(of_run));
  }
  return 3500 * std::max<std::int64_t>(4, std::ssize(different));
}

Diagnosis diagnose(const Setup& setup, const Experiment& experiment, const Engine& engine,
                   const DiagnoseOptions& options) {
  return Pipeline(setup, experiment, engine, options).run();
}

}  // namespace shakedown
