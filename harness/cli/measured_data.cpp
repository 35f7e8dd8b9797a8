// SPDX-License-Identifier: MIT
#include "measured_data.hpp"

#include <fmt/format.h>

#include "effects.hpp"
#include "experiment_file.hpp"
#include "known_setup.hpp"
#include "measurement.hpp"
#include "prelude.hpp"
#include "progress_display.hpp"
#include "recording_check.hpp"

namespace shakedown {

namespace {

Experiment read_and_checked(const std::string& file, Setup& setup) {
  const ProgressDisplay display(fmt::format("{}: reading and checking the tables", file));
  Experiment experiment = with_known(read_experiment(file, all_effects()), all_effects());
  const std::vector<std::string> of_known = notes_on_known(setup, experiment.known);
  setup = with_known(setup, experiment.known, all_effects());
  std::vector<Setup> setups;
  for (const MeasuredRun& run : experiment.runs) setups.push_back(setup_of_run(setup, run, all_effects()));
  for (const Setup& of_run : setups)
    if (of_run.domain != Domain::damper)
      throw InputError({{{},
                         "domain",
                         "has no spring, and what is compared here is a box that swings on one",
                         "give a setup without [domain]"}});
  experiment = with_releases_seen(std::move(experiment), setups);
  experiment.notes = notes_before_modelling(experiment, setups);
  experiment.notes.insert(experiment.notes.begin(), of_known.begin(), of_known.end());
  return experiment;
}

}  // namespace

Experiment read_measured(const std::string& file, Setup& setup) {
  Experiment experiment = read_and_checked(file, setup);
  for (const std::string& note : experiment.notes) fmt::print(stderr, "note: {}\n", note);
  return experiment;
}

}  // namespace shakedown
