// SPDX-License-Identifier: MIT
#include "audit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "outliers.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double usual_noise = 1e-3;  // m, of a camera of which nothing is known

double frame_interval_of(const std::vector<double>& time) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < time.size(); ++i) intervals.push_back(time[i] - time[i - 1]);
  const double typical = median(intervals);
  double frames = 0;
  for (const double interval : intervals) frames += std::round(interval / typical);
  return (time.back() - time.front()) / frames;
}

/// The frames of one series, where another of the run may have more: grains tracked in every fourth frame are
/// neighbours of each other all the same.
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

/// Whether a frame follows the one before it without a frame lost between.
NeighbouredSeries neighboured(const OwnFrames& own) {
  NeighbouredSeries series{&own.x, std::vector<char>(own.time.size(), 0)};
  for (std::size_t i = 1; i < own.time.size(); ++i)
    series.neighbour[i] = own.time[i] - own.time[i - 1] < 1.5 * own.interval;
  return series;
}

/// Variance that wrong frames too near to be seen add: as many per millimetre as there are among those just
/// far enough. Seen is what lies some seven standard deviations off.
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
  const NeighbouredSeries series = neighboured(own);
  const auto present = [&] {
    return std::count_if(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
  };
  const auto before = present();
  const std::vector<double> raw = own.x;
  const double white = white_deviation(series);
  if (!std::isfinite(white)) {  // without five frames in a row nothing tells noise from motion
    noise.standard_deviation = std::isfinite(declared) ? declared : usual_noise;
    return noise;
  }
  own.x = without_outliers(own.time, own.x, own.interval, std::max(white, 1e-9));
  for (std::size_t i = 0; i < own.at.size(); ++i) x[own.at[i]] = own.x[i];
  noise.outliers = static_cast<int>(before - present());
  noise.correlation = colour_of({series}, own.interval);
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

/// x = d + v t - a t^2/2 + j t^3 over the first 60 ms, least squares; the cubic absorbs what the spring and
/// the layer do next.
ReleaseFound release_of(const MeasuredRun& run, const std::vector<double>& x, double deviation) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < x.size() && run.time[i] < run.time.front() + 0.06; ++i)
    if (std::isfinite(x[i])) frames.push_back(i);
  ReleaseFound found;
  found.displacement = found.velocity = found.time = nothing;
  if (frames.size() < 6) return found;
  Eigen::MatrixXd powers(static_cast<Eigen::Index>(frames.size()), 3);
  Eigen::VectorXd values(powers.rows());
  for (Eigen::Index row = 0; row < powers.rows(); ++row) {
    const std::size_t i = frames[static_cast<std::size_t>(row)];
    const double t = run.time[i];
    powers.row(row) << 1, t, -t * t / 2;
    values[row] = x[i];
  }
  const Eigen::MatrixXd inverse = (powers.transpose() * powers).inverse();
  const Eigen::VectorXd fit = inverse * (powers.transpose() * values);
  found.displacement = fit[0];
  found.displacement_error = deviation * std::sqrt(inverse(0, 0));
  found.velocity = fit[1];
  found.velocity_error = deviation * std::sqrt(inverse(1, 1));
  found.time = fit[1] / fit[2];
  found.time_error = found.velocity_error / std::abs(fit[2]);
  return found;
}

/// The packed layer rests at its largest distance from the centre: the mean of the recorded distance over
/// frames whose smoothed value is within one standard deviation of the largest smoothed one, over the first
/// four half periods.
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

/// How thick the layer is depends on the grains: runs with others have a plateau of their own.
std::string grains_of(const MeasuredRun& run) {
  std::string text;
  for (const Override& override : run.overrides)
    if (override.key.starts_with("grains.")) text += override.key + "=" + override.value + ";";
  return text;
}

