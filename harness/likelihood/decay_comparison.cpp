// SPDX-License-Identifier: MIT
#include "decay_comparison.hpp"

#include <cmath>

#include "in_order.hpp"
#include "observables.hpp"

namespace shakedown {

namespace {

struct Numbers {
  double frequency = absent, slope = absent;
  std::vector<double> peaks;
};

Numbers numbers_of(const FeaturePlan& plan, const Eigen::VectorXd& values, const Setup& setup,
                   int most_peaks) {
  std::vector<double> time, position;
  for (std::size_t f = 0; f < plan.features.size(); ++f) {
    if (plan.features[f].observable != Observable::box) continue;
    time.push_back(plan.features[f].time);
    position.push_back(values[static_cast<Eigen::Index>(f)]);
  }
  Numbers numbers;
  if (time.size() < 8) return numbers;
  const SampledMotion motion{time, position, {}};
  const std::vector<double> crossings = zero_crossings(motion, 4 * shortest_half_period(setup));
  const std::vector<Peak> peaks = largest_extrema(motion, crossings);
  numbers.frequency = frequency_of(crossings);
  numbers.slope = decay_of(peaks).linear.slope;
  for (std::size_t i = 0; i < peaks.size() && i < static_cast<std::size_t>(most_peaks); ++i)
    numbers.peaks.push_back(peaks[i].position);
  return numbers;
}

/// Mean and spread of what the simulations have; none: NaN.
MeasuredNumber beside(double measured, const std::vector<double>& simulated) {
  double sum = 0, squares = 0, count = 0;
  for (const double value : simulated)
    if (std::isfinite(value)) sum += value, squares += value * value, ++count;
  if (count < 2) return {measured, absent, absent};
  const double mean = sum / count;
  return {measured, mean, std::sqrt(std::max(0.0, (squares / count - mean * mean) * count / (count - 1)))};
}

template <class Pick>
MeasuredNumber number(const Numbers& measured, const std::vector<Numbers>& simulated, const Pick& pick) {
  std::vector<double> values;
  for (const Numbers& one : simulated) values.push_back(pick(one));
  return beside(pick(measured), values);
}

}  // namespace

std::vector<DecayComparison> compare_decay(const Experiment& experiment, const Audit& audit,
                                           const std::vector<Setup>& setups, const Workshop& workshop,
                                           int runs, int first_run, int most_peaks) {
  constexpr double rest = 4e-3, level = 0.05;  // m, s
  std::vector<FeaturePlan> plans;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r)
    plans.push_back(plan_features(experiment.runs[r], audit.runs[r], Observed::all, rest, level));
  std::vector<std::vector<Numbers>> simulated(plans.size());
  const int all = static_cast<int>(plans.size()) * runs;
  work_in_parallel_deliver_in_order(
      all, threads_or_all(workshop.threads), [&](int job) -> std::function<void()> {
        const auto r = static_cast<std::size_t>(job / runs);
        if (workshop.stop && *workshop.stop) throw Interrupted("interrupted");
        Setup setup = setups[r];
        setup.run.duration = std::max(0.5, plans[r].end + level);
        setup.run.sample_rate = 500;
        RunOptions options;
        options.run = first_run + job;
        options.stop = workshop.stop;
        const Trajectory trajectory = workshop.engine->run(setup, options);
        if (trajectory.interrupted) throw Interrupted("interrupted");
        Numbers numbers = numbers_of(
            plans[r], simulated_features(plans[r], recorded_by(physics_of(setup).camera, trajectory)), setup,
            most_peaks);
        return [&, r, numbers = std::move(numbers)] { simulated[r].push_back(numbers); };
      });
  std::vector<DecayComparison> list;
  for (std::size_t r = 0; r < plans.size(); ++r) {
    const Numbers measured = numbers_of(
        plans[r], measured_features(plans[r], audit.runs[r], experiment.runs[r]), setups[r], most_peaks);
    DecayComparison one{experiment.runs[r].name,
                        number(measured, simulated[r], [](const Numbers& n) { return n.frequency; }),
                        number(measured, simulated[r], [](const Numbers& n) { return n.slope; }),
                        {}};
    for (std::size_t p = 0; p < measured.peaks.size(); ++p)
      one.peaks.push_back(number(measured, simulated[r],
                                 [p](const Numbers& n) { return p < n.peaks.size() ? n.peaks[p] : absent; }));
    list.push_back(std::move(one));
  }
  return list;
}

}  // namespace shakedown
