// SPDX-License-Identifier: MIT
#include "measurements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "camera.hpp"
#include "experiment_file.hpp"
#include "in_order.hpp"
#include "measured_file.hpp"
#include "quantity.hpp"
#include "random.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double rounded(double value, double step) { return std::round(value / step) * step; }

/// Noise, jumps and losses of one frame at a time. Every frame draws the same number of random numbers, so
/// that a setting changes only what it is about.
class Tracker {
 public:
  Tracker(const RecordingSettings& settings, std::uint64_t seed, std::uint64_t run)
      : settings_(settings), random_(seed, run, Stream::camera) {}

  void next_frame() { lost_ = random_.uniform() < settings_.missing; }
  double position(double truth, double noise) {
    const double error = noise * random_.normal();
    const bool jumps = random_.uniform() < settings_.outliers;
    const double jump = settings_.jump * (2 * random_.uniform() - 1);
    return lost_ ? nothing : rounded(truth + error + (jumps ? jump : 0), 1e-6);
  }

 private:
  RecordingSettings settings_;
  Random random_;
  bool lost_ = false;
};

/// Frames before the release, which a clock that is behind would give a negative time, are not recorded.
void record(const Recording& seen, const RecordingSettings& settings, bool has_grains, Tracker tracker,
            MeasuredRun& run) {
  for (std::size_t i = 0; i < seen.time.size(); ++i) {
    tracker.next_frame();
    const double box = tracker.position(seen.x_box[i], settings.box_noise);
    const double centre = tracker.position(seen.x_com[i], settings.centre_noise);
    const double time = rounded(seen.time[i], 1e-4);
    if (time < 0) continue;
    run.time.push_back(time);
    run.x_box.push_back(box);
    if (settings.centre && has_grains) run.x_com.push_back(centre);
  }
}

MeasuredRun planned(const PlannedRun& plan, const RecordingSettings& recording) {
  MeasuredRun run;
  run.name = plan.name;
  run.file = plan.name + ".csv";
  run.overrides = plan.overrides;
  run.frame_rate = recording.frame_rate;
  if (recording.box_noise > 0) run.box_uncertainty = recording.box_noise;
  if (recording.centre_noise > 0 && recording.centre) run.com_uncertainty = recording.centre_noise;
  return run;
}

}  // namespace

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
    setups.push_back(setup_of_run(truth, run, laboratory.known));
    setups.back().run.seed = laboratory.seed;
    setups.back().run.sample_rate = recording.frame_rate;
    refuse_what_is_not_modelled(*laboratory.engine, setups.back());
    run.box_length = setups.back().box.length;
    experiment.runs.push_back(std::move(run));
  }
  const int count = static_cast<int>(runs.size());
  work_in_parallel_deliver_in_order(
      count, threads_or_all(laboratory.threads), [&](int r) -> std::function<void()> {
        const auto i = static_cast<std::size_t>(r);
        RunOptions options;
        options.run = r;
        options.stop = laboratory.stop;
        const Trajectory trajectory = laboratory.engine->run(setups[i], options);
        if (trajectory.interrupted) throw Interrupted("no run had finished, nothing was kept");
        const Recording seen = recorded_by(physics_of(setups[i]).camera, trajectory);
        record(seen, recording, setups[i].grains.count > 0,
               Tracker(recording, laboratory.seed, static_cast<std::uint64_t>(r)), experiment.runs[i]);
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
