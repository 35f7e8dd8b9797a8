// SPDX-License-Identifier: MIT
// Reads measured data as commands take them: looked at before any model is asked.
#pragma once
#include <string>

#include "experiment.hpp"

namespace shakedown {

/// Reads an experiment file, puts what it knows into the setup, and says on the error output and in the
/// experiment's notes what was assumed and what looks wrong. Throws InputError where no comparison makes
/// sense.
Experiment read_measured(const std::string& file, Setup& setup);

}  // namespace shakedown
