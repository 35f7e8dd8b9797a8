// SPDX-License-Identifier: MIT
#include "empty_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "conclusion.hpp"
#include "distributions.hpp"
#include "errors.hpp"
#include "experiment.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "last_fit.hpp"
#include "momentum_run.hpp"
#include "quantity.hpp"
#include "rules.hpp"
#include "sentences.hpp"
#include "setup_file.hpp"
#include "swing.hpp"
#include "swing_judged.hpp"
#include "unlisted_force.hpp"
#include "verdict.hpp"
#include "waveform_search.hpp"

namespace shakedown {

namespace {

LadderStep step_of(const std::string& name, const SwingError& swing, double floor,
                   const BalanceFit& balance) {
  LadderStep step;
  step.step = name;
  step.error_box = swing.error;
  step.floor_box = floor;
  step.p_value = balance.p_value;
  step.scatter = balance.chi2_per_degree();
  step.held_out_error_box = std::nan("");
  return step;
}

/// Puts what the balance found into the user's setup.
void amend(const Setup& user, KnownEffects known, Diagnosis& d) {
  d.amended = user;
  if (d.momentum.unlisted) d.amended = with_force(user, sum_of(d.momentum.formulas), known);
  for (const FoundTerm& term : d.momentum.terms) {
    if (find_choice(user, term.effect) == nullptr) d.missing.push_back(term.effect);
    for (const auto& [key, value] : term.besides) {
      set_number(d.amended, key, value, known);
      d.parameters.push_back(
          {key, value, 0, 0, "",
           write_quantity(std::stod(fmt::format("{:.3g}", value)), unit_of_key(key, known))});
    }
    if (term.frequency == 0) set_number(d.amended, term.key(), term.value, known);
    d.parameters.push_back({term.key(), term.value, term.low, term.high, term.unit, ""});
  }
  if (!(d.momentum.frequency > 0)) return;
  d.parameters.push_back({"spring.frequency", d.momentum.frequency, d.momentum.frequency_low,
                          d.momentum.frequency_high, "Hz", ""});
  d.amended.spring.frequency = d.momentum.frequency;
}

/// Returns what the ends of the parameters' intervals do to the motion of one run, rms, as a standard
/// uncertainty, m; NaN where the box runs away there.
double input_uncertainty(const SwingFrames& frames, const FirstTurn& turn, const Setup& setup,
                         const Engine& engine, KnownEffects known, const Diagnosis& d) {
  const Eigen::VectorXd here = residual_of(frames, turn, setup, engine);
  double squares = 0;
  for (const DiagnosedParameter& p : d.parameters) {
    if (!p.word.empty()) continue;
    const std::string effect = p.name.substr(0, p.name.find('.'));
    if (effect != "spring" && find_choice(setup, effect) == nullptr) continue;
    const double end = p.high - p.value > p.value - p.low ? p.high : p.low;
    Setup moved = setup;
    set_number(moved, p.name, end, known);
    try {
      const Eigen::VectorXd change = residual_of(frames, turn, moved, engine) - here;
      squares += change.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, change.size()));
    } catch (const PhysicsError&) {
      return std::nan("");  // the box runs away there
    }
  }
  return std::sqrt(squares) / normal_95;
}

/// Compares each run with the final model, its turn fitted.
std::vector<Validation> validation_by_compare(const Measurement& final, const Engine& engine,
                                              KnownEffects known, const Diagnosis& d) {
  std::vector<Validation> rows;
  for (const Measurement::Run& run : final.runs) {
    const SwingFrames frames = frames_of(run);
    if (frames.time.size() < MomentumRun::fewest_frames || !(run.setup.spring.frequency > 0)) continue;
    const auto [turn, origin, time, left] = fit_of(run, engine);
    // A line between two samples of the model misses by an eighth of (2 pi f / rate)^2 of the amplitude.
    const double between =
        std::pow(2 * std::numbers::pi * run.setup.spring.frequency / swing_model_rate, 2) / 8;
    rows.push_back(
        {run.recorded.name, "box",
         std::sqrt(left.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, left.size()))),
         between * std::abs(turn.place), input_uncertainty(frames, turn, run.setup, engine, known, d),
         std::hypot(run.audit.box.standard_deviation,
                    std::min(d.momentum.wander.deviation, d.momentum.most_wander))});
  }
  return rows;
}

}  // namespace

