// SPDX-License-Identifier: MIT
// One candidate tried: fitted with everything else, from where it may lie, and ranked by what it brings.
#include <algorithm>
#include <cmath>

#include "pipeline.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

/// A rival has explained so much more (chi2) that another start of this one will not catch up; the two minima
/// of friction differ by less.
constexpr double hopelessly_behind = 60;

/// Without the effect the restitutions were led astray: the box reaches from there to what the user gave.
std::vector<Knob> covering_the_users_values(std::vector<Knob> knobs) {
  for (Knob& knob : knobs) {
    if (!is_believed(knob)) continue;
    const double apart = std::abs(knob.centre - knob.believed);
    knob.centre = (knob.centre + knob.believed) / 2;
    knob.width = apart / 2 + 0.08;
  }
  return knobs;
}

/// Elsewhere: the user's restitutions, and of the effect's first range the half in which the fit is not.
std::vector<Knob> second_start(const Refit& fit, const std::vector<Knob>& first_range) {
  std::vector<Knob> start = fit.knobs;
  for (std::size_t k = 0; k < start.size(); ++k) {
    Knob& knob = start[k];
    knob.centre = fit.values[k].value;
    if (is_believed(knob)) knob.centre = knob.believed, knob.width = knob.believed_error;
    for (const Knob& first : first_range)
      if (first.key == knob.key) {
        knob.width = 0.6 * first.width;
        knob.centre = first.centre + (knob.centre < first.centre ? 0.5 : -0.5) * first.width;
      }
  }
  return start;
}

}  // namespace

bool is_believed(const Knob& knob) { return knob.believed_error > 0 && find_setup_key(knob.key) != nullptr; }

/// One candidate with everything refitted.
Pipeline::Rival Pipeline::try_candidate(const ScreenedEffect& effect, const Candidate& candidate,
                                        const Setup& before, const std::vector<Knob>& fitted,
                                        const Refit& best, double lowest) {
  base_ = prepared(before, candidate, options_.known);
  std::vector<Knob> added = candidate.fitted_knobs();
  for (Knob& knob : added) {
    if (candidate.knobs.empty()) {  // a length, known by what it does
      knob.width *= std::clamp(effect.value, knob.low, knob.high) / knob.centre;
      knob.centre = std::clamp(effect.value, knob.low, knob.high);
    } else if (candidate.always) {  // its whole usual range
      knob.centre += knob.width;
    } else {  // where the linear estimate points
      knob.centre = std::clamp(effect.value, knob.low, knob.high);
      knob.width = std::max(knob.width, 0.5 * std::abs(effect.value));
    }
  }
  const bool dear = candidate.dear && !candidate.always;
  const std::vector<Knob> knobs = together(covering_the_users_values(fitted), added);
  Rival rival{candidate.effect,
              candidate.doubt,
              base_,
              added,
              fit("trying " + candidate.effect, knobs, dear ? to_try_dear : to_try, &best, lowest),
              0,
              0,
              false,
              dear};
  // The restitutions are known well only together, and friction with them: along that valley there may be two
  // minima (friction of .1, and of .35 with other restitutions).
  const bool hopeless =
      lowest < best.judged_chi2 - 2 * least_gain && rival.fit.judged_chi2 > lowest + hopelessly_behind;
  if (!hopeless && std::any_of(added.begin(), added.end(), [](const Knob& knob) { return knob.cubic; })) {
    const Refit other = fit("trying " + candidate.effect + " from elsewhere", second_start(rival.fit, added),
                            to_look_again, &best, std::min(lowest, rival.fit.judged_chi2));
    if (other.judged_chi2 < rival.fit.judged_chi2) rival.fit = other;
  }
  rank(rival, best);
  // What lengthens all records shows in the box before it moves; another arrangement of the grains, which the
  // same fit would take for it, does not.
  if (candidate.effect == "camera_scale" && release_scale_)
    rival.doubt +=
        std::pow((rival.fit.values.back().value - release_scale_->value) / release_scale_->error, 2);
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
  rival.fit = fit("comparing " + rival.effect + " closely", knobs, to_decide, &best);
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
    ranked.fitted = true;
    ranked.held_out_gain = rival.held_out_gain;
    ranked.standard_error = 2 * std::sqrt(std::abs(rival.held_out_gain));
    ranked.value = rival.knobs.empty() ? 0 : rival.fit.values.back().value;
    break;
  }
}

/// The data do not tell the better one from the other. Lengths left out may rank what the fits do not, but
/// their gains are too noisy to say that one of two alike is not the truth.
bool Pipeline::alike(const Rival& better, const Rival& other) {
  return other.gain > 0.8 * better.gain && (better.gain - other.gain < too_close ||
                                            (other.decided && better.score() - other.score() < too_close));
}

}  // namespace shakedown
