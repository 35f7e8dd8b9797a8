// SPDX-License-Identifier: MIT
#include "length_sweep.hpp"

#include <cmath>

#include "in_order.hpp"

namespace shakedown {

namespace {
constexpr double cycles_of_run = 60 * 1.23;
}  // namespace

LengthSweep sweep_lengths(const Engine& engine, const Setup& base, const std::vector<double>& lengths,
                          const RunsWanted& wanted) {
  LengthSweep sweep{base, {}};
  std::vector<std::array<std::vector<double>, 4>> seconds(lengths.size());
  const int count = static_cast<int>(lengths.size()) * wanted.runs;
  work_in_parallel_deliver_in_order(count, wanted.execution.threads, [&](int job) -> std::function<void()> {
    const auto place = static_cast<std::size_t>(job / wanted.runs);
    Setup setup = base;
    setup.box.length = lengths[place];
    setup.run.duration = cycles_of_run / base.spring.frequency;
    setup.run.sample_rate = 200 * base.spring.frequency;
    const Trajectory trajectory = engine.run(setup, {job % wanted.runs, {}, wanted.execution.stop});
    if (trajectory.interrupted) throw Interrupted("stopped while lengths were swept");
    std::array<double, 4> found{};
    for (std::size_t f = 0; f < found.size(); ++f)
      found[f] = seconds_to_energy_fraction(trajectory, 1 - lost_fractions[f]);
    return [&seconds, place, found] {
      for (std::size_t f = 0; f < found.size(); ++f) seconds[place][f].push_back(found[f]);
    };
  });
  for (std::size_t p = 0; p < lengths.size(); ++p) {
    LengthPoint point{lengths[p], {}, {}};
    for (std::size_t f = 0; f < point.seconds.size(); ++f) {
      point.seconds[f] = statistic_of(seconds[p][f]);
      point.censored[f] = wanted.runs - point.seconds[f].n;
    }
    sweep.points.push_back(point);
  }
  return sweep;
}

std::size_t LengthSweep::fastest() const {
  std::size_t best = points.size();
  for (std::size_t p = 0; p < points.size(); ++p)
    if (points[p].censored[3] == 0 &&
        (best == points.size() || points[p].seconds[3].mean < points[best].seconds[3].mean))
      best = p;
  EXPECT(best < points.size());
  return best;
}

}  // namespace shakedown
