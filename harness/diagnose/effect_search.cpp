// SPDX-License-Identifier: MIT
// Which effect, added and fitted, brings the error down.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "key_unit.hpp"
#include "known_effects.hpp"
#include "next_experiment.hpp"
#include "pipeline.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

/// Share of the misfit that a linear estimate must promise to be tried before what is tried in any case; of
/// what costs ten times as much.
constexpr double goes_first = 0.25, goes_first_when_dear = 0.5;
/// Gain (chi2) that no emulator's noise makes; strengths along curved valleys may have errors as large as
/// themselves all the same.
constexpr double beyond_noise = 100;
/// Standard errors from zero of what counts as there at all, whatever it gains: a fit with an effect of no
/// strength found other restitutions. And of what would otherwise be in question.
constexpr double there_at_all = 0.5, beyond_doubt = 2;
/// Share of the best one's gain that makes a rival one from which an experiment should tell it.
constexpr double contends = 0.5;
/// A rival whose fit leaves more than this p-value has mended the model: what imitates the truth often leaves
/// a misfit that is merely not proven.
constexpr double mends = 0.1;
/// Gain (chi2) of an accepted model beside which what is tried in any case need not be.
constexpr double explains_much = 300;

/// One of the strengths is that many standard errors from zero at least; what replaces a parameter, or is on
/// or off, has no zero and passes.
bool stands_out(const Refit& fit, const std::vector<Knob>& knobs, double errors) {
  return knobs.empty() || std::any_of(knobs.begin(), knobs.end(), [&](const Knob& knob) {
           return knob.low > 0 ||
                  std::any_of(fit.values.begin(), fit.values.end(), [&](const FittedValue& value) {
                    return value.key == knob.key && std::abs(value.value) > errors * value.error;
                  });
         });
}

/// A parameter had to go far from what the user believes: effects inside the contacts hide in the
/// restitutions.
bool has_strayed(const Refit& fit) {
  for (std::size_t k = 0; k < fit.values.size(); ++k)
    if (is_believed(fit.knobs[k]) &&
        std::abs(fit.values[k].value - fit.knobs[k].believed) > 1.5 * fit.knobs[k].believed_error)
      return true;
  return false;
}

bool is_joint(const Knob& knob) { return joined_keys(knob.key).size() > 1; }

/// What moves together, each by itself.
std::vector<Knob> taken_apart(const std::vector<Knob>& knobs) {
  std::vector<Knob> parts;
  for (const Knob& knob : knobs)
    for (const std::string& key : joined_keys(knob.key)) {
      parts.push_back(knob);
      parts.back().key = key;
    }
  return parts;
}

}  // namespace

std::vector<Candidate> Pipeline::open_candidates() const {
  std::vector<Candidate> candidates = candidates_for(base_, options_.effects, options_.known);
  const auto judged_already = [&](const Candidate& candidate) {
    // What the momentum balance sees better it has judged; what showed nothing before is not looked for
    // again, where a linear estimate can show it.
    if (result_.momentum.possible && candidate.seen_by_momentum) return true;
    bool seen = false, promising = false;
    for (const RankedEffect& ranked : result_.ranking)
      if (ranked.effect == candidate.effect && (!candidate.always || ranked.fitted))
        seen = true, promising = promising || ranked.gain > least_gain / 3;
    return seen && !promising;
  };
  std::erase_if(candidates, judged_already);
  return candidates;
}

