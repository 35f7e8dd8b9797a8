// SPDX-License-Identifier: MIT
#include "sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "key_unit.hpp"
#include "known_effects.hpp"
#include "quantity.hpp"
#include "rules.hpp"
#include "unlisted_force.hpp"
#include "verdict.hpp"

namespace shakedown {

namespace {

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string rounded(double value, const std::string& unit) {
  const double near = std::stod(fmt::format("{:.3g}", value));
  return unit.empty() ? write_number(near) : write_quantity(near, unit);
}

/// Returns "linear damping of the box (blade_viscous_damping), 0.05 N s/m".
std::string named(const std::string& effect, const Diagnosis& d, KnownEffects known) {
  const EffectRecord* record = known.find(effect);
  std::string words =
      record && !record->label.empty() ? std::string(record->label) + " (" + effect + ")" : effect;
  for (const DiagnosedParameter& parameter : d.parameters)
    if (effect_of(parameter.name) == effect && parameter.word.empty())
      return words + ", " + rounded(parameter.value, unit_of_key(parameter.name, known));
  return words;
}

std::string list_of(const std::vector<std::string>& names) {
  std::string words;
  for (const std::string& name : names) words += (words.empty() ? "" : "; ") + name;
  return words;
}

/// Says what becomes of the error of the box or, where that shows more (a camera's bias), of the grains'
/// centre.
std::string what_it_brings(const Diagnosis& d) {
  if (d.ladder.size() < 2) return "";
  const LadderStep &given = d.ladder.front(), &last = d.ladder.back();
  const double box = last.error_box / given.error_box, centre = last.error_centre / given.error_centre;
  constexpr double hardly = 0.9;
  const bool of_centre = box > hardly && centre < box;
  const double before = 1e3 * (of_centre ? given.error_centre : given.error_box),
               after = 1e3 * (of_centre ? last.error_centre : last.error_box);
  if (!std::isfinite(before) || !std::isfinite(after)) return "";
  return fmt::format(
      " The rms error of the {} {} from {:.2f} mm (as given) to {:.2f} mm; noise and run-to-run spread make "
      "{:.2f} mm.",
      of_centre ? "grains' centre" : "box", after <= before ? "falls" : "rises", before, after,
      1e3 * (of_centre ? last.floor_centre : last.floor_box));
}

/// Says what a model that does not hold leaves.
std::string what_remains(const Diagnosis& d) {
  if (d.judgement.standing != Standing::fails) return "";
  return fmt::format(
      " What was found explains {} of the misfit as given; with it the model still does not hold ({}).",
      percent(std::clamp(d.explained, 0.0, 1.0)), d.judgement.reason);
}

std::string ties_in_words(const Diagnosis& d) {
  std::vector<std::string> ties;
  // Something in no list is never ruled out: it is worth a word where it is as probable as what an answer
  // leaves out.
  const auto hardly = [&](const std::string& tie) {
    return tie == unlisted_effect &&
           std::none_of(d.answers.begin(), d.answers.end(), [](const Hypothesis& h) {
             return !h.effects.empty() && h.effects.front() == unlisted_effect &&
                    h.probability > 1 - rules::answer_set;
           });
  };
  const bool said = d.verdict == Verdict::unknown;  // that nothing known explains it
  for (const std::string& tie : ties_of(d.answers))
    if (std::find(d.missing.begin(), d.missing.end(), tie) == d.missing.end() && !hardly(tie) &&
        !(said && tie == unlisted_effect))
      ties.push_back(tie);
  if (ties.empty()) return "";
  // Name the most probable ones; the table has them all.
  constexpr std::size_t most_named = 4;
  std::string words = " These measurements do not rule out ";
  const std::size_t named = ties.size() > most_named + 1 ? most_named : ties.size();
  for (std::size_t i = 0; i < named; ++i)
    words += (i == 0                                 ? ""
              : i + 1 < named || named < ties.size() ? ", "
                                                     : " or ") +
             (ties[i] == unlisted_effect ? "something in no list" : ties[i]);
  if (named < ties.size()) words += fmt::format(" or {} less probable ones", ties.size() - named);
  if (d.missing.empty()) return words + ".";
  const TieKind kind = kind_of(ties, d.missing, d.answers);
  const std::string_view it = d.missing.size() > 1 ? "them" : "it";
  return words +
         (kind.beside && kind.instead ? " beside or instead of "
          : kind.beside               ? " beside "
                                      : " instead of ") +
         std::string(it) + ".";
}

bool is_empty(const Diagnosis& d) { return d.amended.grains.count == 0; }

/// Names known effects that were found beside a force of no list.
std::string beside_the_unknown(const Diagnosis& d, KnownEffects known) {
  std::vector<std::string> names;
  for (const std::string& effect : d.missing) names.push_back(named(effect, d, known));
  return names.empty() ? "" : ", beside " + list_of(names);
}

std::string of_the_unknown(const Diagnosis& d, KnownEffects known) {
  const MomentumAudit& balance = d.momentum;
  if (balance.unlisted)
    return "Something that is not in the library acts on the " +
           std::string(has_force_on_grains(d.amended) ? "grains" : "box") + beside_the_unknown(d, known) +
           ": no known force alone brings the momentum balance into order.";
  const bool much = p_value_of_left(d.left) < 1;
  if (much && is_empty(d))
    return "None of the known effects explains the motion: " + d.judgement.reason + ".";
  if (!balance.possible)
    return "None of the known effects explains the measurements; there is no momentum balance to tell a "
           "force "
           "on the box from contacts (" +
           balance.why_not + ").";
  if (balance.unexplained)
    return fmt::format(
        "None of the known effects brings the momentum balance into order (p = {:.2g}); what was found "
        "explains "
        "{} of its misfit.",
        balance.final_fit.p_value, percent(std::max(0.0, balance.explained)));
  return "None of the known effects explains the measurements; momentum is in order, so the cause lies "
         "inside "
         "the contacts.";
}

/// Says what is most probable, where there was no time to fit it.
std::string of_what_was_not_fitted(const Diagnosis& d, KnownEffects known) {
  std::vector<std::string> names;
  for (const std::string& effect : d.missing) names.push_back(named(effect, d, known));
  return fmt::format(
      "Most probably missing in the model: {} ({}), by simulations at a few strengths; there was no time to "
      "fit {}, so that the model with it was not checked (ask again with more --seconds or --budget).",
      list_of(names), percent(d.hypotheses.front().probability), d.promised->effect);
}

std::string of_the_restitution(const Diagnosis& d) {
  if (!d.free_restitution) return "";
  const LadderStep &without = d.free_restitution->without, &with = d.free_restitution->with;
  std::string held_out;
  if (std::isfinite(with.held_out_error_box) && std::isfinite(without.held_out_error_box))
    held_out = fmt::format(", and of lengths that it was not fitted to {:.2f} mm instead of {:.2f}",
                           1e3 * with.held_out_error_box, 1e3 * without.held_out_error_box);
  return fmt::format(
      " A restitution that depends on the closing speed, of no assumed form, leaves {:.2f} mm of the box "
      "instead of {:.2f} (noise and run-to-run spread {:.2f} mm){}: it {}.",
      1e3 * with.error_box, 1e3 * without.error_box, 1e3 * with.floor_box, held_out,
      words_of(d.free_restitution->curve));
}

std::string of_the_measurement(const Diagnosis& d, KnownEffects known) {
  std::vector<std::string> names;
  for (const NuisanceFound& nuisance : standing_out(d.camera)) names.push_back(words_of(nuisance, known));
  return "No effect is missing: errors of camera, clock or balance within what such things have explain the "
         "measurements: " +
         list_of(names) + ".";
}

std::string of_the_wander(const MomentumAudit& balance) {
  if (!balance.possible || !balance.wanders_much()) return "";
  return fmt::format(
      " The track itself wanders by {:.2g} mm over {:.2g} s, {:.2g} times the white noise of its frames: "
      "look at "
      "how it was tracked.",
      balance.wander.deviation * 1e3, balance.wander.time, balance.wander.deviation / balance.white_noise);
}

std::string first_words(const Diagnosis& d, KnownEffects known);

}  // namespace

std::string words_of(const NuisanceFound& nuisance, KnownEffects known) {
  const std::string key = nuisance.name.substr(0, nuisance.name.find(' '));
  const EffectRecord* record = known.find(effect_of(key));
  const std::string label = record && !record->label.empty() ? std::string(record->label) : nuisance.name;
  return label + " " + rounded(nuisance.value, nuisance.unit) + " +- " +
         rounded(nuisance.error, nuisance.unit);
}

std::string sentence_of(const Diagnosis& d, KnownEffects known) {
  return first_words(d, known) + of_the_wander(d.momentum);
}

namespace {

/// " (p = 0.4)"; nothing where a waveform was judged, which has no p-value.
std::string p_in_words(double p_value) {
  return std::isfinite(p_value) ? fmt::format(" (p = {:.2g})", p_value) : "";
}

std::string first_words(const Diagnosis& d, KnownEffects known) {
  switch (d.verdict) {
    case Verdict::adequate:
      return "The model holds as given: what remains is within camera noise and the spread from run to run" +
             p_in_words(d.ladder.back().p_value) + ".";
    case Verdict::refit:
      return "No effect is missing: other values of the parameters explain the measurements." +
             what_it_brings(d) + ties_in_words(d);
    case Verdict::measurement: return of_the_measurement(d, known);
    case Verdict::missing: {
      if (d.promised) return of_what_was_not_fitted(d, known) + ties_in_words(d);
      std::vector<std::string> names;
      for (const std::string& effect : d.missing) names.push_back(named(effect, d, known));
      return "Missing in the model: " + list_of(names) + "." + what_it_brings(d) + ties_in_words(d) +
             what_remains(d) + of_the_restitution(d);
    }
    case Verdict::unknown: return of_the_unknown(d, known) + of_the_restitution(d) + ties_in_words(d);
  }
  return "";
}

}  // namespace

}  // namespace shakedown
