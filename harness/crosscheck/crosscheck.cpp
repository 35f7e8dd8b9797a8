// SPDX-License-Identifier: MIT
#include "crosscheck.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engines.hpp"

namespace shakedown {

namespace {

using Judged = CrosscheckNumber::Judged;

template <std::size_t contact_class>
double share(const RunResult& run) {
  return run.observables.energy_loss[contact_class];
}

/// Stands for collisions that a program of other people does not tell; its trajectory has them below zero.
constexpr double not_told = std::numeric_limits<double>::quiet_NaN();

template <std::size_t contact_class>
double collisions(const RunResult& run) {
  if (run.trajectory.collisions[contact_class] < 0) return not_told;
  return static_cast<double>(run.trajectory.collisions[contact_class]);
}

double all_collisions(const RunResult& run) {
  double sum = 0;
  for (const std::int64_t count : run.trajectory.collisions) sum += static_cast<double>(count);
  return sum < 0 ? not_told : sum;
}

constexpr CrosscheckNumber numbers[] = {
    {"slope_mm_per_s", "slope of |peak|", "mm/s", 1e3, Judged::slope,
     [](const RunResult& run) { return run.observables.slope; }},
    {"frequency_hz", "frequency", "Hz", 1, Judged::frequency,
     [](const RunResult& run) { return run.observables.frequency; }},
    {"energy_loss_grain_grain", "share lost grain-grain", "", 1, Judged::share, share<0>},
    {"energy_loss_end_wall", "share lost end walls", "", 1, Judged::share, share<1>},
    {"energy_loss_side_wall", "share lost side walls", "", 1, Judged::share, share<2>},
    {"linear_slope_error_mm_per_s", "error of the slope in a run", "mm/s", 1e3, Judged::no,
     [](const RunResult& run) { return run.observables.decay.linear.slope_error; }},
    {"linear_rms_mm", "rms about the straight line", "mm", 1e3, Judged::no,
     [](const RunResult& run) { return run.observables.decay.linear.rms; }},
    {"exponential_rate_per_s", "exponential: rate", "1/s", 1, Judged::no,
     [](const RunResult& run) { return run.observables.decay.exponential.rate; }},
    {"exponential_rate_error_per_s", "error of the rate in a run", "1/s", 1, Judged::no,
     [](const RunResult& run) { return run.observables.decay.exponential.rate_error; }},
    {"exponential_rms_mm", "rms about the exponential", "mm", 1e3, Judged::no,
     [](const RunResult& run) { return run.observables.decay.exponential.rms; }},
    {"curvature_mm_per_s2", "curvature of |peak|", "mm/s^2", 1e3, Judged::no,
     [](const RunResult& run) { return run.observables.decay.curvature; }},
    {"collisions_grain_grain", "collisions grain-grain", "", 1, Judged::no, collisions<0>},
    {"collisions_end_wall", "collisions end walls", "", 1, Judged::no, collisions<1>},
    {"collisions_side_wall", "collisions side walls", "", 1, Judged::no, collisions<2>},
    {"wall_seconds", "wall time of a run", "s", 1, Judged::no,
     [](const RunResult& run) { return run.trajectory.wall_seconds; }},
    {"collisions_per_second", "collisions per second of it", "1/s", 1, Judged::no,
     [](const RunResult& run) { return all_collisions(run) / run.trajectory.wall_seconds; }},
    {"times_real_time", "times faster than reality", "", 1, Judged::no,
     [](const RunResult& run) { return run.trajectory.end_time / run.trajectory.wall_seconds; }},
};

std::vector<Statistic> peaks_of_every_run(const Ensemble& ensemble) {
  std::size_t count = ensemble.runs[0].observables.peaks.size();
  for (const RunResult& run : ensemble.runs) count = std::min(count, run.observables.peaks.size());
  std::vector<Statistic> peaks;
  for (std::size_t i = 0; i < count; ++i)
    peaks.push_back(
        ensemble.over_runs([&](const RunResult& run) { return run.observables.peaks[i].position; }));
  return peaks;
}

EngineResult result_of(const Engine& engine, const Setup& setup, const CrosscheckOptions& options,
                       const std::function<void(double)>& progress) {
  EnsembleOptions ensemble_options;
  ensemble_options.runs = options.runs;
  ensemble_options.execution = options.execution;
  ensemble_options.progress = progress;
  const Ensemble ensemble = run_ensemble(engine, setup, ensemble_options);
  if (ensemble.interrupted) throw Interrupted("not every run had finished, nothing was kept");
  EngineResult result{std::string(engine.name()), options.runs, {}, peaks_of_every_run(ensemble)};
  for (const CrosscheckNumber& number : numbers) result.numbers.push_back(ensemble.over_runs(number.of));
  return result;
}

double margin_of(const CrosscheckNumber& number, const Margins& margins, const Setup& setup, double slope) {
  switch (number.judged) {
    case Judged::slope: return slope_margin(margins, setup.box.length, slope);
    case Judged::frequency: return margins.frequency;
    case Judged::share: return margins.share;
    case Judged::no: break;
  }
  EXPECT(false && "a judged number");
  return 0;
}

void compare(const EngineResult& first, const EngineResult& second, const Setup& setup,
             const Margins& margins, std::vector<Comparison>& comparisons) {
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    if (numbers[i].judged == Judged::no) continue;
    const Statistic &one = first.numbers[i], &other = second.numbers[i];
    // An outside program need not tell where the energy went; more runs of it would not either.
    if (numbers[i].judged == Judged::share && (one.n == 0 || other.n == 0)) continue;
    const double slope = one.n > 0 ? one.mean : other.n > 0 ? other.mean : 0;
    const Equivalence found = equivalence_of(one, other, margin_of(numbers[i], margins, setup, slope));
    if (found.verdict != Agreement::no_number)
      comparisons.push_back({first.engine, second.engine, &numbers[i], found});
  }
}

/// The engines and setups to run: those asked for, then the soft engine once a contact time, and the hard one
/// when only the limit needs it.
struct Job {
  std::string engine;
  Setup setup;
};

std::vector<Job> jobs_of(const Setup& setup, const CrosscheckOptions& options) {
  std::vector<Job> jobs;
  for (const std::string& name : options.engines) jobs.push_back({name, setup});
  for (const double time : options.contact_times) {
    jobs.push_back({"soft", setup});
    jobs.back().setup.soft.contact_time = time;
  }
  if (!options.contact_times.empty() && std::ranges::find(options.engines, "hard") == options.engines.end())
    jobs.push_back({"hard", setup});
  return jobs;
}

ContactTimeLimit::Value limit_value(const ContactTimeLimit& limit, std::size_t number,
                                    const EngineResult& hard) {
  std::vector<double> means, errors;
  for (const EngineResult& result : limit.results) {
    const Statistic& statistic = result.numbers[number];
    means.push_back(statistic.mean);
    errors.push_back(statistic.sd / std::sqrt(statistic.n));
  }
  const LineAtZero line = line_at_zero(limit.contact_times, means, errors);
  return {&numbers[number], line.value, line.error, line.chi_squared, hard.numbers[number]};
}

ContactTimeLimit limit_of(const std::vector<double>& contact_times, std::vector<EngineResult> results,
                          const EngineResult& hard) {
  ContactTimeLimit limit{contact_times, std::move(results), {}};
  for (std::size_t i = 0; i < std::size(numbers); ++i)
    if (numbers[i].judged != Judged::no) limit.values.push_back(limit_value(limit, i, hard));
  return limit;
}

}  // namespace

