// SPDX-License-Identifier: MIT
#include "audit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "nothing.hpp"
#include "outliers.hpp"
#include "robust_statistics.hpp"
#include "slow_wander.hpp"
#include "text.hpp"

namespace shakedown {

namespace {

double frame_interval_of(const std::vector<double>& time) {
  const double typical = typical_interval(time);
  double frames = 0;
  for (std::size_t i = 1; i < time.size(); ++i) frames += std::round((time[i] - time[i - 1]) / typical);
  return (time.back() - time.front()) / frames;
}

/// The frames of one series, where another of the run may have more: grains tracked in every fourth frame are
/// still neighbours of each other.
struct OwnFrames {
  std::vector<double> time, x;
  std::vector<std::size_t> at;  ///< place in the run
  double interval = 0;          ///< s
};

OwnFrames own_frames(const std::vector<double>& time, const std::vector<double>& x, double interval) {
  constexpr double mostly = 0.6;
  OwnFrames own{time, x, {}, interval};
  std::vector<std::size_t> present;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i])) present.push_back(i);
  if (present.size() < 5 || static_cast<double>(present.size()) > mostly * static_cast<double>(x.size())) {
    for (std::size_t i = 0; i < x.size(); ++i) own.at.push_back(i);
    return own;
  }
  own.time.clear(), own.x.clear();
  for (const std::size_t i : present) own.time.push_back(time[i]), own.x.push_back(x[i]);
  own.at = std::move(present);
  own.interval = frame_interval_of(own.time);
  return own;
}

/// Returns the variance that wrong frames too near to be seen add, m^2: as many per millimetre as there are
/// among those just far enough. Seen is what lies some seven standard deviations off.
double unseen_outliers(const std::vector<double>& raw, const std::vector<double>& kept, double deviation) {
  const double seen = 7 * deviation;
  double near = 0, present = 0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    present += std::isfinite(kept[i]);
    if (!std::isfinite(raw[i]) || std::isfinite(kept[i])) continue;
    std::size_t left = i, right = i;
    while (left > 0 && !std::isfinite(kept[left])) --left;
    while (right + 1 < raw.size() && !std::isfinite(kept[right])) ++right;
    if (!std::isfinite(kept[left]) || !std::isfinite(kept[right])) continue;
    const double share = static_cast<double>(i - left) / static_cast<double>(right - left);
    const double jump = std::abs(raw[i] - kept[left] - share * (kept[right] - kept[left]));
    near += jump > seen && jump < 3 * seen;
  }
  // near / (4 seen) a metre, both signs together, times the integral of the jump's square from -seen to seen.
  return near * seen * seen / (6 * std::max(1.0, present));
}

NoiseFound noise_of(const std::vector<double>& time, std::vector<double>& x, double interval,
                    double declared) {
  NoiseFound noise;
  noise.declared = declared;
  OwnFrames own = own_frames(time, x, interval);
  NoiseSeries series = noise_series(own.time, own.x, own.interval);
  const auto present = [&] {
    return std::count_if(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
  };
  const auto before = present();
  const std::vector<double> raw = own.x;
  // Without frames enough in a row nothing tells noise from motion, nor a wrong frame from a right one.
  if (const double white = white_deviation(series); std::isfinite(white)) {
    own.x = without_outliers(own.time, own.x, own.interval, white);
    for (std::size_t i = 0; i < own.at.size(); ++i) x[own.at[i]] = own.x[i];
    noise.outliers = static_cast<int>(before - present());
    if (noise.outliers > 0) series = noise_series(own.time, own.x, own.interval);
    noise.correlation = colour_of({series});
  }
  set_deviation(series, noise);
  noise.standard_deviation =
      std::hypot(noise.standard_deviation, std::sqrt(unseen_outliers(raw, own.x, noise.standard_deviation)));
  return noise;
}

void count_gaps(const std::vector<double>& time, const std::vector<double>& x, double interval,
                NoiseFound& noise) {
  double last = nothing;
  int present = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (!std::isfinite(x[i])) continue;
    if (std::isfinite(last)) noise.longest_gap = std::max(noise.longest_gap, time[i] - last - interval);
    last = time[i];
    ++present;
  }
  const auto frames = static_cast<int>(std::lround((time.back() - time.front()) / interval)) + 1;
  noise.missing = std::max(0, frames - present - noise.outliers);
}

