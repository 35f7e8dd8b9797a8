// SPDX-License-Identifier: MIT
#include "noise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "nothing.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr double usual_noise = 1e-3;       // m, of a camera of which nothing is known
constexpr double without_a_camera = 1e-9;  // m, in positions that a simulation gave as they are
constexpr int lowest_order = 4, highest_order = 14;
/// A difference may keep so much motion over the noise that it keeps, which adds 2 % to the deviation.
constexpr double leak_allowed = 0.2;
/// A step of rounding matters from this share of the noise on.
constexpr double matters = 0.3;
constexpr std::size_t fewest_differences = 20;  // differences that make a standard deviation
/// Differences of this order and of the next agree within this share where they see noise alone, and no more
/// than this share of them lies beyond 2.5 standard deviations (1.2 % of a normal distribution do).
constexpr double orders_agree = 0.25, most_beyond = 0.1;
/// Differences of noise alone are as large as what they are taken of; where a motion is resolved they are
/// less than this share of it.
constexpr double resolved = 0.5;

/// Returns the standard deviation about zero of what is normal among the values: beyond 2.5 of it they are
/// landings or wrong frames, and the 0.91126 of the variance that a normal distribution has within corrects
/// for the cut.
double clipped_deviation(const std::vector<double>& values) {
  constexpr double cut = 2.5, within = 0.91126;
  std::vector<double> sizes;
  for (const double value : values)
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  if (sizes.size() < fewest_differences) return nothing;
  double deviation = 1.482602218505602 * median(sizes);
  for (int pass = 0; pass < 20 && deviation > 0; ++pass) {
    double squares = 0, count = 0;
    for (const double size : sizes)
      if (size < cut * deviation) squares += size * size, ++count;
    const double next = std::sqrt(squares / count / within);
    if (std::abs(next - deviation) < 1e-6 * deviation) break;
    deviation = next;
  }
  return deviation;
}

/// Tells whether these differences are those of noise: not too many far ones, and the next order alike.
bool are_noise(const std::vector<double>& found, const std::vector<double>& next, double deviation) {
  double beyond = 0, count = 0;
  for (const double value : found)
    if (std::isfinite(value)) beyond += std::abs(value) > 2.5 * deviation, ++count;
  const double of_next = clipped_deviation(next);
  // Few differences know their own deviation badly.
  const double allowed = orders_agree + 3 / std::sqrt(std::max(count, 1.0));
  return beyond < most_beyond * count && !(std::abs(of_next / deviation - 1) > allowed);
}

/// Returns the standard deviation of what is recorded, motion and noise, m.
double whole_deviation(const NoiseSeries& series) {
  std::vector<double> moving;
  for (std::size_t i = 0; i < series.x->size(); ++i)
    if (series.moving[i] && std::isfinite((*series.x)[i])) moving.push_back((*series.x)[i]);
  if (moving.empty()) return 0;
  const Eigen::Map<const Eigen::ArrayXd> x(moving.data(), std::ssize(moving));
  return std::sqrt((x - x.mean()).square().mean());
}

/// Returns weights of length 1 on frames at these places under which polynomials of lower order vanish: those
/// of divided differences.
Eigen::VectorXd difference_weights(const Eigen::VectorXd& place) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(place.size());
  for (Eigen::Index i = 0; i < place.size(); ++i)
    for (Eigen::Index j = 0; j < place.size(); ++j)
      if (j != i) weights[i] /= place[i] - place[j];
  return weights.normalized();
}

/// Returns for each frame the difference of neighbouring frames about it, m, in which white noise keeps its
/// standard deviation.
std::vector<double> differences(const NoiseSeries& series, int order) {
  const std::vector<double>& x = *series.x;
  std::vector<double> found(x.size(), nothing);
  const auto reach = static_cast<std::size_t>(order / 2);
  const Eigen::Index frames = order + 1;
  Eigen::VectorXd place = Eigen::VectorXd::LinSpaced(frames, 0, static_cast<double>(order));
  Eigen::VectorXd weights = difference_weights(place);
  for (std::size_t i = reach; i + reach < x.size(); ++i) {
    const std::size_t first = i - reach;
    bool whole = true;
    for (std::size_t j = first + 1; j <= i + reach && whole; ++j) whole = series.neighbour[j];
    if (!whole || !series.moving[i]) continue;
    if (series.by_clock) {
      for (Eigen::Index k = 0; k < frames; ++k)
        place[k] =
            ((*series.time)[first + static_cast<std::size_t>(k)] - (*series.time)[i]) / series.interval;
      weights = difference_weights(place);
    }
    double sum = 0;
    for (Eigen::Index k = 0; k < frames; ++k) sum += weights[k] * x[first + static_cast<std::size_t>(k)];
    found[i] = sum;
  }
  return found;
}

