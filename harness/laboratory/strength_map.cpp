// SPDX-License-Identifier: MIT
#include "strength_map.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "camera_features.hpp"
#include "effect_strength.hpp"
#include "errors.hpp"
#include "evidence.hpp"
#include "feature_covariance.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "linear_model.hpp"
#include "outside.hpp"
#include "parameter_knobs.hpp"
#include "refit.hpp"
#include "rules.hpp"
#include "signature.hpp"

namespace shakedown {

namespace {

/// Numbers of simulations of the setup as believed, and for what its free parameters do, as a screening makes
/// them.
constexpr int of_nothing = 192, of_slopes = 96;
constexpr double shutter_of_no_knob = 1e-3;  // s, width of a knob that the setup has not

/// Holds one effect at one strength: change of every run's mean features, m.
struct SimulatedLevel {
  double strength = 0;
  std::vector<Eigen::VectorXd> change;
  double of_chaos = 0;  ///< share of one simulation's chaos that is left in it
};

class Mapper {
 public:
  Mapper(const Setup& setup, const Measurement& planned, const Engine& engine, const MapOptions& options)
      : setup_(setup),
        engine_(engine),
        options_(options),
        measured_(features_with_camera(planned, options.known)) {
    end_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                  std::chrono::duration<double>(options.seconds));
    workshop_.engine = &engine;
    workshop_.known = options.known;
    workshop_.execution = options.execution;
    workshop_.meter.done = [this](int runs) { map_.simulations += runs; };
    workshop_.store.journal = options.journal;
    knobs_ = straight(believed(free_parameters(setup), planned.known, options.known), 0.5);
    for (Knob& knob : camera_knobs(setup, planned, options.known)) knobs_.push_back(std::move(knob));
    const std::string shutter = options.known.key_of(&Camera::shutter);
    const auto is_shutter = [&](const Knob& knob) { return knob.key == shutter; };
    if (std::none_of(knobs_.begin(), knobs_.end(), is_shutter))
      knobs_.push_back(exact_knob(shutter, 0, 1e-3 * shutter_of_no_knob));
  }

  StrengthMap run(const std::vector<MapLine>& lines) {
    const auto begin = std::chrono::steady_clock::now();
    map_.lines = lines;
    tell("the setup as believed", 0);
    nothing_ = emulate(measured_, {}, of_nothing, first_run, workshop_);
    slopes_ = emulate(measured_, knobs_, of_slopes, first_run + 1000, workshop_);
    for (const MapLine& line : lines) metrics_.push_back(metric_of(line));
    map_effects();
    map_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(map_);
  }

 private:
  static constexpr int first_run = 8000000;

  /// Turns features of all runs into units of what one line's experiment does not know, less what is free.
  struct Metric {
    std::vector<Eigen::LLT<Eigen::MatrixXd>> roots;
    std::optional<Outside> outside;
    Eigen::Index total = 0;
    double chaos = 0;  ///< expected square of one simulation's chaos
  };

  void tell(const std::string& stage, double fraction) const {
    if (options_.progress) options_.progress(stage, fraction);
  }

  Metric metric_of(const MapLine& line) const {
    Metric metric;
    const Eigen::Index count = std::ssize(knobs_);
    Eigen::Index features = 0;
    for (const MeasuredFeatures& run : measured_) features += run.values.size();
    metric.total = features + count;
    Eigen::MatrixXd free = Eigen::MatrixXd::Zero(metric.total, count);
    Eigen::Index at = 0;
    for (std::size_t r = 0; r < measured_.size(); ++r) {
      const Eigen::MatrixXd covariance = covariance_of(r, line);
      const Eigen::LLT<Eigen::MatrixXd>& root = metric.roots.emplace_back(covariance);
      const Eigen::Index own = covariance.rows();
      for (Eigen::Index k = 0; k < count; ++k)
        free.col(k).segment(at, own) = root.matrixL().solve(slopes_[r].coefficients.row(1 + k).transpose());
      const Eigen::MatrixXd chaos = root.matrixL().solve(nothing_[r].residuals.transpose());
      metric.chaos += chaos.squaredNorm() / static_cast<double>(chaos.cols());
      at += own;
    }
    for (Eigen::Index k = 0; k < count; ++k) {
      const Knob& knob = knobs_[static_cast<std::size_t>(k)];
      const double error = error_of(knob, line);
      if (error > 0) free(features + k, k) = knob.width / error;
    }
    metric.outside.emplace(free);
    return metric;
  }

