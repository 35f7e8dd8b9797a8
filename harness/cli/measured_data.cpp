// SPDX-License-Identifier: MIT
#include "measured_data.hpp"

#include <fmt/format.h>

#include "effects.hpp"
#include "experiment_file.hpp"
#include "measurement.hpp"
#include "recording_check.hpp"

namespace shakedown {

Experiment read_measured(const std::string& file, const Setup& setup) {
  Experiment experiment = read_experiment(file);
  std::vector<Setup> setups;
  for (const MeasuredRun& run : experiment.runs) setups.push_back(setup_of_run(setup, run, all_effects()));
  for (const std::string& note : notes_before_modelling(experiment, setups))
    fmt::print(stderr, "note: {}\n", note);
  return experiment;
}

}  // namespace shakedown
