// SPDX-License-Identifier: MIT
#include "prelude.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "audit.hpp"
#include "base_column.hpp"
#include "quantity.hpp"
#include "robust_statistics.hpp"
#include "rough_motion.hpp"

namespace shakedown {

namespace {

/// The frames that are not missing.
struct Frames {
  std::vector<double> time, x;
  std::size_t size() const { return time.size(); }
};

Frames present(const std::vector<double>& time, const std::vector<double>& x) {
  Frames frames;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i])) frames.time.push_back(time[i]), frames.x.push_back(x[i]);
  return frames;
}

/// Returns the speed at each frame, m/s, over a twentieth of a period to either side.
std::vector<double> speeds(const Frames& f, double period) {
  std::vector<double> speed(f.size(), 0);
  std::size_t left = 0, right = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    while (f.time[left] < f.time[i] - period / 20) ++left;
    while (right + 1 < f.size() && f.time[right + 1] <= f.time[i] + period / 20) ++right;
    const std::size_t a = left < i ? left : i - (i > 0),
                      b = right > i ? right : std::min(i + 1, f.size() - 1);
    if (f.time[b] > f.time[a]) speed[i] = (f.x[b] - f.x[a]) / (f.time[b] - f.time[a]);
  }
  return speed;
}

/// Returns the first frame at which the box rushes from one side of the centre to the other, as only a free
/// swing does: a hand pulls it from the middle, and more slowly. f.size() where there is none.
std::size_t first_rush(const Frames& f, double period, double centre, double amplitude) {
  constexpr double fast = 0.6, far = 0.4;  // of the fastest, of the amplitude
  const std::vector<double> speed = speeds(f, period);
  double fastest = 0;
  for (const double v : speed) fastest = std::max(fastest, std::abs(v));
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (std::abs(speed[i]) < fast * fastest) continue;
    const double sign = speed[i] > 0 ? 1 : -1;
    bool before = false, after = false;
    for (std::size_t j = i + 1; j-- > 0 && f.time[j] >= f.time[i] - period / 2;)
      before = before || sign * (f.x[j] - centre) < -far * amplitude;
    for (std::size_t j = i; j < f.size() && f.time[j] <= f.time[i] + period / 2; ++j)
      after = after || sign * (f.x[j] - centre) > far * amplitude;
    if (before && after) return i;
  }
  return f.size();
}

constexpr double near_the_end = 0.03;  // of the amplitude

/// First and last frame near the farthest place before the rush.
struct Stay {
  std::size_t first = 0, last = 0;
};

Stay stay_before(const Frames& f, std::size_t rush, double period, double centre, double amplitude,
                 double deviation) {
  double farthest = 0, sign = 1;
  std::size_t at = rush;
  for (std::size_t j = rush + 1; j-- > 0 && f.time[j] >= f.time[rush] - period / 2;)
    if (std::abs(f.x[j] - centre) > farthest)
      farthest = std::abs(f.x[j] - centre), at = j, sign = f.x[j] > centre ? 1 : -1;
  const double near = std::max(near_the_end * amplitude, 5 * deviation);
  const auto is_near = [&](std::size_t j) { return farthest - sign * (f.x[j] - centre) < near; };
  Stay stay{at, at};
  while (stay.first > 0 && is_near(stay.first - 1)) --stay.first;
  while (stay.last + 1 < rush && is_near(stay.last + 1)) ++stay.last;
  return stay;
}

/// Returns the first frame of the stay from which on it stands at its level: the hand has brought the box
/// there.
std::size_t settled_from(const Frames& f, const Stay& stay, double amplitude, double deviation) {
  constexpr double still = 2e-3;  // of the amplitude
  constexpr int in_a_row = 5;
  std::vector<double> values(f.x.begin() + static_cast<std::ptrdiff_t>(stay.first),
                             f.x.begin() + static_cast<std::ptrdiff_t>(stay.last) + 1);
  const double level = median(values), near = std::max(still * amplitude, 3 * deviation);
  int row = 0;
  for (std::size_t i = stay.first; i <= stay.last; ++i) {
    row = std::abs(f.x[i] - level) < near ? row + 1 : 0;
    if (row == in_a_row) return i + 1 - in_a_row;
  }
  return stay.first;
}

std::string rounded_seconds(double seconds) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", seconds);
  return write_quantity(std::strtod(digits, nullptr), "s");
}

/// Tells whether the clock of a table does not begin with 0 while its first frame shows the box at rest where
/// it was let go.
bool begins_with_the_release(const MeasuredRun& run) {
  constexpr double worth_saying = 0.02;  // of a period
  const RoughMotion motion = rough_motion(run.time, run.x_box);
  if (!std::isfinite(motion.frequency) || !std::isfinite(motion.start_delay)) return false;
  const double least = worth_saying / motion.frequency;
  return run.time.front() > least && std::abs(motion.start_delay) < std::max(least, 5 * motion.delay_error) &&
         std::abs(motion.start_delay - run.time.front()) > least;
}

}  // namespace

