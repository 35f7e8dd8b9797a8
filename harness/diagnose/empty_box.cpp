// SPDX-License-Identifier: MIT
#include "empty_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conclusion.hpp"
#include "experiment_file.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "quantity.hpp"
#include "rules.hpp"
#include "sentences.hpp"
#include "setup_file.hpp"
#include "swing.hpp"
#include "unlisted_force.hpp"
#include "verdict.hpp"

namespace shakedown {

namespace {

LadderStep step_of(const std::string& name, const SwingError& swing, const SwingError& floor,
                   const BalanceFit& balance) {
  LadderStep step;
  step.step = name;
  step.error_box = swing.error;
  step.floor_box = floor.error;
  step.p_value = balance.p_value;
  step.scatter = balance.chi2_per_degree();
  step.held_out_error_box = std::nan("");
  return step;
}

/// What the balance found goes into the user's setup.
void amend(const Setup& user, std::span<const EffectRecord* const> known, Diagnosis& d) {
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

/// What the ends of the parameters' intervals do to the motion of one run, rms, as a standard uncertainty, m.
double input_uncertainty(const SwingFrames& frames, const FirstTurn& turn, const Setup& setup,
                         const Engine& engine, std::span<const EffectRecord* const> known,
                         const Diagnosis& d) {
  constexpr double of_95_percent = 1.96;
  const Eigen::VectorXd here = residual_of(frames, turn, setup, engine);
  double squares = 0;
  for (const DiagnosedParameter& p : d.parameters) {
    if (!p.word.empty()) continue;
    const std::string effect = p.name.substr(0, p.name.find('.'));
    if (effect != "spring" && find_choice(setup, effect) == nullptr) continue;
    const double end = p.high - p.value > p.value - p.low ? p.high : p.low;
    Setup moved = setup;
    set_number(moved, p.name, end, known);
    const Eigen::VectorXd change = residual_of(frames, turn, moved, engine) - here;
    squares += change.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, change.size()));
  }
  return std::sqrt(squares) / of_95_percent;
}

/// Each run against the final model, its turn fitted.
std::vector<Validation> validation_of(const Measurement& final, const Engine& engine,
                                      std::span<const EffectRecord* const> known, const Diagnosis& d) {
  std::vector<Validation> rows;
  for (const Measurement::Run& run : final.runs) {
    const SwingFrames frames = frames_of(run);
    if (frames.time.size() < 8 || !(run.setup.spring.frequency > 0)) continue;
    const auto [turn, origin, left] = fit_of(run, engine);
    // A line between two samples of the model misses by an eighth of (2 pi f / rate)^2 of the amplitude.
    const double between =
        std::pow(2 * std::numbers::pi * run.setup.spring.frequency / swing_model_rate, 2) / 8;
    rows.push_back(
        {run.recorded.name, "box",
         std::sqrt(left.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, left.size()))),
         between * std::abs(turn.place), input_uncertainty(frames, turn, run.setup, engine, known, d),
         std::hypot(run.audit.box.standard_deviation, d.momentum.wander.deviation)});
  }
  return rows;
}

}  // namespace

SwingError swing_error(const Measurement& measurement, const Engine& engine, bool as_stated) {
  SwingError all;
  for (const Measurement::Run& run : measurement.runs) {
    const SwingFrames frames = frames_of(run);
    if (frames.time.size() < 8 || !(run.setup.spring.frequency > 0)) continue;
    const Eigen::VectorXd residual =
        as_stated
            ? residual_of(frames, {frames.time.front(), run.setup.release.displacement}, run.setup, engine)
            : fit_of(run, engine).residual;
    all.frames += static_cast<double>(residual.size());
    all.error += residual.squaredNorm();
    all.chi2 += residual.squaredNorm() / std::pow(run.audit.box.standard_deviation, 2);
  }
  all.error = std::sqrt(all.error / std::max(1.0, all.frames));
  return all;
}

void conclude_empty_box(const Setup& user, const Measurement& measurement, const Engine& engine,
                        std::span<const EffectRecord* const> known, Diagnosis& d) {
  const MomentumAudit& balance = d.momentum;
  d.amended = user;
  if (!balance.possible) {
    d.verdict = Verdict::unknown;
    d.sentence = "Nothing can be said: " + balance.why_not + ".";
    return;
  }
  for (const WeighedSet& set : balance.sets) d.hypotheses.push_back({set.effects, 0, set.probability});
  Findings findings;
  findings.unlisted = balance.unlisted, findings.balance = balance.test_of(balance.final_fit);
  settle_hypotheses(d, findings);
  d.camera = balance.nuisances;
  amend(user, known, d);
  SwingError noise;
  for (const Measurement::Run& run : measurement.runs)
    noise.error = std::max(noise.error, run.audit.box.standard_deviation);
  noise.error = std::hypot(noise.error, balance.wander.deviation);
  const SwingError given = swing_error(measurement, engine, true),
                   final = swing_error(with_setup(measurement, d.amended, known), engine, false);
  d.explained = given.chi2 > 0 ? 1 - final.chi2 / given.chi2 * given.frames / std::max(1.0, final.frames) : 0;
  std::string step = "refitted";
  for (const std::string& effect : d.missing) step += " + " + effect;
  if (balance.unlisted) step += " + the force of the formula";
  d.ladder.push_back(step_of("as given", given, noise, balance.as_given));
  d.ladder.push_back(step_of(step, final, noise, balance.final_fit));
  const ModelTest no_features{std::nan(""), std::nan(""), "an empty box has no ensembles"};
  d.validation = validation_of(with_setup(measurement, d.amended, known), engine, known, d);
  d.judgement = judgement_of(no_features, balance.test_of(balance.final_fit));
  // What takes nearly all of the misfit away is found, though small remains may have no name.
  constexpr double nearly_all = 0.9;
  const bool named = !d.missing.empty() && (!balance.unexplained || d.explained > nearly_all);
  const bool holds = balance.as_given.p_value > rules::holds && d.missing.empty();
  d.verdict = balance.unlisted || (balance.unexplained && !named) ? Verdict::unknown
              : named                                             ? Verdict::missing
              : holds                                             ? Verdict::adequate
              : standing_out(d.camera).empty()                    ? Verdict::refit
                                                                  : Verdict::measurement;
  if (d.verdict == Verdict::adequate) d.parameters.clear(), d.amended = user;
  if (d.verdict == Verdict::unknown) d.missing.clear(), set_formula(d);
  complete_ranking(d);
  d.sentence = sentence_of(d, known);
}

}  // namespace shakedown
