// SPDX-License-Identifier: MIT
#include "empty_box.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "conclusion.hpp"
#include "experiment_file.hpp"
#include "known_effects.hpp"
#include "rules.hpp"
#include "sentences.hpp"
#include "setup_file.hpp"
#include "unlisted_force.hpp"
#include "verdict.hpp"

namespace shakedown {

namespace {

/// Hz, of the model's motion; a line between two samples misses by 5e-5 of the amplitude at 3 Hz.
constexpr double model_rate = 1000;

/// Where a run turns for the first time.
struct Turn {
  double time = 0, place = 0;  ///< s, m
};

/// Frames of one run from its start on.
struct Frames {
  std::vector<double> time, x;
};

Frames frames_of(const Measurement::Run& run) {
  Frames frames;
  for (std::size_t i = 0; i < run.recorded.time.size(); ++i)
    if (std::isfinite(run.audit.x_box[i]) &&
        (starts_anywhere(run.recorded, run.setup) || run.recorded.time[i] >= 0))
      frames.time.push_back(run.recorded.time[i]), frames.x.push_back(run.audit.x_box[i]);
  return frames;
}

double middle_of(const Frames& frames) {
  const auto [low, high] = std::minmax_element(frames.x.begin(), frames.x.end());
  return (*low + *high) / 2;
}

/// The farthest place within the first period.
Turn first_turn(const Frames& frames, double middle, double period) {
  Turn turn{frames.time.front(), frames.x.front() - middle};
  for (std::size_t i = 0; i < frames.time.size() && frames.time[i] < frames.time.front() + 1.1 * period; ++i)
    if (std::abs(frames.x[i] - middle) > std::abs(turn.place)) turn = {frames.time[i], frames.x[i] - middle};
  return turn;
}

/// Measured less modelled from the turn on; empty where the box cannot start there.
Eigen::VectorXd residual_of(const Frames& frames, const Turn& turn, Setup setup, const Engine& engine) {
  constexpr double rate = model_rate;
  setup.release.displacement = turn.place;
  setup.run.duration = std::max(0.1, frames.time.back() - turn.time) + 2 / rate;
  setup.run.sample_rate = rate;
  const Trajectory model = engine.run(setup, {});
  std::vector<double> left;
  for (std::size_t i = 0; i < frames.time.size(); ++i) {
    const double place = (frames.time[i] - turn.time) * rate;
    if (place < 0) continue;
    const auto k = std::min(static_cast<std::size_t>(place), model.x_box.size() - 2);
    const double part = place - static_cast<double>(k);
    left.push_back(frames.x[i] - model.x_box[k] - part * (model.x_box[k + 1] - model.x_box[k]));
  }
  return Eigen::Map<Eigen::VectorXd>(left.data(), std::ssize(left));
}

/// The origin that fits best taken off.
Eigen::VectorXd centred(Eigen::VectorXd residual, bool origin_unknown) {
  if (origin_unknown && residual.size() > 0) residual.array() -= residual.mean();
  return residual;
}

/// Time and place of the turn by a few steps of Gauss and Newton. The frames that count stay those after the
/// first guess.
Eigen::VectorXd fitted_residual(const Frames& frames, Turn turn, const Setup& setup, const Engine& engine,
                                bool origin_unknown) {
  Frames after;
  for (std::size_t i = 0; i < frames.time.size(); ++i)
    if (frames.time[i] >= turn.time) after.time.push_back(frames.time[i]), after.x.push_back(frames.x[i]);
  const double period = 1 / setup.spring.frequency;
  turn.time -= period / 100;  // so that no frame is lost on the way
  const auto at = [&](const Turn& where) {
    return centred(residual_of(after, where, setup, engine), origin_unknown);
  };
  Eigen::VectorXd best = at(turn);
  const double dt = period / 1000, dx = 1e-3 * std::abs(turn.place);
  for (int step = 0; step < 8; ++step) {
    Eigen::MatrixXd slope(best.size(), 2);
    slope.col(0) = (best - at({turn.time - dt, turn.place})) / dt;
    slope.col(1) = (at({turn.time, turn.place + dx}) - best) / dx;
    const Eigen::Vector2d move = -(slope.transpose() * slope).ldlt().solve(slope.transpose() * best);
    const Turn next{
        std::min(turn.time + std::clamp(move[0], -period / 20, period / 20), after.time.front()),
        turn.place + std::clamp(move[1], -0.1 * std::abs(turn.place), 0.1 * std::abs(turn.place))};
    const Eigen::VectorXd here = at(next);
    if (!(here.squaredNorm() < best.squaredNorm() * (1 - 1e-6))) break;
    turn = next, best = here;
  }
  return best;
}

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
    for (const auto& [key, value] : term.besides) set_number(d.amended, key, value, known);
    if (term.frequency == 0) set_number(d.amended, term.key(), term.value, known);
    d.parameters.push_back({term.key(), term.value, term.low, term.high, term.unit, ""});
  }
  if (!(d.momentum.frequency > 0)) return;
  d.parameters.push_back({"spring.frequency", d.momentum.frequency, d.momentum.frequency_low,
                          d.momentum.frequency_high, "Hz", ""});
  d.amended.spring.frequency = d.momentum.frequency;
}

/// What the ends of the parameters' intervals do to the motion of one run, rms, as a standard uncertainty, m.
double input_uncertainty(const Frames& frames, const Turn& turn, const Setup& setup, const Engine& engine,
                         std::span<const EffectRecord* const> known, const Diagnosis& d) {
  constexpr double of_95_percent = 1.96;
  const Eigen::VectorXd here = residual_of(frames, turn, setup, engine);
  double squares = 0;
  for (const DiagnosedParameter& p : d.parameters) {
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
    const Frames frames = frames_of(run);
    if (frames.time.size() < 8 || !(run.setup.spring.frequency > 0)) continue;
    const bool anywhere = starts_anywhere(run.recorded, run.setup);
    const Turn turn = first_turn(frames, anywhere ? middle_of(frames) : 0, 1 / run.setup.spring.frequency);
    const Eigen::VectorXd left = fitted_residual(frames, turn, run.setup, engine, anywhere);
    // A line between two samples of the model misses by an eighth of (2 pi f / rate)^2 of the amplitude.
    const double between = std::pow(2 * std::numbers::pi * run.setup.spring.frequency / model_rate, 2) / 8;
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
    const Frames frames = frames_of(run);
    if (frames.time.size() < 8 || !(run.setup.spring.frequency > 0)) continue;
    const bool anywhere = starts_anywhere(run.recorded, run.setup);
    const double middle = anywhere ? middle_of(frames) : 0;
    const Eigen::VectorXd residual =
        as_stated
            ? residual_of(frames, {frames.time.front(), run.setup.release.displacement}, run.setup, engine)
            : fitted_residual(frames, first_turn(frames, middle, 1 / run.setup.spring.frequency), run.setup,
                              engine, anywhere);
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
  findings.unlisted = balance.unlisted, findings.balance_p = balance.final_fit.p_value;
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
