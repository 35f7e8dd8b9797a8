// SPDX-License-Identifier: MIT
#include "replay_tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "packed_numbers.hpp"
#include "packed_replay.hpp"
#include "replay.hpp"

namespace shakedown {

namespace {

using Track = ReportReplay::Track;
constexpr std::uint8_t no_contact = 3;
constexpr double bent_flight_step = 1e-2;  // s
constexpr double box_step = 2e-3;          // s; the box bends by 3 um in it

/// Rounds to the page's units, 2 us and 2 um, so that files hold few digits.
double rounded(double value) { return std::round(value * 5e5) / 5e5; }

void add(Track& track, double time, const Vec3& at, std::uint8_t contact) {
  track.time.push_back(time);
  track.x.push_back(at.x());
  track.y.push_back(at.y());
  track.z.push_back(at.z());
  track.contact.push_back(contact);
}

/// Every point of the run.
struct Whole {
  std::vector<Track> grains;
  Track box;
  double end = 0;
};

/// Adds a point of every grain and the box. Colour goes with the last collision, so points in flight repeat
/// it.
void add_all(Whole& whole, const State& state, double time) {
  for (std::size_t i = 0; i < state.size(); ++i)
    add(whole.grains[i], time, state.position[i],
        whole.grains[i].contact.empty() ? no_contact : whole.grains[i].contact.back());
  add(whole.box, time, Vec3(state.x_box, 0, 0), no_contact);
}

Whole whole_run(const StoredRun& run, double until) {
  Replay replay(run.setup, run.log);
  Whole whole;
  whole.grains.resize(run.log.initial.size());
  whole.end = std::min(until, run.log.end_time);
  add_all(whole, replay.state(), 0);
  double next_sample = box_step;
  for (std::int64_t sample = 1; next_sample <= whole.end || replay.next_time() <= whole.end;) {
    if (next_sample < replay.next_time()) {
      replay.advance_to(next_sample);
      const State state = replay.state();
      if (sample % static_cast<std::int64_t>(bent_flight_step / box_step) == 0)
        add_all(whole, state, next_sample);
      else
        add(whole.box, next_sample, Vec3(state.x_box, 0, 0), no_contact);
      next_sample = static_cast<double>(++sample) * box_step;
      continue;
    }
    const auto event = replay.step();
    if (!event || (event->kind != EventKind::pair && event->kind != EventKind::wall)) continue;
    const State state = replay.state();
    const auto i = static_cast<std::size_t>(event->grain), j = static_cast<std::size_t>(event->partner);
    const std::uint8_t contact = event->kind == EventKind::pair ? 0 : event->partner == 0 ? 1 : 2;
    add(whole.grains[i], event->time, state.position[i], contact);
    if (event->kind == EventKind::pair)
      add(whole.grains[j], event->time, state.position[j], contact);
    else if (event->partner == 0)
      add(whole.box, event->time, Vec3(state.x_box, 0, 0), no_contact);
  }
  return whole;
}

/// Leaves points out while one straight flight stays within the tolerance of all of them: the interval of
/// slopes that do so narrows with each point (along each axis) until the next point is outside of it.
Track thinned(const Track& track, double tolerance, double exact_from, double exact_to) {
  struct Slopes {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  };
  const std::array<const std::vector<double>*, 3> axes{&track.x, &track.y, &track.z};
  Track kept;
  const auto keep = [&](std::size_t i) {
    add(kept, rounded(track.time[i]), {rounded(track.x[i]), rounded(track.y[i]), rounded(track.z[i])},
        track.contact[i]);
  };
  std::array<Slopes, 3> slopes;
  std::size_t last = 0;
  keep(0);
  for (std::size_t i = 1; i < track.time.size(); ++i) {
    const double dt = track.time[i] - track.time[last];
    bool fits = dt > 0;
    for (std::size_t a = 0; a < 3 && fits; ++a) {
      const double step = (*axes[a])[i] - (*axes[a])[last];
      fits = step >= slopes[a].low * dt && step <= slopes[a].high * dt;
    }
    const bool exact = track.time[i] >= exact_from && track.time[i - 1] <= exact_to;
    if ((!fits || exact) && i - 1 > last) {
      keep(i - 1);
      last = i - 1;
      slopes = {};
      --i;  // once more, from the new point
      continue;
    }
    if (dt <= 0) continue;
    for (std::size_t a = 0; a < 3; ++a) {
      const double step = (*axes[a])[i] - (*axes[a])[last];
      slopes[a].low = std::max(slopes[a].low, (step - tolerance) / dt);
      slopes[a].high = std::min(slopes[a].high, (step + tolerance) / dt);
    }
  }
  if (last + 1 < track.time.size()) keep(track.time.size() - 1);
  return kept;
}

}  // namespace

ReportReplay replay_of(const StoredRun& run, const ReplayPlan& plan) {
  const Whole whole = whole_run(run, plan.until);
  ReportReplay replay;
  replay.group = plan.group;
  replay.title = plan.title;
  replay.length = run.setup.box.length;
  replay.width = run.setup.box.width[0];
  replay.height = run.setup.box.width[1];
  replay.duration = whole.end;
  replay.radius = run.log.initial.radius;
  replay.exact_from = std::clamp(plan.exact_from, 0.0, whole.end);
  replay.exact_to = std::clamp(plan.exact_to, replay.exact_from, whole.end);
  for (replay.tolerance = plan.tolerance; replay.tolerance < 1e-2; replay.tolerance *= 1.6) {
    replay.grains.clear();
    for (const Track& track : whole.grains)
      replay.grains.push_back(thinned(track, replay.tolerance, replay.exact_from, replay.exact_to));
    replay.box = thinned(whole.box, std::min(replay.tolerance, 5e-5), replay.exact_from, replay.exact_to);
    if (gzip(packed(replay).bytes).size() <= plan.largest) break;
  }
  replay.caption = fmt::format(
      "Blue box: simulated (run {}). Drag or use the arrow keys to turn the view. Between {:.2f} and {:.2f} "
      "s every impact is kept; elsewhere "
      "no grain is drawn further than {:.2g} mm from where it was.",
      run.run, replay.exact_from, replay.exact_to, replay.tolerance * 1e3);
  return replay;
}

}  // namespace shakedown
