// SPDX-License-Identifier: MIT
#include "paper.hpp"

#include <algorithm>
#include <chrono>

#include "effects.hpp"
#include "engines.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

Setup damper(double length) {
  Setup setup;
  setup.box.length = length;
  setup.run.duration = 30;
  return setup;
}

std::vector<double> range(double from, double to, double step) {
  std::vector<double> values;
  for (int i = 0; from + i * step < to + step / 2; ++i)
    values.push_back((1000 * from + 1000 * step * i) / 1000);
  return values;
}

class Reproduction {
 public:
  explicit Reproduction(const PaperOptions& options) : options_(options) {}

  PaperRuns run() {
    const int runs = options_.quick ? 12 : 32;
    for (const double length : {0.040, 0.065, 0.085, 0.104, 0.311}) {
      tell("the damper, hard engine");
      runs_.hard.push_back(damper_runs(*hard_, damper(length), wanted(runs)));
      tell("the damper, soft engine");
      runs_.soft.push_back(soft_runs(length));
    }
    tell("variations");
    vary(runs);
    tell("lengths of the box");
    std::vector<double> lengths = options_.quick ? range(0.025, 0.600, 0.025) : range(0.025, 0.600, 0.005);
    lengths.insert(std::upper_bound(lengths.begin(), lengths.end(), 0.311), 0.311);
    runs_.lengths = sweep_lengths(*hard_, damper(0.040), lengths, wanted(options_.quick ? 6 : 16));
    tell("frequencies and restitutions");
    sweep_about_the_optimum();
    runs_.puzzle =
        solve_puzzle({options_.quick, options_.execution, [this](const std::string& stage) { tell(stage); }});
    return std::move(runs_);
  }

 private:
  RunsWanted wanted(int runs) const { return {runs, options_.execution}; }

  void tell(const std::string& stage) {
    const double steps = options_.quick ? 19 : 22;
    if (options_.progress) options_.progress(stage, step_++ / steps);
  }

  /// Runs the soft engine, more often at the optimum: there runs differ most, and statements on two
  /// oscillations and on one second need their mean.
  DamperRuns soft_runs(double length) const {
    Setup setup = damper(length);
    const bool optimum = length > 0.2;
    if (optimum) setup.run.duration = 22;
    return damper_runs(*soft_, setup, wanted(optimum ? (options_.quick ? 8 : 24) : options_.quick ? 5 : 10));
  }

  void vary(int runs) {
    for (const double length : {0.040, 0.104}) {
      Setup finer = damper(length);
      finer.hard.wall_elastic_fraction /= 3;
      finer.hard.pair_elastic_speed /= 3;
      runs_.finer.push_back(damper_runs(*hard_, finer, wanted(2 * runs)));
    }
    Setup twice = damper(0.040);
    twice.spring.frequency *= 2;
    twice.run.duration /= 2;
    twice.run.sample_rate *= 2;
    twice.hard.pair_elastic_speed *= 2;
    runs_.twice_the_frequency = damper_runs(*hard_, twice, wanted(runs));
    Setup elastic = damper(0.040);
    set_number(elastic, "side_wall_restitution.restitution", 1, all_effects());
    runs_.elastic_side_walls = damper_runs(*hard_, elastic, wanted(runs));
  }

  void sweep_about_the_optimum() {
    const std::vector<double> lengths =
        options_.quick ? range(0.150, 0.450, 0.050) : range(0.125, 0.500, 0.025);
    std::vector<double> with_optimum = lengths;
    with_optimum.insert(std::upper_bound(with_optimum.begin(), with_optimum.end(), 0.311), 0.311);
    const RunsWanted how = wanted(options_.quick ? 12 : 32);
    for (const double frequency : {0.5, 1.23, 5.0}) {
      Setup setup = damper(0.040);
      setup.spring.frequency = frequency;
      runs_.frequencies.push_back(sweep_lengths(*hard_, setup, with_optimum, how));
    }
    for (const double restitution : {0.5, 0.6, 0.75, 0.9}) {
      Setup setup = damper(0.040);
      setup.restitution = {restitution, restitution};
      runs_.restitutions.push_back(sweep_lengths(*hard_, setup, with_optimum, how));
    }
  }

  const PaperOptions& options_;
  const std::unique_ptr<Engine> hard_ = engine_named("hard"), soft_ = engine_named("soft");
  PaperRuns runs_;
  int step_ = 0;
};

}  // namespace

Paper reproduce_paper(const PaperOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Paper paper{Reproduction(options).run(), {}, {}, 0};
  for (const auto part : {statements_of_motion, statements_of_decay, statements_of_optimum})
    for (Statement& statement : part(paper.runs)) paper.statements.push_back(std::move(statement));
  paper.charts = charts_of(paper.runs);
  paper.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return paper;
}

}  // namespace shakedown
