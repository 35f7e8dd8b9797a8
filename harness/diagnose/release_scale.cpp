// SPDX-License-Identifier: MIT
#include "release_scale.hpp"

#include <cmath>

#include "experiment_file.hpp"

namespace shakedown {

std::optional<ReleaseScale> scale_at_release(const Setup& setup, const Experiment& experiment,
                                             const Audit& audit, std::span<const EffectRecord* const> known) {
  constexpr double still = 0.02;          // s, in which the box moves some 1.3 mm
  constexpr double systematic = 0.05e-3;  // m, by which grains that are hit, or a clock 2 ms late, shift x0
  const std::vector<Setup> setups = setups_of_runs(setup, experiment, known);
  double weights = 0, sum = 0, displacement = 0;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    const MeasuredRun& run = experiment.runs[r];
    double n = 0, tt = 0, tttt = 0, x = 0, xtt = 0;
    for (std::size_t i = 0; i < run.time.size() && run.time[i] < still; ++i) {
      const double at = audit.runs[r].x_box[i], square = run.time[i] * run.time[i];
      if (run.time[i] < 0 || !std::isfinite(at)) continue;
      n += 1, tt += square, tttt += square * square, x += at, xtt += at * square;
    }
    const double determinant = n * tttt - tt * tt, given = setups[r].release.displacement;
    const double noise = audit.runs[r].box.standard_deviation;
    if (n < 4 || determinant <= 0 || given == 0 || noise <= 0) continue;
    const double start = (tttt * x - tt * xtt) / determinant;
    const double variance = noise * noise * tttt / determinant / (given * given);
    weights += 1 / variance, sum += (start / given - 1) / variance, displacement = std::abs(given);
  }
  if (weights == 0) return std::nullopt;
  return ReleaseScale{sum / weights, std::hypot(std::sqrt(1 / weights), systematic / displacement)};
}

}  // namespace shakedown