  /// Returns the error to which the number is known in this line's experiment; 0: it is not.
  double error_of(const Knob& knob, const MapLine& line) const {
    const bool restitution = knob.key.starts_with("restitution");
    if (restitution && line.restitution_error > 0) return line.restitution_error;
    if (line.shutter >= 0 && knob.key == options_.known.key_of(&Camera::shutter))
      return std::max(line.shutter, 1e-7);
    return knob.believed_error;
  }

  /// Returns the covariance of the mean over repeats of a run, m^2; what two codes differ by is the same in
  /// all of them.
  Eigen::MatrixXd covariance_of(std::size_t r, const MapLine& line) const {
    MeasuredFeatures run = measured_[r];
    for (Feature& feature : run.plan.features) feature.noise *= line.noise;
    if (line.wander > 0) {
      std::vector<MeasuredFeatures> one{run};
      add_wander({line.wander, line.wander_time}, one);
      run = std::move(one.front());
    }
    Eigen::MatrixXd covariance =
        with_own(covariance_for_means(nothing_[r].residuals, run.plan, 0), run) / line.runs;
    const double codes = RefitOptions{}.model_error * run.setup.release.displacement;
    covariance.diagonal().array() += codes * codes;
    return covariance;
  }

  void map_effects() {
    std::vector<Candidate> candidates = candidates_for(setup_, options_.effects, options_.known, engine_);
    std::erase_if(candidates, [](const Candidate& one) { return one.fitted_knobs().front().exact; });
    for (const std::string& effect : options_.effects)
      if (std::none_of(candidates.begin(), candidates.end(),
                       [&](const Candidate& one) { return one.effect == effect; }))
        map_.left_out.push_back({effect, "it is of the camera, or no diagnosis looks for it beside grains"});
    const auto cost = [](const Candidate& one) { return one.dear ? 2 : one.slow ? 1 : 0; };
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const Candidate& a, const Candidate& b) { return cost(a) < cost(b); });
    workshop_.meter.ask_for = [end = end_](std::int64_t) {
      if (std::chrono::steady_clock::now() > end) throw BudgetSpent("the time is up");
    };
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const Candidate& candidate = candidates[c];
      const std::string key = candidate.fitted_knobs().front().key;
      tell(candidate.effect, (1 + static_cast<double>(c)) / (1 + static_cast<double>(candidates.size())));
      try {
        const std::vector<SimulatedLevel> levels = simulated(candidate, static_cast<int>(c));
        map_.effects.push_back(mapped(candidate, key, levels));
      } catch (const BudgetSpent&) {
        map_.left_out.push_back({key, "there was no time left"});
      } catch (const PhysicsError& error) {
        map_.left_out.push_back({key, error.what()});
      } catch (const InputError& error) {
        map_.left_out.push_back({key, error.what()});
      }
    }
  }

  std::vector<SimulatedLevel> simulated(const Candidate& candidate, int number) const {
    const bool costs = candidate.slow || candidate.dear;
    const int count = std::max(8, candidate.dear   ? options_.count / 4
                                  : candidate.slow ? options_.count / 2
                                                   : options_.count);
    std::vector<SimulatedLevel> levels;
    for (const Candidate::Level& level : candidate.levels) {
      std::vector<MeasuredFeatures> with = costs ? kicked_rarely(measured_) : measured_;
      Knob knob = candidate.fitted_knobs().front();
      knob.centre = level.value;
      for (MeasuredFeatures& run : with) {
        run.setup = prepared(run.setup, candidate, options_.known);
        set_knob(run.setup, knob, options_.known);
      }
      const int batch = first_run + 10000 + 1000 * (10 * number + static_cast<int>(levels.size()));
      const std::vector<Emulator> there = emulate(with, {}, count, batch, workshop_);
      SimulatedLevel one{candidate.strength_of(level.value), {}, 1.0 / count + 1.0 / of_nothing};
      for (std::size_t r = 0; r < there.size(); ++r)
        one.change.push_back((there[r].coefficients.row(0) - nothing_[r].coefficients.row(0)).transpose());
      levels.push_back(std::move(one));
    }
    return levels;
  }

  MappedEffect mapped(const Candidate& candidate, const std::string& key,
                      const std::vector<SimulatedLevel>& levels) const {
    MappedEffect effect{candidate.effect, key, unit_of_key(key, options_.known), 0, {}};
    // Of effects with both signs the one whose strengths are looked for farther.
    const auto farthest = std::max_element(levels.begin(), levels.end(), [](const auto& a, const auto& b) {
      return std::abs(a.strength) < std::abs(b.strength);
    });
    const bool length = std::isinf(candidate.fitted_knobs().front().absent);
    const double sign = farthest->strength < 0 ? -1 : 1;
    effect.typical = std::abs(length ? candidate.value_of(candidate.prior.typical) : candidate.prior.typical);
    for (const Metric& metric : metrics_) {
      const double strength = smallest(candidate, levels, metric, sign);
      effect.smallest.push_back(!std::isfinite(strength) ? (length ? 0 : strength)
                                : length                 ? std::abs(candidate.value_of(sign * strength))
                                                         : strength);
    }
    return effect;
  }

  /// Returns the smallest strength that is seen, from absence; infinite where the strongest is not seen.
  double smallest(const Candidate& candidate, const std::vector<SimulatedLevel>& simulated,
                  const Metric& metric, double sign) const {
    std::vector<SignatureLevel> levels;
    for (const SimulatedLevel& one : simulated)
      levels.push_back(
          {one.strength, (*metric.outside)(stacked(one.change, metric)), metric.chaos * one.of_chaos});
    const Signature known(levels, {Eigen::VectorXd::Zero(levels.front().change.size()), 0});
    const double needed =
        std::log(rules::answer_set / (1 - rules::answer_set)) -
        prior_log_odds(candidate.prior.odds, static_cast<double>(options_.known.searched()));
    const auto is_seen = [&](double strength) {
      const double s = sign * strength;
      const Signature filmed(levels, {known.share_seen(s) * known.change(s), 0});
      return posterior_of(filmed, candidate.strengths).log_evidence > needed;
    };
    const double strongest = sign > 0 ? candidate.strengths.high : -candidate.strengths.low;
    if (!is_seen(strongest)) return std::numeric_limits<double>::infinity();
    double low = 1e-4 * strongest, high = strongest;
    if (is_seen(low)) return low;
    constexpr double told = 1.02;  // to two per cent
    while (high > told * low) (is_seen(std::sqrt(low * high)) ? high : low) = std::sqrt(low * high);
    return high;
  }

  static Eigen::VectorXd stacked(const std::vector<Eigen::VectorXd>& runs, const Metric& metric) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(metric.total);
    Eigen::Index at = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      column.segment(at, runs[r].size()) = metric.roots[r].matrixL().solve(runs[r]);
      at += runs[r].size();
    }
    return column;
  }

  const Setup& setup_;
  const Engine& engine_;
  const MapOptions& options_;
  std::vector<MeasuredFeatures> measured_;
  std::chrono::steady_clock::time_point end_;
  Workshop workshop_;
  std::vector<Knob> knobs_;  ///< what is free in every experiment
  std::vector<Emulator> nothing_, slopes_;
  std::vector<Metric> metrics_;  ///< of each line
  StrengthMap map_;
};

}  // namespace