SwingError swing_error(const Measurement& measurement, const Engine& engine, bool as_stated) {
  SwingError all;
  double worst = 0;
  for (const Measurement::Run& run : measurement.runs) {
    const SwingFrames frames = frames_of(run);
    if (frames.time.size() < MomentumRun::fewest_frames || !(run.setup.spring.frequency > 0)) continue;
    SwingFit fit;
    try {
      fit = as_stated ? SwingFit{{},
                                 0,
                                 frames.time,
                                 residual_of(frames, {frames.time.front(), run.setup.release.displacement},
                                             run.setup, engine)}
                      : fit_of(run, engine);
    } catch (const PhysicsError& gave_up) {
      all.error = all.chi2 = std::numeric_limits<double>::infinity();
      all.why_not = gave_up.what();
      return all;
    }
    all.frames += static_cast<double>(fit.residual.size());
    all.error += fit.residual.squaredNorm();
    all.chi2 += fit.residual.squaredNorm() / std::pow(run.audit.box.standard_deviation, 2);
    all.amplitude = std::max(all.amplitude, half_span_of(frames));
    if (fit.residual.squaredNorm() > worst)
      worst = fit.residual.squaredNorm(), all.looks_like = words_of_swing(fit.time, fit.residual);
  }
  all.error = std::sqrt(all.error / std::max(1.0, all.frames));
  return all;
}

namespace {

/// Returns the share of chi2 a frame that `final` takes away; 0 where that is no number.
double share_explained(const SwingError& given, const SwingError& final) {
  const double share = 1 - final.chi2 / given.chi2 * given.frames / std::max(1.0, final.frames);
  return std::isfinite(share) ? share : 0;
}

/// Fills in the verdict of an empty box, by the same rule as all others.
void judge(const Measurement& final_model, const Engine& engine, KnownEffects known,
           const SwingError& given_in_phase, const SwingError& final, Diagnosis& d) {
  const MomentumAudit& balance = d.momentum;
  Findings findings;
  findings.features = no_ensembles();
  findings.balance = balance.test_of(balance.final_fit);
  findings.unlisted = balance.unlisted;
  findings.anything_missing = !d.missing.empty();
  findings.refitted = !(balance.as_given.p_value > rules::holds);
  findings.camera_stands_out = !standing_out(d.camera).empty();
  findings.explained = std::min(d.explained, share_explained(given_in_phase, final));
  if (final.why_not.empty()) d.validation = validation_by_compare(final_model, engine, known, d);
  findings.left = {
      {"box", final.error, balance.noise(), given_in_phase.error, final.amplitude, final.looks_like}};
  for (Difference& row : differences_of(d.validation)) findings.left.push_back(std::move(row));
  d.left = findings.left;
  d.judgement = judgement_of(findings.features, findings.balance, findings.left);
  d.verdict = verdict_of(findings);
  if (d.verdict == Verdict::adequate) d.parameters.clear();
  if (d.verdict == Verdict::unknown) {
    if (!balance.unlisted) d.missing.clear();
    set_formula(d);
  }
  settle_hypotheses(d, findings);
}

/// Fills in the values of the laws found, with 95 % intervals, and the effects that the setup lacks.
void name_laws(const Setup& user, const WaveformAnswer& answer, KnownEffects known, bool held_frequency,
               Diagnosis& d) {
  const WaveformFit& fit = answer.sets.front().fit;
  std::vector<std::size_t> order(fit.laws.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return fit.laws[a].is_mode != fit.laws[b].is_mode ? fit.laws[b].is_mode : answer.gain[a] > answer.gain[b];
  });
  const auto add = [&](const std::string& key, double value, double error) {
    const Parameter* parameter = known.find_parameter(key);
    const double low = parameter ? parameter->low : value - 1, high = parameter ? parameter->high : value + 1;
    d.parameters.push_back({key, value, std::max(low, value - normal_95 * error),
                            std::min(high, value + normal_95 * error), si_unit_of_key(key, known), ""});
  };
  for (const std::size_t i : order) {
    const WaveformLaw& law = fit.laws[i];
    if (find_choice(user, law.term.effect) == nullptr &&
        std::find(d.missing.begin(), d.missing.end(), law.term.effect) == d.missing.end())
      d.missing.push_back(law.term.effect);
    const Eigen::Index at = fit.first_of(i);
    const auto error = [&](Eigen::Index k) { return std::sqrt(fit.covariance(at + k, at + k)); };
    for (const auto& [key, value] : law.term.besides)
      d.parameters.push_back(
          {key, value, 0, 0, "",
           write_quantity(std::stod(fmt::format("{:.3g}", value)), unit_of_key(key, known))});
    double shown = law.term.parameter_at(fit.value[at]);
    if (law.is_mode) {
      shown = std::hypot(fit.value[at], fit.value[at + 1]);
      add(law.term.key(), shown, std::max(error(0), error(1)));
      add(law.frequency_key, fit.value[at + 2], error(2));
      add(law.rate_key, std::max(0.0, fit.value[at + 3]), error(3));
    } else {
      const double end = law.term.parameter_at(fit.value[at] + error(0));
      add(law.term.key(), shown, std::abs(end - shown));
    }
    d.ranking.push_back(
        {law.term.effect, answer.gain[i], std::nan(""), std::nan(""), shown, {}, true, false});
  }
  const Eigen::Index of_spring = static_cast<Eigen::Index>(3 * fit.residual.size());
  if (!held_frequency)
    add("spring.frequency", fit.frequency(), std::sqrt(fit.covariance(of_spring, of_spring)));
  d.amended = user;
  for (const WaveformLaw& law : fit.laws) {
    const auto first = std::find_if(d.parameters.begin(), d.parameters.end(),
                                    [&](const DiagnosedParameter& p) { return p.name == law.term.key(); });
    for (const auto& [key, value] : law.term.besides) set_number(d.amended, key, value, known);
    for (auto p = first; p != d.parameters.end() && effect_of(p->name) == law.term.effect; ++p)
      if (p->word.empty()) set_number(d.amended, p->name, p->value, known);
  }
  d.amended.spring.frequency = fit.frequency();
}

