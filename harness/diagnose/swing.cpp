// SPDX-License-Identifier: MIT
#include "swing.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base_column.hpp"
#include "experiment.hpp"
#include "known_effects.hpp"
#include "quantity.hpp"
#include "toml_string.hpp"

namespace shakedown {

namespace {

/// Tells whether a run has no grains and starts anywhere, so that a first turn is looked for in it.
bool is_swing(const Measurement::Run& run) {
  return run.setup.grains.count == 0 && starts_anywhere(run.recorded, run.setup) &&
         run.setup.spring.frequency > 0;
}

/// Counts the base's clock from the same moment as the run's.
void start_base_at(double moment, MeasuredRun& recorded, Setup& setup) {
  const std::string_view parameter = base_start_key.substr(base_start_key.find('.') + 1);
  for (EffectChoice& choice : setup.effects) {
    if (choice.record->name != effect_of(base_start_key)) continue;
    const double start = choice.number(parameter) + moment;
    choice.values.find(parameter)->second = start;
    std::erase_if(recorded.overrides, [&](const Override& one) { return one.key == base_start_key; });
    recorded.overrides.push_back(
        {std::string(base_start_key), toml_string(write_quantity(start, "s")), "measured"});
  }
}

void start_at(const SwingFit& swing, MeasuredRun& recorded, Setup& setup) {
  constexpr std::string_view key = "release.displacement";
  std::size_t kept = 0;
  for (std::size_t i = 0; i < recorded.time.size(); ++i)
    if (recorded.time[i] >= swing.turn.time) {
      recorded.time[kept] = recorded.time[i] - swing.turn.time;
      recorded.x_box[kept++] = recorded.x_box[i] - swing.origin;
    }
  recorded.time.resize(kept), recorded.x_box.resize(kept);
  recorded.x_com.clear();
  recorded.lead_in = {};
  recorded.start = Start::from_rest, recorded.origin_stated = true;
  std::erase_if(recorded.overrides, [&](const Override& one) { return one.key == key; });
  recorded.overrides.push_back(
      {std::string(key), toml_string(write_quantity(swing.turn.place, "m")), "measured"});
  setup.release.displacement = swing.turn.place;
  start_base_at(swing.turn.time, recorded, setup);
}

}  // namespace

SwingFrames frames_of(const Measurement::Run& run) {
  SwingFrames frames;
  for (std::size_t i = 0; i < run.recorded.time.size(); ++i)
    if (std::isfinite(run.audit.x_box[i]) &&
        (starts_anywhere(run.recorded, run.setup) || run.recorded.time[i] >= 0))
      frames.time.push_back(run.recorded.time[i]), frames.x.push_back(run.audit.x_box[i]);
  return frames;
}

double middle_of(const SwingFrames& frames) {
  const auto [low, high] = std::minmax_element(frames.x.begin(), frames.x.end());
  return (*low + *high) / 2;
}

double half_span_of(const SwingFrames& frames) {
  const auto [low, high] = std::minmax_element(frames.x.begin(), frames.x.end());
  return (*high - *low) / 2;
}

std::string words_of_swing(const std::vector<double>& time, const Eigen::VectorXd& left) {
  const auto n = static_cast<Eigen::Index>(std::min(time.size(), static_cast<std::size_t>(left.size())));
  constexpr Eigen::Index fewest = 16;
  constexpr double mostly = 0.5;  // of the squares
  if (n < fewest || !left.allFinite()) return "";
  const double length = time[static_cast<std::size_t>(n) - 1] - time.front(),
               fastest = static_cast<double>(n) / length / 4;
  const Eigen::VectorXd centred = left.head(n).array() - left.head(n).mean();
  double most = 0, frequency = 0;
  constexpr int most_steps = 2000;
  for (int step = 1; step <= most_steps && step * 0.5 / length < fastest; ++step) {
    const double f = step * 0.5 / length;
    double sine = 0, cosine = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double phase = 2 * std::numbers::pi * f * time[static_cast<std::size_t>(i)];
      sine += std::sin(phase) * centred[i], cosine += std::cos(phase) * centred[i];
    }
    if (const double power = sine * sine + cosine * cosine; power > most) most = power, frequency = f;
  }
  // A sine of amplitude a makes (n a / 2)^2 of power and n a^2 / 2 of the squares.
  const double share = 2 * most / static_cast<double>(n) / std::max(centred.squaredNorm(), 1e-300);
  if (!(share > mostly)) return "";
  return fmt::format("mostly a swing of {:.3g} Hz ({:.2g} mm)", frequency,
                     1e3 * 2 * std::sqrt(most) / static_cast<double>(n));
}

