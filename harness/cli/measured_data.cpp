// SPDX-License-Identifier: MIT
#include "measured_data.hpp"

#include <fmt/format.h>

#include "effects.hpp"
#include "experiment_file.hpp"
#include "looked_at.hpp"
#include "progress_display.hpp"

namespace shakedown {

namespace {

Experiment read_and_checked(const std::string& file, Setup& setup) {
  const ProgressDisplay display(fmt::format("{}: reading and checking the tables", file));
  return looked_at(read_experiment(file, all_effects()), setup);
}

}  // namespace

Experiment read_measured(const std::string& file, Setup& setup) {
  Experiment experiment = read_and_checked(file, setup);
  for (const std::string& note : experiment.notes) fmt::print(stderr, "note: {}\n", note);
  return experiment;
}

}  // namespace shakedown