LadderStep step_of(const std::string& name, double error, double floor) {
  LadderStep step;
  step.step = name;
  step.error_box = error, step.floor_box = floor;
  step.p_value = step.scatter = step.held_out_error_box = std::nan("");
  return step;
}

}  // namespace

bool conclude_by_waveform(const Setup& user, const Measurement& measurement, const Engine& engine,
                          const EffectsInQuestion& asked, Diagnosis& d) {
  const KnownEffects known = asked.known;
  const MomentumAudit& balance = d.momentum;
  const double start = balance.possible && balance.frequency > 0
                           ? balance.frequency
                           : measurement.runs.front().setup.spring.frequency;
  const WaveformAnswer answer = search_waveform(measurement, start, asked);
  if (answer.sets.empty()) return false;
  const WaveformFit& fit = answer.sets.front().fit;
  const SwingRemains remains = remains_of(measurement, fit, balance, known);
  const SwingError given = swing_error(measurement, engine, true);
  Diagnosis found = d;
  found.ranking.clear();
  const bool held_frequency = knows_frequency_exactly(measurement);
  name_laws(user, answer, known, held_frequency, found);
  found.hypotheses = answer.table;
  for (Hypothesis& h : found.hypotheses)
    std::erase_if(h.effects, [&](const std::string& e) { return find_choice(user, e) != nullptr; });
  found.explained = share_explained(
      given, {remains.error, remains.chi2, static_cast<double>(remains.frame_count()), 0, {}, {}});
  Findings findings;
  findings.features = no_ensembles();
  findings.balance = waveform_instead_of_balance();
  findings.anything_missing = !found.missing.empty();
  findings.explained = 1 - std::pow(remains.error / answer.as_given.rms(), 2);
  const Eigen::Index of_spring = static_cast<Eigen::Index>(3 * fit.residual.size());
  findings.refitted =
      !held_frequency && std::abs(fit.frequency() - measurement.runs.front().setup.spring.frequency) >
                             rules::stands_out * std::sqrt(fit.covariance(of_spring, of_spring));
  found.validation = remains.validation;
  findings.left = remains.differences(answer.as_given.rms());
  found.left = findings.left;
  found.judgement = judgement_of(findings.features, findings.balance, findings.left);
  found.verdict = verdict_of(findings);
  std::string step = "refitted";
  for (const std::string& effect : found.missing) step += " + " + effect;
  found.ladder = {step_of("as given", given.error, remains.floor),
                  step_of(step, remains.error, remains.floor)};
  if (found.verdict == Verdict::adequate) found.parameters.clear(), found.amended = user;
  if (found.verdict == Verdict::unknown) found.missing.clear();
  settle_hypotheses(found, findings);
  found.camera = balance.nuisances;
  found.last_fit = std::make_shared<const LastFit>(
      LastFit{measurement, {}, SwingFound{remains.frames, fit, remains.left}});
  found.sentence = sentence_of(found, known);
  d = std::move(found);
  return true;
}

void conclude_empty_box(const Setup& user, const Measurement& measurement, const Engine& engine,
                        KnownEffects known, const Diagnosis& by_waveform, Diagnosis& d) {
  const MomentumAudit& balance = d.momentum;
  d.amended = user;
  if (by_waveform.ladder.size() == 2 && !balance.unlisted) {
    d = by_waveform;
    d.momentum = balance;
    return;
  }
  if (!balance.possible) {
    d.verdict = Verdict::unknown;
    d.sentence = "Nothing can be said: " + balance.why_not + ".";
    return;
  }
  for (const WeighedSet& set : balance.sets) d.hypotheses.push_back({set.effects, 0, set.probability});
  d.camera = balance.nuisances;
  amend(user, known, d);
  const double floor = balance.noise();
  const Measurement final_model = with_setup(measurement, d.amended, known);
  const SwingError given = swing_error(measurement, engine, true),
                   final = swing_error(final_model, engine, false);
  d.explained = share_explained(given, final);
  std::string step = "refitted";
  for (const std::string& effect : d.missing) step += " + " + effect;
  if (balance.unlisted) step += " + the force of the formula";
  d.ladder.push_back(step_of("as given", given, floor, balance.as_given));
  d.ladder.push_back(step_of(step, final, floor, balance.final_fit));
  judge(final_model, engine, known, swing_error(measurement, engine, false), final, d);
  if (d.verdict == Verdict::adequate) d.amended = user;
  complete_ranking(d);
  d.sentence = sentence_of(d, known);
}

}  // namespace shakedown
