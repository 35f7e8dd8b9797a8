// SPDX-License-Identifier: MIT
// Results of a sweep in one SQLite file, a row a run. A row is there, whole, once add() has returned: a
// program killed at any moment loses what it was computing and nothing else. Several processes may add to one
// file; nothing depends on their order.
#pragma once
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sweep_axis.hpp"

namespace shakedown {

/// What all results of one file have in common.
struct SweepIdentity {
  std::string engine;
  std::string base_digest;  ///< of the setup before anything was varied
  std::string base_setup;   ///< that setup as TOML
  std::vector<SweepAxis> axes;
};

struct ResultRow {
  std::string point;  ///< digest of the setup of this run
  int run = 0;
  std::vector<double> varied;   ///< values of the axes, each in its own unit
  std::string failure;          ///< why an engine gave no numbers; empty: it did
  double engine_seconds = 0;    ///< not part of the digest
  std::vector<double> numbers;  ///< run_numbers(), NaN where there is none
};

/// Mean and spread over the runs of one point.
struct PointSummary {
  std::vector<double> varied;
  int runs = 0, failures = 0;
  std::vector<double> mean, sd;  ///< run_numbers(); NaN without values (sd: with fewer than two)
};

class ResultFile {
 public:
  enum class Opening {
    fresh,   ///< there must be no results yet
    resume,  ///< goes on, or begins
    merge,   ///< begins
  };
  /// Throws InputError when the file holds results of another sweep, or any where none may be; FileError.
  ResultFile(const std::filesystem::path& file, const SweepIdentity& identity, Opening opening);
  /// Opens a file for reading, whatever sweep it is. Throws InputError when it is no file of this program's.
  explicit ResultFile(const std::filesystem::path& file);
  ~ResultFile();
  ResultFile(ResultFile&&) noexcept;

  /// Adds a row, or several at once: all of them or none. Thread-safe. A row that is there already stays as
  /// it is.
  void add(const ResultRow& row);
  void add(std::span<const ResultRow> rows);
  /// Returns point (ResultRow::point) and run of every row, also of runs that failed.
  std::set<std::pair<std::string, int>> finished() const;
  /// Returns all rows in order of point and run. Throws FileError for a damaged row.
  std::vector<ResultRow> rows() const;
  /// Returns what all results of the file have in common.
  const SweepIdentity& identity() const;
  /// Notes which program adds to the file; returns the programs that did before and are another build.
  std::vector<std::string> begin_session(const std::string& program);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// Returns 16 hexadecimal digits over all numbers of all rows: the same whatever the threads, shards, order
/// and interruptions.
std::string results_digest(const std::vector<ResultRow>& rows);

/// Returns mean and spread of each point, in the order of the axes' values.
std::vector<PointSummary> summaries_of(const std::vector<ResultRow>& rows);

/// Returns a line a point: values of the axes, runs, failures, then mean and sd of each number.
std::string summary_csv(const SweepIdentity& identity, const std::vector<PointSummary>& points);

/// Puts the results of several files into one. Throws InputError when they are not of one sweep, or when two
/// disagree about a run (other builds of the program give other chaos).
ResultFile merge_results(const std::filesystem::path& into, const std::vector<std::filesystem::path>& files);

}  // namespace shakedown
