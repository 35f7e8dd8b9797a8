// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "experiment.hpp"
#include "waveform.hpp"

namespace shakedown {

namespace {

constexpr std::size_t least_frames = 16;
/// Frames a period that are kept at least: a mean over a fiftieth of a period has lost 7e-4 of the swing,
/// alike everywhere.
constexpr double frames_a_period = 48;

WaveformRun waveform_run(const Measurement::Run& run, bool every_frame) {
  WaveformRun made{run.recorded.name, run.setup, {}, {}, run.audit.box.standard_deviation, 0, 0};
  std::vector<double> time, x;
  for (std::size_t i = 0; i < run.recorded.time.size(); ++i)
    if (std::isfinite(run.audit.x_box[i]) &&
        (starts_anywhere(run.recorded, run.setup) || run.recorded.time[i] >= 0))
      time.push_back(run.recorded.time[i]), x.push_back(run.audit.x_box[i]);
  if (time.size() < least_frames) return made;
  made.begin = time.front();
  const double interval = (time.back() - time.front()) / static_cast<double>(time.size() - 1),
               period = 1 / run.setup.spring.frequency;
  const auto group =
      every_frame ? std::size_t{1}
                  : static_cast<std::size_t>(std::max(1.0, std::floor(period / interval / frames_a_period)));
  // An uneven clock (an encoder's edges: no row while it rests) has a long time in few rows, which no mean
  // may span.
  const double longest = static_cast<double>(group) * interval * (1 + 1e-6);
  std::size_t used = 0;
  for (std::size_t i = 0; i < time.size();) {
    double t = 0, sum = 0;
    std::size_t k = i;
    for (; k < time.size() && k < i + group && time[k] - time[i] < longest; ++k) t += time[k], sum += x[k];
    const bool cut_off = k == time.size() && k < i + group && i > 0;
    const auto count = static_cast<double>(k - i);
    if (!cut_off) made.time.push_back(t / count), made.x.push_back(sum / count);
    used += cut_off ? 0 : k - i;
    i = k;
  }
  const auto [low, high] = std::minmax_element(made.x.begin(), made.x.end());
  made.amplitude = (*high - *low) / 2;
  made.white /= std::sqrt(static_cast<double>(used) / static_cast<double>(made.time.size()));
  // A recording without any noise is known to its rounding.
  made.noise = std::max(made.white, 1e-6 * made.amplitude);
  return made;
}

}  // namespace

std::vector<WaveformRun> waveform_runs(const Measurement& measurement, bool every_frame) {
  std::vector<WaveformRun> runs;
  for (const Measurement::Run& run : measurement.runs)
    if (run.setup.spring.frequency > 0)
      if (WaveformRun made = waveform_run(run, every_frame);
          made.time.size() >= least_frames && made.amplitude > 0)
        runs.push_back(std::move(made));
  return runs;
}

}  // namespace shakedown
