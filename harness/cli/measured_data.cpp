// SPDX-License-Identifier: MIT
#include "measured_data.hpp"

#include <fmt/format.h>

#include "experiment_file.hpp"
#include "looked_at.hpp"

namespace shakedown {

Experiment read_measured(const std::string& file, Setup& setup) {
  Experiment experiment = looked_at(read_experiment(file), setup);
  for (const std::string& note : experiment.notes) fmt::print(stderr, "note: {}\n", note);
  return experiment;
}

}  // namespace shakedown