/// Returns what differences of this order keep of a swing over half the range, with so many frames a period.
double leak(double range, double frames_per_period, int order) {
  const double each = 2 * std::sin(std::numbers::pi / std::max(frames_per_period, 2.0));
  const double log_binomial = std::lgamma(2.0 * order + 1) - 2 * std::lgamma(order + 1.0);
  return range / std::sqrt(8.0) * std::exp(order * std::log(each) - log_binomial / 2);
}

/// Returns the lowest order in which the motion cancels beside the noise; 0: none does.
int order_for(const NoiseSeries& series, const MotionSeen& motion) {
  const double frames = motion.frames_per_period(series.interval);
  if (std::isinf(frames)) return lowest_order;
  // Below six frames a period each difference makes the motion larger: 2 sin(pi / 6) = 1.
  constexpr double fewest_frames = 6;
  if (frames < fewest_frames) return 0;
  for (int order = lowest_order; order <= highest_order; order += 2) {
    const double deviation = clipped_deviation(differences(series, order));
    if (leak(motion.range, frames, order) < leak_allowed * deviation) return order;
  }
  return 0;
}

/// Returns the order whose differences are smallest, and their deviation (m): a bound of the noise where the
/// motion does not cancel.
std::pair<int, double> smallest_differences(const NoiseSeries& series) {
  std::pair<int, double> best{lowest_order, nothing};
  for (int order = lowest_order; order <= highest_order; order += 2) {
    const double deviation = clipped_deviation(differences(series, order));
    if (!(deviation >= best.second)) best = {order, deviation};
  }
  return best;
}

double deviation_of(const NoiseSeries& series) {
  return series.order > 0 ? clipped_deviation(differences(series, series.order))
                          : smallest_differences(series).second;
}

/// Marks frames whose neighbours lie more than two steps of rounding apart: their errors of rounding are new
/// each time. Marks all moving frames where these are too few.
std::vector<char> faster_than_rounding(const NoiseSeries& series, double step) {
  constexpr std::ptrdiff_t enough = 50;
  const std::vector<double>& x = *series.x;
  std::vector<char> fast(x.size(), 0);
  for (std::size_t i = 1; i + 1 < x.size(); ++i)
    fast[i] = series.moving[i] && std::abs(x[i + 1] - x[i - 1]) > 2 * step;
  return std::count(fast.begin(), fast.end(), 1) > enough ? fast : series.moving;
}

/// Lets frames at rest tell the noise too, as more frames tell it better; but not where rounding hides it
/// there, or where it is another while the box moves.
void take_rest_in(NoiseSeries& series) {
  constexpr double differs = 0.05, error_of_one = 1.1;  // the error of n differences is 1.1 / sqrt(n), seen
  NoiseSeries whole = series;
  whole.moving.assign(series.moving.size(), 1);
  const double all = deviation_of(whole), moving = deviation_of(series);
  const auto count = static_cast<double>(std::count(series.moving.begin(), series.moving.end(), 1));
  const double allowed = std::max(differs, 4 * error_of_one / std::sqrt(std::max(count, 1.0)));
  const bool same = std::isfinite(all) && !(std::abs(moving / all - 1) > allowed);
  if (same && !(step_of(*series.x) > matters * all)) series.moving = std::move(whole.moving);
}

/// Tells whether the recorded times lie off an even grid, and positions fit to them rather than to the grid.
bool fits_the_clock(NoiseSeries series) {
  constexpr double uneven = 1e-3, better = 0.97;
  std::vector<double> off;
  for (std::size_t i = 1; i < series.time->size(); ++i)
    if (series.neighbour[i]) off.push_back(((*series.time)[i] - (*series.time)[i - 1]) / series.interval - 1);
  if (!(robust_deviation(off) > uneven)) return false;
  const double on_grid = deviation_of(series);
  series.by_clock = true;
  return deviation_of(series) < better * on_grid;
}

/// Returns what differences keep of first-order noise of correlation r, in parts of its variance.
double kept_variance(int order, double r) {
  const Eigen::VectorXd weights =
      difference_weights(Eigen::VectorXd::LinSpaced(order + 1, 0, static_cast<double>(order)));
  double gain = 1;
  for (Eigen::Index lag = 1; lag <= order && r != 0; ++lag)
    gain += 2 * std::pow(r, static_cast<double>(lag)) *
            weights.head(order + 1 - lag).dot(weights.tail(order + 1 - lag));
  return std::max(gain, 1.0 / 70);
}