/// The most promising candidates with everything refitted, best first; the first two closer when they are too
/// close to call.
std::vector<Pipeline::Rival> Pipeline::rivals_among(const std::vector<Candidate>& candidates,
                                                    const Refit& best) {
  stage_ = "ranking the effects";
  const std::vector<Knob> fitted = together(theta_, chosen_);
  const bool accepted = best.p_value > doubtful, strayed = has_strayed(best);
  std::vector<ScreenedEffect> screened = screen(features(), fitted, candidates, workshop_,
                                                dear_ ? ranked_when_dear : to_rank, 100000 * ++batch_);
  for (const ScreenedEffect& effect : screened)
    result_.ranking.push_back(
        {effect.effect, effect.gain, std::nan(""), std::nan(""), effect.value, effect.look_alikes});
  const auto promise = [&](const ScreenedEffect& effect) {
    return effect.gain - candidates[effect.candidate].doubt;
  };
  const auto always = [&](const ScreenedEffect& effect) { return candidates[effect.candidate].always; };
  std::stable_sort(screened.begin(), screened.end(),
                   [&](const ScreenedEffect& a, const ScreenedEffect& b) { return promise(a) > promise(b); });
  std::stable_partition(screened.begin(), screened.end(), always);
  const auto others = std::find_if_not(screened.begin(), screened.end(), always);
  const double most_promised = others == screened.end() ? 0 : promise(*others);
  const std::size_t most_promising = most_promised > 2 * least_gain ? others->candidate : candidates.size();
  // What promises to explain a good part of the misfit goes first, with what contends with it: closer looks
  // at the others may be needless.
  const double share =
      others != screened.end() && candidates[others->candidate].dear ? goes_first_when_dear : goes_first;
  if (most_promised > std::max(2 * least_gain, share * (best.judged_chi2 - best.degrees))) {
    const bool second = others + 1 < screened.end() && promise(others[1]) > contends * most_promised;
    std::rotate(screened.begin(), others, others + (second ? 2 : 1));
  }
  const Setup before = base_;
  std::vector<Rival> rivals;
  double best_score = 0, lowest = best.judged_chi2;
  bool mended = false, explained = false;
  for (const ScreenedEffect& effect : screened) {
    if (rivals.size() >= most_tried) break;
    // What is tried in any case may have used the budget up: the one that promises most has its turn.
    if (result_.runs_simulated > budget_ && effect.candidate != most_promising) continue;
    const bool silent = accepted && promise(effect) < speaks_up && !(always(effect) && strayed);
    // nothing that acts otherwise takes up so much and leaves noise alone
    if (silent || (always(effect) && explained)) {
      // Friction has no linear estimate: untried, nothing is known of it.
      std::erase_if(result_.ranking, [&](const RankedEffect& ranked) {
        return always(effect) && ranked.effect == effect.effect && ranked.gain == 0;
      });
      continue;
    }
    // Linear gains rank well enough to leave out what promises half of what another has already brought,
    // where that explains. Where none does, a rival may have taken what another would explain, and promises
    // are low.
    const double bar = std::max(0.25 * most_promised, mended ? 0.5 * best_score : 0.0);
    if (!always(effect) && (effect.gain < least_gain / 2 || promise(effect) < bar)) continue;
    try {
      rivals.push_back(try_candidate(effect, candidates[effect.candidate], before, fitted, best, lowest));
      lowest = std::min(lowest, rivals.back().fit.judged_chi2);
      best_score = std::max(best_score, rivals.back().score());
      const double left = rivals.back().fit.p_value;
      mended = mended || left > mends;
      explained = explained || (!always(effect) && left > doubtful && rivals.back().score() > explains_much);
    } catch (const PhysicsError& error) {
      result_.notes.push_back(effect.effect + " could not be tried: " + error.what());
    }
  }
  const auto better = [](const Rival& a, const Rival& b) { return a.score() > b.score(); };
  std::stable_sort(rivals.begin(), rivals.end(), better);
  if (rivals.size() > 1 && rivals[0].score() - rivals[1].score() < too_close &&
      rivals[0].score() > least_gain) {
    rivals.resize(2);
    try {
      std::vector<Rival> closer = rivals;
      for (Rival& rival : closer) rival = decide(rival, best);
      rivals = std::move(closer);
    } catch (const PhysicsError& error) {
      result_.notes.push_back(rivals[0].effect + " and " + rivals[1].effect +
                              " could not be looked at closer: " + error.what());
    }
    std::stable_sort(rivals.begin(), rivals.end(), better);
  }
  // Physics is not accused of what the camera explains as well: a late clock, before a push at release.
  if (rivals.size() > 1 && alike(rivals[0], rivals[1]) && !acts_on_camera(rivals[0].effect) &&
      acts_on_camera(rivals[1].effect))
    std::swap(rivals[0], rivals[1]);
  base_ = before;
  return rivals;
}

