// SPDX-License-Identifier: MIT
#include "measurements.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "experiment.hpp"
#include "film.hpp"
#include "in_order.hpp"
#include "measured_file.hpp"
#include "measurement.hpp"
#include "nothing.hpp"
#include "quantity.hpp"
#include "random.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

double rounded(double value, double step) { return std::round(value / step) * step; }

/// Makes noise, jumps and losses, one frame at a time. Every frame draws the same number of random numbers,
/// so that a setting changes only what it is about.
class Tracker {
 public:
  Tracker(const RecordingSettings& settings, std::uint64_t seed, std::uint64_t run)
      : settings_(settings), random_(seed, run, Stream::camera) {}

  void next_frame() { lost_ = random_.uniform() < settings_.missing; }
  double position(double truth, double noise) {
    const double error = noise * random_.normal();
    const bool jumps = random_.uniform() < settings_.outliers;
    const double jump = settings_.jump * (2 * random_.uniform() - 1);
    return lost_ ? nothing : rounded(truth + error + (jumps ? jump : 0), settings_.rounding);
  }

 private:
  RecordingSettings settings_;
  Random random_;
  bool lost_ = false;
};

/// Makes a slow error of tracking that forgets itself, frame by frame.
class WanderOfTrack {
 public:
  WanderOfTrack(const RecordingSettings& settings, std::uint64_t seed, std::uint64_t run)
      : size_(settings.wander),
        kept_(std::exp(-1 / (settings.frame_rate * settings.wander_time))),
        random_(seed, run, Stream::wander),
        box_(size_ * random_.normal()),
        centre_(size_ * random_.normal()) {}

  void next_frame() {
    const double fresh = size_ * std::sqrt(1 - kept_ * kept_);
    box_ = kept_ * box_ + fresh * random_.normal();
    centre_ = kept_ * centre_ + fresh * random_.normal();
  }
  double box() const { return box_; }
  double centre() const { return centre_; }

 private:
  double size_, kept_;
  Random random_;
  double box_, centre_;
};

/// Records what is seen. Frames before the release, which a clock that is behind would give a negative time,
/// are left out.
void record(const Recording& seen, const RecordingSettings& settings, bool has_grains, Tracker tracker,
            WanderOfTrack wander, MeasuredRun& run) {
  for (std::size_t i = 0; i < seen.time.size(); ++i) {
    tracker.next_frame();
    const double box = tracker.position(seen.x_box[i] + wander.box(), settings.box_noise);
    const double centre = tracker.position(seen.x_com[i] + wander.centre(), settings.centre_noise);
    wander.next_frame();
    const double time = rounded(seen.time[i], 1e-6);
    if (time < 0) continue;
    run.time.push_back(time);
    run.x_box.push_back(box);
    if (settings.centre && has_grains) run.x_com.push_back(centre);
  }
  if (settings.edge > 0) run.frame_rate = typical_rate(run.time);
}

MeasuredRun planned(const PlannedRun& plan, const RecordingSettings& recording) {
  MeasuredRun run;
  run.name = plan.name;
  run.file = plan.name + ".csv";
  run.overrides = plan.overrides;
  run.frame_rate = recording.frame_rate;
  if (recording.declared && recording.box_noise > 0) run.box_uncertainty = recording.box_noise;
  if (recording.declared && recording.centre_noise > 0 && recording.centre)
    run.com_uncertainty = recording.centre_noise;
  return run;
}

/// Holds what changes from run to run: how much farther the box was drawn (m), how late the clock was (s).
struct ByRun {
  double release, trigger;
};
ByRun of_run(const RecordingSettings& settings, std::uint64_t seed, std::uint64_t run) {
  Random random(seed, run, Stream::by_run);
  const double release = settings.release * random.normal();
  return {release, settings.trigger * random.normal()};
}

Camera camera_of(const Setup& truth, const RecordingSettings& settings) {
  Camera camera = physics_of(truth).camera;
  camera.lens += settings.lens;
  camera.shutter += settings.shutter;
  camera.depth += settings.near;
  camera.origin += settings.origin;
  return camera;
}

/// Returns the frames of one run, to the end of its motion.
Frames frames_of(const RecordingSettings& settings, std::uint64_t seed, std::uint64_t run,
                 const Trajectory& motion) {
  const double start = settings.start + of_run(settings, seed, run).trigger;
  if (settings.edge > 0) return edge_frames(settings.edge, start, motion);
  Frames frames = even_frames(settings.frame_rate, start, motion.time.back());
  Random random(seed, run, Stream::jitter);
  for (std::size_t k = 0; k < frames.instant.size(); ++k) {
    const double late = settings.jitter * random.normal();
    // A frame never comes before the one before it.
    const double earliest = k == 0 ? frames.instant[0] : frames.instant[k - 1] + 1e-5;
    const double instant = std::max(frames.instant[k] + late, earliest);
    if (settings.stamped) frames.stamp[k] += instant - frames.instant[k];
    frames.instant[k] = instant;
  }
  return frames;
}