std::optional<Prelude> prelude_of(const std::vector<double>& time, const std::vector<double>& x,
                                  double deviation) {
  constexpr double held_at_least = 0.15, swings_within = 0.8;  // of a period
  constexpr std::size_t least_frames = 10;
  const Frames f = present(time, x);
  const MotionSeen motion = motion_seen(f.time, f.x);
  if (f.size() < least_frames || motion.turns.size() < 3 || !std::isfinite(motion.period))
    return std::nullopt;
  std::vector<double> middles;
  for (std::size_t i = 0; i + 2 < motion.turns.size(); ++i)
    middles.push_back(
        (motion.turns[i].position + 2 * motion.turns[i + 1].position + motion.turns[i + 2].position) / 4);
  const double centre = median(middles), amplitude = motion.range / 2;
  const std::size_t rush = first_rush(f, motion.period, centre, amplitude);
  if (rush >= f.size()) return std::nullopt;
  const Stay stay = stay_before(f, rush, motion.period, centre, amplitude, deviation);
  const double stood = f.time[stay.last] - f.time[stay.first];
  const bool held = stood > held_at_least * motion.period;
  const bool late = f.time[rush] - f.time.front() > swings_within * motion.period;
  const auto turned_before = std::count_if(motion.turns.begin(), motion.turns.end(),
                                           [&](const Turn& turn) { return turn.time < f.time[stay.first]; });
  if (turned_before > 1 || !(held || late)) return std::nullopt;  // it swings all the time
  const auto begin = static_cast<std::ptrdiff_t>(settled_from(f, stay, amplitude, deviation));
  const std::vector<double> t(f.time.begin() + begin, f.time.end()), of(f.x.begin() + begin, f.x.end());
  const double interval = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  const ReleaseFound found = release_found(t, of, motion_seen(t, of), interval, deviation);
  if (found.lead_in > 0) return Prelude{found.start, found.start - t.front()};
  if (!held) return Prelude{(f.time[stay.first] + f.time[stay.last]) / 2, 0};
  // Of a hand that trembles: by the time that a swing from rest takes to leave.
  return Prelude{f.time[stay.last] - std::sqrt(2 * near_the_end) * motion.period / (2 * std::numbers::pi),
                 stood};
}

MeasuredRun counted_from(MeasuredRun run, double release) {
  constexpr double rounding = 1e-9;  // s, of the release's own frame
  for (double& when : run.time) when -= release;
  const auto count = std::lower_bound(run.time.begin(), run.time.end(), -rounding) - run.time.begin();
  const auto split = [&](std::vector<double>& series, std::vector<double>& before) {
    if (series.empty()) return;
    before.assign(series.begin(), series.begin() + count);
    series.erase(series.begin(), series.begin() + count);
  };
  split(run.x_box, run.lead_in.x_box);
  split(run.x_com, run.lead_in.x_com);
  split(run.time, run.lead_in.time);
  return run;
}

Experiment with_releases_seen(Experiment experiment, const std::vector<Setup>& setups) {
  EXPECT(setups.size() == experiment.runs.size());
  for (std::size_t r = 0; r < setups.size(); ++r) {
    MeasuredRun& run = experiment.runs[r];
    // Nobody lets a driven box go.
    if (is_driven(run)) continue;
    if (run.release_stated || run.start == Start::anywhere || run.time.size() < 5) continue;
    const bool grains = setups[r].grains.count > 0;
    if (grains && setups[r].release.displacement == 0) continue;
    const double shown = run.time.front();
    const RunAudit audit = audit_run(run);
    if (const auto prelude = prelude_of(run.time, audit.x_box, audit.box.standard_deviation)) {
      experiment.notes.push_back(run.name + ": the box " +
                                 (prelude->held > 0
                                      ? "is held for " + rounded_seconds(prelude->held) + " and let go at "
                                      : "is moved before it swings freely, from ") +
                                 rounded_seconds(prelude->release) +
                                 " of the table's clock: what comes before is left out (release_time = \"" +
                                 rounded_seconds(prelude->release) + "\" under its [[run]] says the same)");
      run = counted_from(std::move(run), prelude->release);
    } else if (grains && !starts_anywhere(run, setups[r]) && begins_with_the_release(run)) {
      experiment.notes.push_back(run.name + ": the first frame, at " + rounded_seconds(shown) +
                                 " of the table's clock, shows the box at rest: it is taken for the release "
                                 "(release_time = \"" +
                                 rounded_seconds(shown) + "\" under its [[run]] says the same)");
      run = counted_from(std::move(run), shown);
    }
  }
  return experiment;
}

}  // namespace shakedown
