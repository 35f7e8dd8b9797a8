// SPDX-License-Identifier: MIT
#include "run_results.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "collision_log_file.hpp"
#include "errors.hpp"
#include "setup_file.hpp"
#include "summary_file.hpp"

namespace shakedown {

namespace {

constexpr const char* run_columns =
    "run,slope_mm_per_s,frequency_hz,first_small_peak_s,seconds_to_0.5,seconds_to_0.25,seconds_to_0.1,"
    "seconds_to_0.05,"
    "seconds_to_0.01,loss_grain_grain,loss_end_wall,loss_side_wall,collisions_grain_grain,collisions_end_"
    "wall,"
    "collisions_side_wall,ledger_error,momentum_error,deepest_overlap_m\n";

std::string line_of(int run, const Trajectory& trajectory, const Observables& seen) {
  std::vector<double> numbers{static_cast<double>(run), 1e3 * seen.slope, seen.frequency,
                              seen.first_small_peak};
  numbers.insert(numbers.end(), seen.seconds_to_energy_fraction.begin(),
                 seen.seconds_to_energy_fraction.end());
  numbers.insert(numbers.end(), seen.energy_loss.begin(), seen.energy_loss.end());
  for (const std::int64_t count : trajectory.collisions) numbers.push_back(static_cast<double>(count));
  const Health& health = trajectory.health;
  numbers.insert(numbers.end(), {health.ledger_error, health.momentum_error, health.deepest_overlap});
  return csv_line(numbers);
}

/// Files stand in this folder until all of them are written.
constexpr const char* unfinished = ".unfinished";

}  // namespace

RunResults::RunResults(OutputFolder folder, bool every_series)
    : folder_(std::move(folder)), every_series_(every_series), lines_(run_columns) {
  for (const char* name : {"setup.toml", "series.csv", collision_log_name})
    expect_writable(folder_.path() / name);
  remove_unfinished();  // of a program that was killed
}

RunResults::~RunResults() { remove_unfinished(); }

void RunResults::remove_unfinished() const {
  std::error_code ignored;
  std::filesystem::remove_all(folder_.path() / unfinished, ignored);
}

void RunResults::write(const std::filesystem::path& name, std::string_view contents) {
  folder_.write(unfinished / name, contents);
  written_.push_back(name);
}

/// Writes the setup as used; a file of grains is copied into the folder with it.
void RunResults::write_used_setup(Setup setup) {
  const std::string copy = "initial_grains.csv";
  std::error_code apart;  // two files, or one of them is not there
  if (!setup.release.initial_grains.empty() &&
      !std::filesystem::equivalent(setup.release.initial_grains, folder_.path() / copy, apart)) {
    std::ifstream file(setup.release.initial_grains, std::ios::binary);
    std::ostringstream contents;
    contents << file.rdbuf();
    write(copy, contents.str());
  }
  if (!setup.release.initial_grains.empty()) setup.release.initial_grains = copy;
  write("setup.toml", write_setup(setup));
}

/// Moves the new files to their places, the summary last: where it stands, all of its run does.
void RunResults::put_in_place() const {
  for (const std::filesystem::path& name : written_) expect_writable(folder_.path() / name);
  remove_earlier_results();
  for (const std::filesystem::path& name : written_) {
    const std::filesystem::path file = folder_.path() / name;
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (!error) std::filesystem::rename(folder_.path() / unfinished / name, file, error);
    if (!error) continue;
    remove_earlier_results();  // and what is new: a part of a run is none
    throw FileError(file.string() + ": cannot be written (" + error.message() +
                    "); make room there, or choose another folder");
  }
  remove_unfinished();
}

/// Removes what an earlier run left, which would stand beside the results of this one as if it belonged to
/// them.
void RunResults::remove_earlier_results() const {
  std::vector<std::filesystem::path> names{"setup.toml",   "initial_grains.csv", "series.csv",
                                           "runs.csv",     "mean_series.csv",    collision_log_name,
                                           "summary.json", "provenance.json",    "report.json"};
  for (const auto& [part, ending] : {std::pair{"series", ".csv"}, std::pair{"collisions", ".log"}}) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / part, none)) {
      const std::filesystem::path file = entry.path().filename();
      if (file.string().starts_with("run_") && file.extension() == ending)
        names.push_back(std::filesystem::path(part) / file);
    }
  }
  folder_.remove(names);
}

void RunResults::add(int run, const Trajectory& trajectory, const Observables& observables) {
  if (++runs_ == 1) write("series.csv", series_csv(trajectory));
  if (every_series_)
    write(std::filesystem::path("series") / fmt::format("run_{:04}.csv", run), series_csv(trajectory));
  if (logged_ && trajectory.collision_log) write_collisions(run, *trajectory.collision_log);
  mean_.add(trajectory);
  lines_ += line_of(run, trajectory, observables);
}

void RunResults::write_collisions(int run, const CollisionLog& log) {
  const std::string bytes = collision_log_bytes({version_line(), *logged_, run, log});
  if (runs_ == 1) write(collision_log_name, bytes);
  if (every_series_) write(std::filesystem::path("collisions") / fmt::format("run_{:04}.log", run), bytes);
}

void RunResults::finish(const Ensemble& ensemble, const Setup& setup, const Provenance& provenance) {
  if (ensemble.requested > 1 && runs_ > 0) {
    write("mean_series.csv", mean_.csv());
    write("runs.csv", lines_);
  }
  write_used_setup(setup);
  write("provenance.json", provenance_json(provenance));
  write("summary.json", summary_json(ensemble, setup));
  put_in_place();
}

}  // namespace shakedown