/// A model that is rejected must be mended; one that is merely doubtful needs a better reason, or lengths
/// left out that say the same; an accepted one a reason that lengths left out do not deny. Beside friction,
/// whose two models leave a difference, a better one too.
bool Pipeline::pays(const Rival& rival, const Refit& best) const {
  const bool beside_friction =
      std::find(result_.missing.begin(), result_.missing.end(), "grain_friction") != result_.missing.end();
  const bool confirmed = std::isfinite(rival.held_out_gain) && rival.held_out_gain > least_gain;
  const bool denied = std::isfinite(rival.held_out_gain) && rival.held_out_gain < 0;
  const double noisy = std::max(1.0, rival.fit.scatter);
  if (best.p_value > doubtful)
    return rival.gain >=
           (denied || beside_friction ? 2 * least_gain : speaks_up) * noisy + std::max(0.0, rival.doubt);
  // What leaves a model that is rejected, and is denied, may merely imitate a part of what is missing.
  if (denied && rival.fit.p_value <= rejected && rival.gain < 0.5 * (best.judged_chi2 - best.degrees))
    return false;
  const double least =
      beside_friction || (best.p_value > rejected && !confirmed) ? 2 * least_gain : least_gain;
  // Restitutions far from the user's imitate friction to within a few per cent of the misfit; lengths left
  // out tell.
  const double share = confirmed ? 0 : least_share;
  return rival.gain >= least * noisy + rival.doubt && rival.gain >= share * best.judged_chi2;
}

/// What was added, fitted with full effort. Strengths that were looked for as one (friction of grains and of
/// walls) are fitted by themselves: each may be anything that the data allow.
Refit Pipeline::conclude(const std::string& step, const Refit& so_far) {
  if (std::none_of(chosen_.begin(), chosen_.end(), is_joint))
    return fit(step, together(theta_, chosen_), to_conclude);
  std::vector<Knob> parts = taken_apart(chosen_);
  const std::vector<Knob> boxes = taken_apart(first_boxes_);
  for (Knob& part : parts) {
    const auto same = [&](const Knob& knob) { return knob.key == part.key; };
    const auto box = std::find_if(boxes.begin(), boxes.end(), same);
    if (box == boxes.end() || std::any_of(chosen_.begin(), chosen_.end(), same)) continue;
    part.width = 0.6 * box->width;
    // one may be far from what both were together
    part.centre = std::max(part.centre, part.low + part.width);
  }
  const Refit apart = fit(step, together(theta_, parts), to_tell_apart);
  // too many to follow
  if ((apart.scatter - so_far.scatter) * apart.degrees > too_close)
    return fit(step, together(theta_, chosen_), to_conclude);
  chosen_ = parts;
  first_boxes_ = boxes;
  return apart;
}

bool Pipeline::acts_on_camera(const std::string& effect) const {
  const EffectRecord* record = find_record(options_.known, effect);
  return record != nullptr && record->acts_on == ActsOn::camera;
}