/// Returns the sample rate, Hz. Instants between the frames are needed where the shutter or an uneven or late
/// clock asks for them.
double sample_rate_for(const Camera& camera, const RecordingSettings& settings) {
  constexpr double enough = 1000;  // Hz; a grain's kick bends the cubics by 1 um
  if (camera.shutter == 0 && settings.trigger == 0 && settings.start == 0 && settings.jitter == 0 &&
      settings.edge == 0)
    return settings.frame_rate;
  return settings.frame_rate * std::max(1.0, std::ceil(enough / settings.frame_rate));
}

Setup setup_filmed(const Setup& truth, const MeasuredRun& run, std::uint64_t number,
                   const RecordingSettings& recording, const Laboratory& laboratory) {
  Setup setup = setup_of_run(truth, run, laboratory.known);
  setup.run.seed = laboratory.seed;
  setup.run.sample_rate = sample_rate_for(camera_of(setup, recording), recording);
  setup.release.displacement += of_run(recording, laboratory.seed, number).release;
  return setup;
}

}  // namespace

std::vector<KnownValue> usually_known(const Setup& believed, const RecordingSettings& recording) {
  std::vector<KnownValue> known{{"box.mass", believed.box.mass, 0.005 * believed.box.mass, {}}};
  if (believed.grains.count > 0)
    known.push_back({"grains.mass", believed.grains.mass, 0.0025 * believed.grains.mass, {}});
  known.push_back(
      {"release.displacement", believed.release.displacement, std::max(0.5e-3, recording.release), {}});
  known.push_back({"camera.scale", 0, 0.005, {}});
  known.push_back({"camera.trigger", 0, std::max(2e-3, recording.trigger), {}});
  return known;
}

std::vector<PlannedRun> runs_of_lengths(const std::vector<double>& lengths) {
  std::vector<PlannedRun> runs;
  std::map<std::string, int> seen;
  const auto base_of = [](double length) {
    std::string millimetres = write_number(rounded(length * 1e3, 1e-6));
    if (const std::size_t whole = std::min(millimetres.find('.'), millimetres.size()); whole < 3)
      millimetres.insert(0, 3 - whole, '0');
    return "L" + millimetres;
  };
  for (const double length : lengths) {
    const auto times = std::count_if(lengths.begin(), lengths.end(),
                                     [&](double other) { return base_of(other) == base_of(length); });
    std::string name = base_of(length);
    const int number = seen[name]++;
    if (times > 26)
      name += "_" + std::to_string(number + 1);
    else if (times > 1)
      name += std::string("_") + static_cast<char>('a' + number);
    runs.push_back({name, {{"box.length", toml_string(write_quantity(length, "mm")), "run " + name}}});
  }
  return runs;
}

Experiment make_measurements(const Setup& truth, const std::vector<PlannedRun>& runs,
                             const RecordingSettings& recording, const Laboratory& laboratory) {
  Experiment experiment;
  std::vector<Setup> setups;
  for (const PlannedRun& plan : runs) {
    MeasuredRun run = planned(plan, recording);
    setups.push_back(setup_filmed(truth, run, setups.size(), recording, laboratory));
    refuse_what_is_not_modelled(*laboratory.engine, setups.back());
    run.box_length = setups.back().box.length;
    experiment.runs.push_back(std::move(run));
  }
  const int count = static_cast<int>(runs.size());
  work_in_parallel_deliver_in_order(
      count, threads_or_all(laboratory.execution.threads), [&](int r) -> std::function<void()> {
        const auto i = static_cast<std::size_t>(r);
        RunOptions options;
        options.run = r;
        options.stop = laboratory.execution.stop;
        const Trajectory trajectory = laboratory.engine->run(setups[i], options);
        if (trajectory.interrupted) throw Interrupted("no run had finished, nothing was kept");
        const Frames frames = frames_of(recording, laboratory.seed, i, trajectory);
        record(filmed(camera_of(setups[i], recording), frames, trajectory), recording,
               setups[i].grains.count > 0, Tracker(recording, laboratory.seed, i),
               WanderOfTrack(recording, laboratory.seed, i), experiment.runs[i]);
        return [&laboratory, r, count] {
          if (laboratory.progress) laboratory.progress(static_cast<double>(r + 1) / count);
        };
      });
  return experiment;
}

void write_measurements(const std::filesystem::path& folder, const Experiment& experiment) {
  for (const MeasuredRun& run : experiment.runs) write_measured_run(folder / (run.name + ".csv"), run);
  write_experiment(folder / "experiment.toml", experiment);
}

}  // namespace shakedown