std::vector<NoiseAt> over_time(const NoiseSeries& series, const std::vector<double>& found, double gain) {
  constexpr int most_rows = 12;
  const std::vector<double>& time = *series.time;
  std::vector<NoiseAt> rows;
  const double length = (time.back() - time.front()) / most_rows;
  for (int row = 0; row < most_rows; ++row) {
    const double from = time.front() + row * length, to = from + length;
    std::vector<double> within;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (time[i] >= from && time[i] < to && std::isfinite(found[i])) within.push_back(found[i]);
    if (const double deviation = clipped_deviation(within); std::isfinite(deviation))
      rows.push_back({from, to, deviation / gain});
  }
  return rows;
}

}  // namespace

NoiseSeries noise_series(const std::vector<double>& time, const std::vector<double>& x, double interval) {
  NoiseSeries series{&time, &x, interval, std::vector<char>(x.size(), 0), {}, 0, false, lowest_order};
  for (std::size_t i = 1; i < time.size(); ++i) series.neighbour[i] = time[i] - time[i - 1] < 1.5 * interval;
  const MotionSeen motion = motion_seen(time, x);
  for (const double excursion : motion.excursion)
    series.moving.push_back(excursion > moving_share * motion.range);  // at rest rounding hides the noise
  series.frames_per_period = motion.frames_per_period(interval);
  series.order = order_for(series, motion);
  series.by_clock = fits_the_clock(series);
  if (series.by_clock) series.order = order_for(series, motion);
  take_rest_in(series);
  return series;
}

void set_deviation(const NoiseSeries& series, NoiseFound& noise) {
  NoiseSeries used = series;
  noise.order = series.order > 0 ? series.order : smallest_differences(series).first;
  const double gain = std::sqrt(kept_variance(noise.order, noise.correlation[0]));
  const double step = step_of(*series.x);
  std::vector<double> seen = differences(series, noise.order);
  if (const double found = clipped_deviation(seen); step > matters * found / gain || !(found > 0)) {
    used.moving = faster_than_rounding(series, step);
    seen = differences(used, noise.order);
    noise.quantum = step;
  }
  double found = clipped_deviation(seen);
  const bool told = series.order > 0 && found < resolved * whole_deviation(series) &&
                    are_noise(seen, differences(used, noise.order + 2), found);
  found /= gain;
  noise.source = told ? NoiseSource::frames : NoiseSource::bound;
  const bool frames_tell = told && std::isfinite(found);
  // Who states more than the frames scatter by knows of errors that neighbouring frames have in common.
  if (noise.declared > 0 && (!frames_tell || found < noise.declared)) {
    constexpr double clearly = 0.75;
    if (!frames_tell || found < clearly * noise.declared) noise.source = NoiseSource::declared;
    found = noise.declared;
  } else if (!std::isfinite(found)) {
    noise.source = NoiseSource::assumed;
    found = usual_noise;
  }
  // Rounding to steps q adds q^2/12, which differences see while the motion is fast and miss while it is
  // slow.
  noise.standard_deviation = std::max({found, noise.quantum / std::sqrt(12.0), without_a_camera});
  noise.over_time = over_time(used, seen, gain);
}

double white_deviation(const NoiseSeries& series) {
  const double found = deviation_of(series);
  return std::isfinite(found) ? std::max(found, step_of(*series.x) / std::sqrt(12.0)) : found;
}

double step_of(const std::vector<double>& x) {
  constexpr double same = 1.05, multiple_within = 0.12, nearly_all = 0.95;
  std::vector<double> sorted = finite_of(x);
  std::sort(sorted.begin(), sorted.end());
  if (sorted.size() < 10) return 0;
  const double finest = 1e-9 * (sorted.back() - sorted.front());
  std::vector<double> gaps;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > finest) gaps.push_back(sorted[i] - sorted[i - 1]);
  if (gaps.size() < 3) return 0;
  std::sort(gaps.begin(), gaps.end());
  const std::size_t repeats = std::max<std::size_t>(2, gaps.size() / 50);
  for (std::size_t i = 0; i + repeats <= gaps.size(); ++i) {
    if (gaps[i + repeats - 1] > same * gaps[i]) continue;
    double step = gaps[i], whole = 0, length = 0;
    for (const double gap : gaps)
      if (gap < 20 * step) whole += std::round(gap / step), length += gap;
    step = length / whole;
    const auto fits = std::count_if(gaps.begin(), gaps.end(), [&](double gap) {
      return std::abs(gap / step - std::round(gap / step)) < multiple_within;
    });
    return static_cast<double>(fits) > nearly_all * static_cast<double>(gaps.size()) ? step : 0;
  }
  return 0;
}

}  // namespace shakedown