/// Finds the plateau: the packed layer rests at its largest distance from the centre, the 95 % quantile of
/// the recorded distance, smoothed over 20 ms, in the first two seconds.
void find_plateau(const MeasuredRun& run, const RunAudit& audit, double& plateau, double& error) {
  plateau = nothing;
  error = nothing;
  if (audit.x_com.empty()) return;
  constexpr double averaging = 0.02;  // s
  const int half = std::max(1, static_cast<int>(averaging / audit.frame_interval / 2));
  const double noise = std::hypot(audit.box.standard_deviation, audit.com.standard_deviation);
  std::vector<double> smooth;
  for (std::size_t i = static_cast<std::size_t>(half);
       i + static_cast<std::size_t>(half) < run.time.size() && run.time[i] < 2; ++i) {
    double sum = 0;
    int count = 0;
    for (std::size_t j = i - static_cast<std::size_t>(half); j <= i + static_cast<std::size_t>(half); ++j) {
      const double difference = audit.x_com[j] - audit.x_box[j];
      if (std::isfinite(difference)) sum += difference, ++count;
    }
    if (count > half) smooth.push_back(std::abs(sum / count));
  }
  if (smooth.size() < 20) return;
  std::sort(smooth.begin(), smooth.end());
  // The 95 % quantile: packed for more than a tenth of the time, and far from the noise's own extremes.
  plateau = smooth[smooth.size() * 95 / 100];
  error = std::max(noise / std::sqrt(2.0 * half + 1), 1e-4);  // the layer's thickness repeats to about 0.1 mm
}

std::string source_in_words(const NoiseFound& noise) {
  switch (noise.source) {
    case NoiseSource::frames: return "";
    case NoiseSource::bound:
      return "frames this far apart do not tell noise from motion; " + millimetres(noise.standard_deviation) +
             " is taken, which may be too much (say uncertainty in the experiment file)";
    case NoiseSource::declared:
      return "the uncertainty of the experiment file, " + millimetres(noise.declared) +
             ", is used: the frames do not tell their noise, or scatter by less";
    case NoiseSource::assumed:
      return "too few frames in a row to tell their noise, and the experiment file says no uncertainty; " +
             millimetres(noise.standard_deviation) + " is assumed";
  }
  return "";
}

void warn_about(const RunAudit& run, const NoiseFound& noise, const char* what,
                std::vector<std::string>& warnings) {
  const std::string who = run.run + ", " + what + ": ";
  if (noise.source == NoiseSource::frames && noise.declared > 0 &&
      noise.standard_deviation > 1.25 * noise.declared)
    warnings.push_back(who + "the frames scatter by " + millimetres(noise.standard_deviation) +
                       " where the experiment file says " + millimetres(noise.declared) +
                       "; the found value is used");
  if (const std::string words = source_in_words(noise); !words.empty()) warnings.push_back(who + words);
  if (noise.correlation[0] != 0) {
    char text[16];
    std::snprintf(text, sizeof text, "%.2f", noise.correlation[0]);
    warnings.push_back(who + "neighbouring frames err together (correlation " + text +
                       "): smoothed before it was written?");
  }
  if (noise.wander > 0) {
    char text[16];
    std::snprintf(text, sizeof text, "%.2g s", noise.wander_time);
    warnings.push_back(who + "at rest positions wander by " + millimetres(noise.wander) + " within " + text);
  }
  if (noise.quantum > 0)
    warnings.push_back(who + "positions come in steps of " + millimetres(noise.quantum) + " (whole pixels?)");
  if (noise.outliers > 0)
    warnings.push_back(who + std::to_string(noise.outliers) +
                       " frames far from their neighbours are taken as missing");
}