std::span<const CrosscheckNumber> crosscheck_numbers() { return numbers; }

double slope_margin(const Margins& margins, double box_length, double slope) {
  if (margins.slope) return *margins.slope;
  constexpr double of_length[][2] = {{0.040, 1.0e-4}, {0.065, 5e-4}, {0.085, 6e-4}, {0.104, 8e-4}};
  for (const auto& [length, margin] : of_length)
    if (std::abs(box_length - length) < 1e-9) return margin;
  return 0.03 * std::abs(slope);
}

double ContactTimeLimit::Value::deviation() const {
  return (at_zero - hard.mean) / std::hypot(error, hard.sd / std::sqrt(hard.n));
}

bool Crosscheck::any(Agreement verdict) const {
  return std::ranges::any_of(
      comparisons, [&](const Comparison& comparison) { return comparison.found.verdict == verdict; });
}

LineAtZero line_at_zero(std::span<const double> x, std::span<const double> y,
                        std::span<const double> errors) {
  EXPECT(x.size() >= 2 && y.size() == x.size() && errors.size() == x.size());
  double weights = 0, wx = 0, wy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double weight = 1 / (errors[i] * errors[i]);
    weights += weight;
    wx += weight * x[i];
    wy += weight * y[i];
  }
  const double middle_x = wx / weights, middle_y = wy / weights;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double weight = 1 / (errors[i] * errors[i]);
    xx += weight * (x[i] - middle_x) * (x[i] - middle_x);
    xy += weight * (x[i] - middle_x) * (y[i] - middle_y);
  }
  LineAtZero line{middle_y - xy / xx * middle_x, std::sqrt(1 / weights + middle_x * middle_x / xx), 0};
  for (std::size_t i = 0; i < x.size(); ++i)
    line.chi_squared += std::pow((y[i] - line.value - xy / xx * x[i]) / errors[i], 2);
  return line;
}

Crosscheck crosscheck(const std::string& name, const Setup& setup, const CrosscheckOptions& options) {
  const std::vector<Job> jobs = jobs_of(setup, options);
  std::vector<std::unique_ptr<Engine>> engines;
  for (const Job& job : jobs) {
    engines.push_back(engine_named(job.engine));
    refuse_what_is_not_modelled(*engines.back(), job.setup);
  }
  std::vector<EngineResult> results;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    results.push_back(result_of(*engines[i], jobs[i].setup, options, [&](double fraction) {
      const auto count = static_cast<double>(jobs.size());
      if (options.progress) options.progress((static_cast<double>(i) + fraction) / count);
    }));

  const auto limit_begin = results.begin() + static_cast<std::ptrdiff_t>(options.engines.size());
  Crosscheck found{name, setup.run.duration, {results.begin(), limit_begin}, {}, std::nullopt};
  for (std::size_t i = 0; i < found.engines.size(); ++i)
    for (std::size_t j = i + 1; j < found.engines.size(); ++j)
      compare(found.engines[i], found.engines[j], setup, options.margins, found.comparisons);
  if (!options.contact_times.empty())
    found.limit =
        limit_of(options.contact_times,
                 {limit_begin, limit_begin + static_cast<std::ptrdiff_t>(options.contact_times.size())},
                 *std::ranges::find(results, "hard", &EngineResult::engine));
  return found;
}

}  // namespace shakedown
