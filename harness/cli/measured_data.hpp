// SPDX-License-Identifier: MIT
// Measured data as commands take them: looked at before any model is asked.
#pragma once
#include <string>

#include "experiment.hpp"

namespace shakedown {

/// Reads an experiment file and says on the error output what looks wrong with it beside the setup. Throws
/// InputError where no comparison makes sense.
Experiment read_measured(const std::string& file, const Setup& setup);

}  // namespace shakedown
