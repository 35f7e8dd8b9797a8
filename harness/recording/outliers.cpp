// SPDX-License-Identifier: MIT
#include "outliers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "local_polynomial.hpp"
#include "motion_seen.hpp"
#include "nothing.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

/// A frame that is farther away in time foretells nothing.
constexpr double too_far = 0.05;  // s

/// Judges frames by their neighbours: two on the left, two on the right, one of each. A landing spoils one or
/// two of these predictions, an outlier all three.
class OutlierJudge {
 public:
  OutlierJudge(const std::vector<double>& time, const std::vector<double>& x, double deviation)
      : time_(&time), deviation_(deviation), acceleration_(typical_acceleration(time, x)) {}

  /// Returns the smallest misfit in units of its own standard deviation; `kept` are the frames to judge by.
  double misfit(const std::vector<double>& kept, std::size_t i, double value) const {
    std::array<std::size_t, 2> left{}, right{};
    const int lefts = neighbours_to(kept, i, -1, left), rights = neighbours_to(kept, i, +1, right);
    double smallest = 1e300;
    int predictions = 0;
    const auto judge = [&](std::size_t a, std::size_t b) {
      const double share = ((*time_)[i] - (*time_)[a]) / ((*time_)[b] - (*time_)[a]);
      const double prediction = kept[a] + share * (kept[b] - kept[a]);
      const double spread = deviation_ * std::sqrt(1 + (1 - share) * (1 - share) + share * share);
      const double bend =
          acceleration_ * std::abs(((*time_)[i] - (*time_)[a]) * ((*time_)[i] - (*time_)[b])) / 2;
      smallest = std::min(smallest, std::max(0.0, std::abs(value - prediction) - bend) / spread);
      ++predictions;
    };
    if (lefts > 0 && rights > 0) judge(left[0], right[0]);
    if (lefts == 2) judge(left[0], left[1]);
    if (rights == 2) judge(right[0], right[1]);
    return predictions > 0 ? smallest : 0;
  }

  double acceleration() const { return acceleration_; }

 private:
  const std::vector<double>* time_;
  double deviation_, acceleration_;

  int neighbours_to(const std::vector<double>& kept, std::size_t i, int step,
                    std::array<std::size_t, 2>& found) const {
    int count = 0;
    for (auto j = static_cast<std::ptrdiff_t>(i) + step;
         j >= 0 && j < static_cast<std::ptrdiff_t>(kept.size()) && count < 2; j += step) {
      const auto at = static_cast<std::size_t>(j);
      if (std::abs((*time_)[at] - (*time_)[i]) > too_far) break;
      if (std::isfinite(kept[at])) found[static_cast<std::size_t>(count++)] = at;
    }
    return count;
  }

  /// Returns three times the usual acceleration while the box moves, m/s^2, from second differences over 20
  /// ms.
  static double typical_acceleration(const std::vector<double>& time, const std::vector<double>& x) {
    const double interval = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
    const std::size_t step = std::max<std::size_t>(1, static_cast<std::size_t>(0.02 / interval));
    const MotionSeen motion = motion_seen(time, x);
    std::vector<double> found;
    for (std::size_t i = step; i + step < x.size(); ++i) {
      if (!(motion.excursion[i] > moving_share * motion.range)) continue;
      const double difference = x[i - step] - 2 * x[i] + x[i + step],
                   duration = (time[i + step] - time[i - step]) / 2;
      if (std::isfinite(difference)) found.push_back(std::abs(difference) / (duration * duration));
    }
    return found.empty() ? 0 : 3 * median(found);
  }
};

/// Draws a robust line through up to six kept frames on one side (step -1 or +1) or three on each (0): the
/// median of all slopes (Theil, Sen), which two wrong frames of six do not move. Returns by how much `value`
/// at frame i misses it less what an acceleration bends, m, divided by how many times more than a frame that
/// scatters; 0 where there are too few frames.
double misfit_to_robust_line(const std::vector<double>& time, const std::vector<double>& kept, std::size_t i,
                             int step, double value, double acceleration) {
  constexpr int wanted = 6;
  std::vector<double> t, y;
  const auto gather = [&](int direction, int count) {
    for (auto j = static_cast<std::ptrdiff_t>(i) + direction;
         j >= 0 && j < static_cast<std::ptrdiff_t>(kept.size()) && count > 0; j += direction) {
      const auto at = static_cast<std::size_t>(j);
      if (std::abs(time[at] - time[i]) > too_far) break;
      if (!std::isfinite(kept[at])) continue;
      t.push_back(time[at] - time[i]);
      y.push_back(kept[at] - value);
      --count;
    }
  };
  if (step <= 0) gather(-1, step == 0 ? wanted / 2 : wanted);
  if (step >= 0) gather(+1, step == 0 ? wanted / 2 : wanted);
  if (t.size() < wanted) return 0;
  std::vector<double> slopes, offsets;
  for (std::size_t a = 0; a < t.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) slopes.push_back((y[a] - y[b]) / (t[a] - t[b]));
  const double slope = median(slopes);
  double middle = 0, square = 0, reach = 0;
  for (std::size_t a = 0; a < t.size(); ++a) {
    offsets.push_back(y[a] - slope * t[a]);
    middle += t[a] / static_cast<double>(t.size());
    reach = std::max(reach, std::abs(t[a]));
  }
  for (const double at : t) square += (at - middle) * (at - middle);
  // medians scatter by a tenth more
  const double variance = 1 + 1.2 * (1 / static_cast<double>(t.size()) + middle * middle / square);
  return std::max(0.0, std::abs(median(offsets)) - acceleration * reach * reach / 2) / std::sqrt(variance);
}