/// Pools one of the two series.
void pool_series(const std::vector<const MeasuredRun*>& recorded, const std::vector<RunAudit*>& runs,
                 NoiseFound RunAudit::*noise, std::vector<double> RunAudit::*series) {
  std::vector<OwnFrames> own(runs.size());
  std::vector<NoiseSeries> ready(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if ((runs[i]->*series).empty()) continue;
    own[i] = own_frames(recorded[i]->time, runs[i]->*series, runs[i]->frame_interval);
    ready[i] = noise_series(own[i].time, own[i].x, own[i].interval);
    if ((runs[i]->*noise).source != NoiseSource::frames) own[i].x.clear();
  }
  for (std::size_t first = 0; first < runs.size(); ++first) {
    std::vector<std::size_t> members;
    bool is_first = true;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const bool same = std::abs(own[i].interval / own[first].interval - 1) < 0.01 && !own[i].x.empty();
      if (same && i < first) is_first = false;
      if (same) members.push_back(i);
    }
    if (!is_first || members.size() < 2 || own[first].x.empty()) continue;
    std::vector<NoiseSeries> pooled;
    for (const std::size_t i : members) pooled.push_back(ready[i]);
    const auto colour = colour_of(pooled);
    double mean_square = 0, lowest = 1e300, highest = 0;
    for (std::size_t k = 0; k < members.size(); ++k) {
      NoiseFound& found = runs[members[k]]->*noise;
      found.correlation = colour;
      set_deviation(pooled[k], found);
      const double deviation = found.standard_deviation;
      mean_square += deviation * deviation / static_cast<double>(members.size());
      lowest = std::min(lowest, deviation), highest = std::max(highest, deviation);
    }
    if (highest < 1.1 * lowest)
      for (const std::size_t i : members) (runs[i]->*noise).standard_deviation = std::sqrt(mean_square);
  }
}

/// Noise alone rarely spans more than this many of its standard deviations in the frames of a period.
constexpr double still = 8;

/// Returns the stretches that both lists have in common, so that neither box nor grains move.
std::vector<RestStretch> common_to(const std::vector<RestStretch>& one,
                                   const std::vector<RestStretch>& other) {
  std::vector<RestStretch> both;
  for (const RestStretch& a : one)
    for (const RestStretch& b : other)
      if (const RestStretch c{std::max(a.first, b.first), std::min(a.end, b.end)}; c.first < c.end)
        both.push_back(c);
  return both;
}

void set_wander(const std::vector<double>& time, const std::vector<double>& x,
                const std::vector<RestStretch>& rests, double period, NoiseFound& noise) {
  const Wander wander = wander_at_rest(time, x, rests, period);
  noise.wander = wander.deviation;
  noise.wander_time = wander.time;
}

}  // namespace

RunAudit audit_run(const MeasuredRun& run) {
  RunAudit audit;
  audit.run = run.name;
  audit.x_box = run.x_box;
  audit.x_com = run.x_com;
  audit.plateau = audit.plateau_error = nothing;
  if (run.time.size() < 2) return audit;
  audit.frame_interval = frame_interval_of(run.time);
  audit.box = noise_of(run.time, audit.x_box, audit.frame_interval, run.box_uncertainty);
  count_gaps(run.time, audit.x_box, audit.frame_interval, audit.box);
  const MotionSeen box = motion_seen(run.time, audit.x_box);
  audit.release =
      release_found(run.time, audit.x_box, box, audit.frame_interval, audit.box.standard_deviation);
  std::vector<RestStretch> rests = rests_of(box, still * audit.box.standard_deviation);
  if (run.has_com()) {
    audit.com = noise_of(run.time, audit.x_com, audit.frame_interval, run.com_uncertainty);
    count_gaps(run.time, audit.x_com, audit.frame_interval, audit.com);
    find_plateau(run, audit, audit.plateau, audit.plateau_error);
    rests =
        common_to(rests, rests_of(motion_seen(run.time, audit.x_com), still * audit.com.standard_deviation));
    set_wander(run.time, audit.x_com, rests, box.period, audit.com);
  }
  set_wander(run.time, audit.x_box, rests, box.period, audit.box);
  return audit;
}

void pool_noise(const std::vector<const MeasuredRun*>& recorded, const std::vector<RunAudit*>& runs) {
  pool_series(recorded, runs, &RunAudit::box, &RunAudit::x_box);
  pool_series(recorded, runs, &RunAudit::com, &RunAudit::x_com);
}

std::vector<std::string> warnings_of(const RunAudit& run) {
  std::vector<std::string> warnings;
  warn_about(run, run.box, "box", warnings);
  if (!run.x_com.empty()) warn_about(run, run.com, "grains", warnings);
  return warnings;
}

}  // namespace shakedown