/// Looks through 1.1 periods, in case the turn comes late.
FirstTurn first_turn(const SwingFrames& frames, double middle, double period) {
  FirstTurn turn{frames.time.front(), frames.x.front() - middle};
  for (std::size_t i = 0; i < frames.time.size() && frames.time[i] < frames.time.front() + 1.1 * period; ++i)
    if (std::abs(frames.x[i] - middle) > std::abs(turn.place)) turn = {frames.time[i], frames.x[i] - middle};
  return turn;
}

/// Takes the model's places between two samples from straight lines.
Eigen::VectorXd residual_of(const SwingFrames& frames, const FirstTurn& turn, Setup setup,
                            const Engine& engine) {
  constexpr double rate = swing_model_rate;
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

SwingFit fit_of(const SwingFrames& frames, FirstTurn turn, const Setup& setup, const Engine& engine,
                bool origin_unknown) {
  // Noise moves the farthest frame by some hundredths of a period: later frames see the turn on either side.
  const double period = 1 / setup.spring.frequency, first = turn.time + period / 20;
  SwingFrames after;
  for (std::size_t i = 0; i < frames.time.size(); ++i)
    if (frames.time[i] >= first) after.time.push_back(frames.time[i]), after.x.push_back(frames.x[i]);
  double origin = 0;
  const auto at = [&](const FirstTurn& where) {
    Eigen::VectorXd residual = residual_of(after, where, setup, engine);
    origin = origin_unknown && residual.size() > 0 ? residual.mean() : 0;
    residual.array() -= origin;
    return residual;
  };
  Eigen::VectorXd best = at(turn);
  double best_origin = origin;
  const double dt = period / 1000, dx = 1e-3 * std::abs(turn.place);
  constexpr int most_moves = 8;
  for (int step = 0; step < most_moves; ++step) {
    Eigen::MatrixXd slope(best.size(), 2);
    slope.col(0) = (best - at({turn.time - dt, turn.place})) / dt;
    slope.col(1) = (at({turn.time, turn.place + dx}) - best) / dx;
    const Eigen::Vector2d move = -(slope.transpose() * slope).ldlt().solve(slope.transpose() * best);
    const FirstTurn next{
        std::min(turn.time + std::clamp(move[0], -period / 20, period / 20), after.time.front()),
        turn.place + std::clamp(move[1], -0.1 * std::abs(turn.place), 0.1 * std::abs(turn.place))};
    const Eigen::VectorXd here = at(next);
    if (!(here.squaredNorm() < best.squaredNorm() * (1 - 1e-6))) break;
    turn = next, best = here, best_origin = origin;
  }
  return {turn, best_origin, std::move(after.time), best};
}

SwingFit fit_of(const Measurement::Run& run, const Engine& engine) {
  const SwingFrames frames = frames_of(run);
  const bool anywhere = starts_anywhere(run.recorded, run.setup);
  return fit_of(frames, first_turn(frames, anywhere ? middle_of(frames) : 0, 1 / run.setup.spring.frequency),
                run.setup, engine, anywhere);
}

namespace {

/// Returns the turn as these periods from it show it.
SwingFit fit_within(const Measurement::Run& run, const Engine& engine, double periods) {
  SwingFrames frames = frames_of(run);
  const double period = 1 / run.setup.spring.frequency;
  const FirstTurn turn = first_turn(frames, middle_of(frames), period);
  std::size_t end = 0;
  while (end < frames.time.size() && frames.time[end] < turn.time + periods * period) ++end;
  frames.time.resize(end), frames.x.resize(end);
  return fit_of(frames, turn, run.setup, engine, true);
}

}  // namespace

Measurement from_first_turns(const Measurement& measurement, const Engine& engine, double periods) {
  if (std::none_of(measurement.runs.begin(), measurement.runs.end(), is_swing)) return measurement;
  Experiment experiment{measurement.title, measurement.file,  {},
                        measurement.known, measurement.notes, measurement.sensor};
  std::vector<Setup> setups;
  for (const Measurement::Run& run : measurement.runs) {
    experiment.runs.push_back(run.recorded);
    setups.push_back(run.setup);
    constexpr std::size_t least = 8;  // frames
    if (is_swing(run) && frames_of(run).time.size() >= least)
      start_at(fit_within(run, engine, periods), experiment.runs.back(), setups.back());
  }
  Measurement started = measurement_of(setups, std::move(experiment));
  for (std::size_t r = 0; r < started.runs.size(); ++r) started.runs[r].keep_scales_of(measurement.runs[r]);
  return started;
}

}  // namespace shakedown
