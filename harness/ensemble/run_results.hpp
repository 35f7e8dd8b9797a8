// SPDX-License-Identifier: MIT
// Keeps a folder of results whole: it holds those of one run or ensemble, or what it held before.
#pragma once
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "ensemble.hpp"
#include "output_file.hpp"
#include "provenance.hpp"
#include "series_file.hpp"
#include "setup.hpp"

namespace shakedown {

/// Writes into a folder: series.csv (of the first run), and of ensembles mean_series.csv, runs.csv (a line a
/// run) and, if asked, series/run_NNNN.csv of every run; at the end summary.json, provenance.json and
/// setup.toml (with initial_grains.csv when the grains came from a file, so that the folder can be run
/// again).
class RunResults {
 public:
  /// Throws FileError when the folder cannot be written to. Until finish() what an earlier run left there
  /// stays, and new files stand in a folder `.unfinished` beside it.
  RunResults(OutputFolder folder, bool every_series);
  /// Without finish() nothing of this run is left.
  ~RunResults();
  RunResults(const RunResults&) = delete;
  RunResults& operator=(const RunResults&) = delete;

  /// Writes collision logs too: collisions.log of the first run and, with the series of every run,
  /// collisions/run_NNNN.log.
  void keep_collisions_of(const Setup& setup) { logged_ = setup; }

  /// Takes the next run; to be handed to EnsembleOptions::each.
  void add(int run, const Trajectory& trajectory, const Observables& observables);

  /// Writes what is left, and puts all in the place of what an earlier run left. Throws FileError.
  void finish(const Ensemble& ensemble, const Setup& setup, const Provenance& provenance);

  const OutputFolder& folder() const { return folder_; }  ///< where the results go

 private:
  /// Writes a file into the folder of what is not finished, to be put in its place later. Throws FileError.
  void write(const std::filesystem::path& name, std::string_view contents);
  /// Writes the log of a run where it is wanted: of the first, or of every one.
  void write_collisions(int run, const CollisionLog& log);
  void write_used_setup(Setup setup);
  void put_in_place() const;
  void remove_earlier_results() const;
  /// Removes the folder of what is not finished.
  void remove_unfinished() const;

  OutputFolder folder_;
  std::vector<std::filesystem::path> written_{};  ///< below the folder, in the order of writing
  std::optional<Setup> logged_;
  bool every_series_;
  int runs_ = 0;
  MeanSeries mean_;
  std::string lines_;
};

}  // namespace shakedown