std::vector<MapLine> usual_lines(double noise) {
  std::vector<MapLine> lines{{"", "as planned"}};
  const auto add = [&](const char* varied, std::string value, double number, auto&& change) {
    lines.push_back({varied, std::move(value), number});
    change(lines.back());
  };
  for (const double mm : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0})
    add("noise of a frame", fmt::format("{:g} mm", mm), mm,
        [&](MapLine& line) { line.noise = 1e-3 * mm / noise; });
  for (const double mm : {0.02, 0.05, 0.1, 0.2, 0.5})
    add("wander of the track", fmt::format("{:g} mm", mm), mm,
        [&](MapLine& line) { line.wander = 1e-3 * mm; });
  for (const double ms : {0.0, 0.3, 1.0, 3.0, 10.0})
    add("shutter known to", ms > 0 ? fmt::format("{:g} ms", ms) : "exactly", ms,
        [&](MapLine& line) { line.shutter = 1e-3 * ms; });
  for (const double times : {1.0, 2.0, 4.0, 10.0})
    add("films of each run", fmt::format("{:g}", times), times, [&](MapLine& line) { line.runs = times; });
  for (const double error : {0.1, 0.03, 0.01, 0.003, 0.001})
    add("restitutions known to", fmt::format("{:g}", error), error,
        [&](MapLine& line) { line.restitution_error = error; });
  return lines;
}

StrengthMap strength_map(const Setup& setup, const Measurement& planned, const Engine& engine,
                         const std::vector<MapLine>& lines, const MapOptions& options) {
  const auto has_grains = [](const Measurement::Run& run) { return run.setup.grains.count > 0; };
  if (std::none_of(planned.runs.begin(), planned.runs.end(), has_grains))
    throw InputError({{{"--map", 0, 0},
                       "",
                       "no planned run has grains, and of boxes alone there is no map",
                       "ask --power for one strength, which takes seconds there"}});
  return Mapper(setup, planned, engine, options).run(lines);
}

}  // namespace shakedown
