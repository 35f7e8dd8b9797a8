// SPDX-License-Identifier: MIT
// A journal keeps what simulations gave while long work goes on: the work can be stopped at any moment and
// begun again, and what is in the journal is not simulated a second time. The answer is the same either way.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace shakedown {

class SimulationJournal {
 public:
  using Features = std::vector<Eigen::VectorXd>;  ///< of one simulation, for each run that shares it

  /// Begins the file (one that is there is kept beside it, its name ending in .old), or, with `resume`, goes
  /// on in it when it is there: up to the first record that was not written whole. `work` names program and
  /// measurements, for journals serve no other. Throws FileError; InputError when there is a journal of other
  /// work to go on in.
  SimulationJournal(std::filesystem::path file, const std::string& work, bool resume);

  /// Returns what a simulation gave, nothing where it is not in the journal; keep() adds one. Both may be
  /// called from many threads.
  std::optional<Features> find(const std::string& simulation) const;
  void keep(const std::string& simulation, const Features& features);

  /// Returns the number of simulations that it holds.
  std::int64_t kept() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  /// Reads what the file holds, and cuts off a record that was not finished. Throws FileError, and InputError
  /// where the file has another title.
  void read(const std::string& title);

  std::filesystem::path file_;
  std::ofstream stream_;
  mutable std::mutex mutex_;
  std::map<std::uint64_t, Features> kept_;  ///< by FNV-1a of the name
};

}  // namespace shakedown