/// Returns the distance from the local cubic through the frames kept within 20 ms (at least 5 frames) on
/// either side, the frame itself left out, in units of its standard deviation; 0 where there are too few.
double misfit_to_cubic(const std::vector<double>& time, const std::vector<double>& kept, std::size_t i,
                       double value, double deviation, double interval) {
  const auto half = static_cast<std::ptrdiff_t>(std::max(5.0, std::round(0.02 / interval)));
  const double reach = static_cast<double>(half) * interval * 1.01;
  LocalPolynomial<4> cubic;
  const auto first = std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(i) - half);
  const auto last =
      std::min(static_cast<std::ptrdiff_t>(kept.size()) - 1, static_cast<std::ptrdiff_t>(i) + half);
  for (auto j = first; j <= last; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const double u = (time[at] - time[i]) / reach;
    if (at == i || !std::isfinite(kept[at]) || std::abs(u) > 1) continue;
    cubic.add(u, kept[at] - value);
  }
  if (cubic.count() < 7) return 0;
  return std::abs(cubic.coefficients()[0]) / (deviation * std::sqrt(1 + cubic.covariance()(0, 0)));
}

/// Returns how many times as far as normal noise frames of this series usually lie off, by the nine tenths
/// that lie nearest; at least 1. Noise of another kind has wide wings everywhere: a wrong frame stands out
/// from them.
double wings_of(std::vector<double> misfits) {
  constexpr double share = 0.9, of_a_normal = 1.645;
  if (misfits.empty()) return 1;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(misfits.size() - 1));
  std::nth_element(misfits.begin(), misfits.begin() + at, misfits.end());
  return std::max(1.0, misfits[static_cast<std::size_t>(at)] / of_a_normal);
}

template <typename Misfit>
double wings(const std::vector<double>& x, Misfit&& misfit) {
  std::vector<double> misfits;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i])) misfits.push_back(misfit(i));
  return wings_of(std::move(misfits));
}

}  // namespace

// What looks wrong beside an outlier is judged again without it, and what an outlier seemed to support too.
std::vector<double> without_outliers(const std::vector<double>& time, const std::vector<double>& x,
                                     double interval, double deviation) {
  constexpr double certain = 5, doubtful = 1.5, off_the_cubic = 4;  // standard deviations
  const OutlierJudge judge(time, x, deviation);
  std::vector<double> kept = x;
  const double usual = wings(x, [&](std::size_t i) { return judge.misfit(x, i, x[i]); });
  double usual_of_cubic = 1;
  for (int pass = 0; pass < 5; ++pass) {
    if (pass == 1)
      usual_of_cubic = wings(
          kept, [&](std::size_t i) { return misfit_to_cubic(time, kept, i, kept[i], deviation, interval); });
    std::vector<double> next = x;
    bool same = true;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!std::isfinite(x[i])) continue;
      const double misfit = judge.misfit(kept, i, x[i]);
      // The cubic is sharper, but a landing bends away from it; there one side's neighbours support the
      // frame.
      if (misfit > certain * usual ||
          (pass > 0 && misfit > doubtful &&
           misfit_to_cubic(time, kept, i, x[i], deviation, interval) > off_the_cubic * usual_of_cubic))
        next[i] = nothing;
      same = same && std::isfinite(next[i]) == std::isfinite(kept[i]);
    }
    kept = std::move(next);
    if (same && pass > 0) break;
  }
  // Two wrong frames side by side may support each other, which no line through six frames does.
  const auto supported = [&](std::size_t i) {
    const auto by = [&](int step) {
      return misfit_to_robust_line(time, kept, i, step, x[i], judge.acceleration()) <=
             certain * usual * deviation;
    };
    return by(0) || by(-1) || by(1);  // both sides together support all but frames at landings
  };
  for (bool same = false; !same;) {
    std::vector<double> next = kept;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::isfinite(kept[i]) && !supported(i)) next[i] = nothing;
    same = std::equal(kept.begin(), kept.end(), next.begin(),
                      [](double one, double other) { return std::isfinite(one) == std::isfinite(other); });
    kept = std::move(next);
  }
  return kept;
}

}  // namespace shakedown
