// SPDX-License-Identifier: MIT
// What a diagnosis says in the end: the sentence, the parameters, the formula of an unknown force and the
// experiment to do next.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "key_unit.hpp"
#include "known_effects.hpp"
#include "next_experiment.hpp"
#include "pipeline.hpp"
#include "quantity.hpp"
#include "setup_keys.hpp"

namespace shakedown {

/// The experiment that would tell what these data tell badly.
void Pipeline::advise_experiments() {
  std::vector<std::string>& list = result_.next_experiments;
  for (const FoundTerm& term : result_.momentum.terms)
    if (!term.look_alikes.empty())
      list.push_back("the box alone, grains.count = 0, ringing down: tells " + term.effect + " from " +
                     term.look_alikes.front() + " without any grains");
  if (result_.verdict == Verdict::unknown)
    list.push_back(result_.force_formula.empty() ? "the same box with half the grains and with none: what "
                                                   "stays acts on the box, what goes lies in the contacts"
                                                 : "the box alone, grains.count = 0, ringing down: shows "
                                                   "whether the force acts on the box or on the grains");
  for (const FittedValue& value : final_.values)
    if (refitted_ && value.key.starts_with("restitution") && value.error > 0.03) {
      list.push_back(
          "N = 20, L = 40 mm: tells the two restitutions apart, which these runs know only together (" +
          value.key + " +- " + write_number(std::round(value.error * 1e3) / 1e3) + ")");
      break;
    }
  if (result_.verdict != Verdict::missing || !runner_up_ ||
      std::find(result_.missing.begin(), result_.missing.end(), runner_up_->added) == result_.missing.end())
    return;
  stage_ = "which experiment would decide";
  FittedModel found = fitted_model(result_.amended, final_);
  found.setup.hard = base_.hard;
  const RunAudit& camera = audit_.runs.front();
  const std::vector<Design> designs = possible_designs(result_.amended, features());
  const int count = dear_ ? 32 : 64;
  for (const Advice& advice : advise(designs, found, runner_up_->setup, camera.box.standard_deviation,
                                     camera.com.standard_deviation, workshop_, count, 100000 * ++batch_))
    if (list.size() < 4 && advice.sigmas > 1)
      list.push_back(advice.words + ": tells " + runner_up_->added + " from " + runner_up_->effect + " at " +
                     write_number(std::round(advice.sigmas * 10) / 10) + " sigma a run");
}

void Pipeline::conclude_unknown() {
  result_.verdict = Verdict::unknown;
  result_.missing.clear();
  if (result_.momentum.formulas.empty()) return;
  const ForceFormula& found = result_.momentum.formulas.front();
  std::string constants;
  for (const FormulaConstant& c : found.constants)
    constants += (constants.empty() ? "" : ", ") + c.name + " = \"" + write_quantity(c.value, c.unit) + "\"";
  result_.force_formula = "[[effect]]\nname = \"user_force\"\non = \"box\"\nforce = \"" + found.formula +
                          "\"\nconstants = {" + constants + "}\n";
  for (const std::string& alike : found.look_alikes)
    result_.notes.push_back("the force could as well be " + alike);
}

/// What the momentum balance asks for joins what was simulated; what was found first, then by gain.
void Pipeline::complete_ranking() {
  if (!result_.momentum.unlisted)
    for (const FoundTerm& term : result_.momentum.terms)
      result_.ranking.push_back(
          {term.effect, term.gain, std::nan(""), std::nan(""), term.value, term.look_alikes, true, true});
  const auto place = [&](const RankedEffect& ranked) {
    return std::find(result_.missing.begin(), result_.missing.end(), ranked.effect) - result_.missing.begin();
  };
  std::stable_sort(result_.ranking.begin(), result_.ranking.end(),
                   [&](const RankedEffect& a, const RankedEffect& b) {
                     return place(a) != place(b) ? place(a) < place(b) : a.gain > b.gain;
                   });
}

/// Data may be of either engine's kind: the strength of an effect in which the engines differ is uncertain by
/// that much more. Of several strengths each by what the strongest is, for what the engines differ by may be
/// any one's.
FittedValue Pipeline::allowing_for_engines(FittedValue value) {
  const std::string effect(effect_of(value.key));
  const auto here = std::find_if(first_boxes_.begin(), first_boxes_.end(),
                                 [&](const Knob& knob) { return knob.key == value.key; });
  const double relative = options_.strength_uncertainty ? options_.strength_uncertainty(effect) : 0;
  if (here == first_boxes_.end() || relative == 0) return value;
  const double absent = effect == "side_wall_restitution" ? base_.restitution.grain_wall : 0;
  double strongest = 0;
  for (const FittedValue& other : final_.values)
    if (effect_of(other.key) == effect) strongest = std::max(strongest, std::abs(other.value - absent));
  const double more = 1.96 * relative * strongest;
  value.low = std::max(here->low, value.value - std::hypot(value.value - value.low, more));
  value.high = std::min(here->high, value.value + std::hypot(value.high - value.value, more));
  const std::string note =
      "the interval of " + effect + " allows for " + write_number(std::round(100 * relative)) +
      " % by which hard impulses and soft contacts differ in it (shakedown effects " + effect + ")";
  // Once for all the strengths of an effect.
  if (std::find(result_.notes.begin(), result_.notes.end(), note) == result_.notes.end())
    result_.notes.push_back(note);
  return value;
}

/// The fall of the error, of the box or where that shows more (a camera's bias) of the grains' centre.
std::string Pipeline::what_it_brings() const {
  const LadderStep& given = result_.ladder.front();
  const double box = final_.error_box() / given.error_box,
               centre = final_.error_centre() / given.error_centre;
  const bool of_centre = box > 0.9 && centre < box;
  return fmt::format(
      "With it the rms error of the {} falls from {:.2f} to {:.2f} mm (noise and run-to-run spread: {:.2f} "
      "mm).",
      of_centre ? "grains' centre" : "box", 1e3 * (of_centre ? given.error_centre : given.error_box),
      1e3 * (of_centre ? final_.error_centre() : final_.error_box()),
      1e3 * (of_centre ? final_.floor_centre() : final_.floor_box()));
}

std::string Pipeline::what_is_unknown() const {
  const MomentumAudit& balance = result_.momentum;
  if (balance.unexplained || balance.unlisted)
    return "Something that is not in the library acts on the box: no known force brings the momentum balance "
           "into order.";
  const std::string nothing = "None of the known effects explains the measurements; ";
  if (!balance.possible)
    return nothing + "there is no momentum balance to tell a force from outside from contacts (" +
           balance.why_not + ").";
  if (!balance.terms.empty())
    return nothing + "the momentum balance asks for " + balance.terms.front().effect +
           ", which does not explain them, is out of its bounds, or was left out.";
  return nothing + "momentum is in order, so it lies inside the contacts.";
}

/// Known effects that explain these measurements as well as this one: "a or b"; empty: none.
std::string Pipeline::told_from_by_nothing(const std::string& effect) const {
  std::vector<std::string> others;
  const auto add = [&](const std::string& other) {
    const bool new_here =
        std::find(others.begin(), others.end(), other) == others.end() &&
        std::find(result_.missing.begin(), result_.missing.end(), other) == result_.missing.end();
    if (new_here && find_record(options_.known, other) != nullptr) others.push_back(other);
  };
  for (const auto& [named, other] : twins_)
    if (named == effect) add(other);
  for (const FoundTerm& term : result_.momentum.terms)
    if (term.effect == effect)
      for (const std::string& other : term.look_alikes) add(other);
  std::string words;
  for (const std::string& other : others) words += (words.empty() ? "" : " or ") + other;
  return words;
}

void Pipeline::finish() {
  complete_ranking();
  result_.amended = base_;
  result_.amended.hard = user_.hard;
  for (const FittedValue& fitted : final_.values) {
    if (!refitted_) break;  // as given, within what codes differ by: nothing to change
    const FittedValue value = allowing_for_engines(fitted);
    for (const std::string& key : joined_keys(value.key)) {
      result_.parameters.push_back(
          {key, value.value, value.low, value.high, unit_of_key(key, options_.known), ""});
      set_number(result_.amended, key, value.value, options_.known);
    }
  }
  result_.sentence = "";
  const auto percent = [](double p) { return std::to_string(static_cast<int>(std::round(100 * p))) + " %"; };
  switch (result_.verdict) {
    case Verdict::adequate:
      result_.sentence =
          "The model holds as given: what remains is within camera noise and the spread from run to run (" +
          percent(final_.p_value) + " of the model's own runs fit no better).";
      break;
    case Verdict::refit:
      result_.sentence =
          refitted_ ? "No effect is missing: other values of the parameters explain the measurements."
                    : "No effect is missing: with the grains laid in another packing ('" +
                          std::string(name_of(base_.release.packing)) + "') the model holds as given (" +
                          percent(final_.p_value) + " of its own runs fit no better).";
      break;
    case Verdict::missing: {
      std::string names;
      for (const std::string& effect : result_.missing) names += (names.empty() ? "" : " and ") + effect;
      result_.sentence = "Missing in the model: " + names + ". " + what_it_brings();
      for (const std::string& effect : result_.missing)
        if (const std::string others = told_from_by_nothing(effect); !others.empty())
          result_.sentence += " These measurements cannot tell " + effect + " from " + others + ".";
      if (final_.p_value <= rejected && final_.scatter >= codes_differ)
        result_.sentence += fmt::format(
            " The data still reject the model (p = {:.3f}): something else is missing that no known effect "
            "mends.",
            final_.p_value);
      break;
    }
    case Verdict::unknown: result_.sentence = what_is_unknown(); break;
  }
}

}  // namespace shakedown