/// Adds an effect and fits it with full effort. False, and all as before: it is not there at all, or neither
/// explains nor differs from nothing, so that its gain was the emulators' noise.
bool Pipeline::take(const Rival& winner, Refit& best) {
  const auto before = std::tuple(base_, theta_, chosen_, first_boxes_, final_, result_.missing, dear_);
  base_ = winner.setup;
  for (std::vector<Knob>* list : {&chosen_, &first_boxes_})
    list->insert(list->end(), winner.knobs.begin(), winner.knobs.end());
  result_.missing.push_back(winner.effect);
  dear_ = dear_ || winner.dear;
  keep(winner.fit);
  // present from now on, so that it is no candidate again
  for (const Knob& knob : chosen_) set_knob(base_, knob, options_.known);
  const Refit closer = winner.decided ? winner.fit : conclude("refitting with " + winner.effect, winner.fit);
  // Of two strengths that were one neither may stand out where the one did.
  const bool one = std::none_of(winner.knobs.begin(), winner.knobs.end(), is_joint);
  const bool in_question =
      winner.gain < beyond_noise && (closer.p_value <= doubtful || best.p_value > doubtful);
  if (!stands_out(one ? closer : winner.fit, winner.knobs, in_question ? beyond_doubt : there_at_all)) {
    std::tie(base_, theta_, chosen_, first_boxes_, final_, result_.missing, dear_) = before;
    return false;
  }
  best = closer;
  concluded_ = !winner.decided;
  keep(best);
  std::string step = "refitted";
  for (const std::string& effect : result_.missing) step += " + " + effect;
  result_.ladder.push_back(step_of(step, best));
  return true;
}

/// Takes the effect that brings most, when it pays. False: none does.
bool Pipeline::add_best_candidate(Refit& best) {
  std::vector<Candidate> candidates = open_candidates();
  // Beside a model that is accepted, dear ones would cost more than all else.
  if (best.p_value > doubtful)
    std::erase_if(candidates, [](const Candidate& candidate) { return candidate.dear && !candidate.always; });
  const std::vector<Rival> rivals = rivals_among(candidates, best);
  if (rivals.empty() || !pays(rivals.front(), best) || !take(rivals.front(), best)) return false;
  const Rival& winner = rivals.front();
  runner_up_.reset();
  if (rivals.size() == 1) return true;
  const Rival& second = rivals[1];
  const bool twins = alike(winner, second);
  if (twins) call_twins(winner.effect, second.effect);
  if (twins || (second.score() > 0 && second.gain > contends * winner.gain)) {
    runner_up_ = {winner.effect, second.effect, second.setup};
    for (const Knob& knob : fitted_model(second.setup, second.fit).knobs)
      set_knob(runner_up_->setup, knob, options_.known);
  }
  return true;
}

void Pipeline::call_twins(const std::string& named, const std::string& other) {
  twins_.emplace_back(named, other);
  for (RankedEffect& ranked : result_.ranking)
    for (const auto& [here, there] : {std::pair(named, other), std::pair(other, named)})
      if (ranked.effect == here &&
          std::find(ranked.look_alikes.begin(), ranked.look_alikes.end(), there) == ranked.look_alikes.end())
        ranked.look_alikes.push_back(there);
}

/// Each effect but the last must still be needed beside those added after it.
void Pipeline::prune(Refit& best) {
  if (result_.missing.size() < 2) return;
  for (std::size_t i = 0; i + 1 < result_.missing.size(); ++i) {
    const std::string effect = result_.missing[i];
    if (std::any_of(result_.momentum.terms.begin(), result_.momentum.terms.end(),
                    [&](const FoundTerm& t) { return t.effect == effect; }))
      continue;
    const Setup before = base_;
    std::erase_if(base_.effects, [&](const EffectChoice& choice) { return choice.record->name == effect; });
    std::vector<Knob> rest = chosen_;
    std::erase_if(rest, [&](const Knob& knob) { return effect_of(knob.key) == effect; });
    const Refit without = fit("is " + effect + " still needed?", together(theta_, rest), to_prune);
    if (without.p_value <= rejected && (without.scatter - best.scatter) * best.degrees > least_gain) {
      base_ = before;
      continue;
    }
    chosen_ = rest;
    result_.missing.erase(result_.missing.begin() + static_cast<std::ptrdiff_t>(i));
    best = without;
    concluded_ = false;
    keep(best);
    result_.ladder.push_back(step_of("without " + effect, best));
    return prune(best);
  }
}

}  // namespace shakedown