PlateauSlope plateau_slope(const Experiment& experiment, const std::vector<RunAudit>& runs) {
  struct Sums {
    double weight = 0, length = 0, plateau = 0;
  };
  std::map<std::string, Sums> means;
  const auto each = [&](const auto& visit) {
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (std::isfinite(runs[i].plateau) && std::isfinite(experiment.runs[i].box_length))
        visit(means[grains_of(experiment.runs[i])], 1 / (runs[i].plateau_error * runs[i].plateau_error),
              experiment.runs[i].box_length, runs[i].plateau);
  };
  each([](Sums& mean, double weight, double length, double plateau) {
    mean.weight += weight, mean.length += weight * length, mean.plateau += weight * plateau;
  });
  double squares = 0, products = 0, spread = 0;
  each([&](const Sums& mean, double weight, double length, double plateau) {
    const double apart = length - mean.length / mean.weight;
    spread += apart * apart;
    squares += weight * apart * apart;
    products += weight * apart * (plateau - mean.plateau / mean.weight);
  });
  constexpr double least_apart = 1e-3;  // m, else it is one length
  if (!(spread > least_apart * least_apart)) return {nothing, nothing};
  return {products / squares, 1 / std::sqrt(squares)};
}

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", metres * 1e3);
  return text;
}

void warn_about(const RunAudit& run, const NoiseFound& noise, const char* what,
                std::vector<std::string>& warnings) {
  const std::string who = run.run + ", " + what + ": ";
  if (std::isfinite(noise.declared) && std::abs(noise.standard_deviation / noise.declared - 1) > 0.25)
    warnings.push_back(who + "the frames scatter by " + millimetres(noise.standard_deviation) +
                       " where the experiment file says " + millimetres(noise.declared) +
                       "; the found value is used");
  if (noise.correlation[0] != 0) {
    char text[16];
    std::snprintf(text, sizeof text, "%.2f", noise.correlation[0]);
    warnings.push_back(who + "neighbouring frames err together (correlation " + text +
                       "): smoothed before it was written?");
  }
  if (noise.quantum > 0)
    warnings.push_back(who + "positions come in steps of " + millimetres(noise.quantum) + " (whole pixels?)");
  if (noise.outliers > 0)
    warnings.push_back(who + std::to_string(noise.outliers) +
                       " frames far from their neighbours are taken as missing");
}

/// One camera films all runs: its colour is the same in runs of one frame rate, and so is its noise unless
/// runs differ by more than the error of each. Pooling halves that error, which otherwise widens the test of
/// the momentum balance.
void pool_noise(const Experiment& experiment, std::vector<RunAudit>& runs, NoiseFound RunAudit::*noise,
                std::vector<double> RunAudit::*series) {
  std::vector<OwnFrames> own(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if ((runs[i].*series).empty()) continue;
    OwnFrames frames = own_frames(experiment.runs[i].time, runs[i].*series, runs[i].frame_interval);
    if (std::isfinite(white_deviation(neighboured(frames)))) own[i] = std::move(frames);
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
    std::vector<NeighbouredSeries> pooled;
    for (const std::size_t i : members) pooled.push_back(neighboured(own[i]));
    const auto colour = colour_of(pooled, own[first].interval);
    double mean_square = 0, lowest = 1e300, highest = 0;
    for (std::size_t k = 0; k < members.size(); ++k) {
      NoiseFound& found = runs[members[k]].*noise;
      found.correlation = colour;
      set_deviation(pooled[k], found);
      const double deviation = found.standard_deviation;
      mean_square += deviation * deviation / static_cast<double>(members.size());
      lowest = std::min(lowest, deviation), highest = std::max(highest, deviation);
    }
    if (highest < 1.1 * lowest)
      for (const std::size_t i : members) (runs[i].*noise).standard_deviation = std::sqrt(mean_square);
  }
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
  audit.release = release_of(run, audit.x_box, audit.box.standard_deviation);
  if (!run.has_com()) return audit;
  audit.com = noise_of(run.time, audit.x_com, audit.frame_interval, run.com_uncertainty);
  count_gaps(run.time, audit.x_com, audit.frame_interval, audit.com);
  find_plateau(run, audit, audit.plateau, audit.plateau_error);
  return audit;
}

Audit audit(const Experiment& experiment) {
  Audit result;
  for (const MeasuredRun& run : experiment.runs) result.runs.push_back(audit_run(run));
  pool_noise(experiment, result.runs, &RunAudit::box, &RunAudit::x_box);
  pool_noise(experiment, result.runs, &RunAudit::com, &RunAudit::x_com);
  for (const RunAudit& run : result.runs) {
    warn_about(run, run.box, "box", result.warnings);
    if (!run.x_com.empty()) warn_about(run, run.com, "grains", result.warnings);
  }
  result.plateau = plateau_slope(experiment, result.runs);
  return result;
}

}  // namespace shakedown
