// SPDX-License-Identifier: MIT
// Looks at measured data as every question takes them, before any model is asked.
#pragma once
#include "experiment.hpp"

namespace shakedown {

/// Puts what the experiment knows into the setup; what was assumed and what looks wrong joins the
/// experiment's notes. Throws InputError where no comparison makes sense.
Experiment looked_at(Experiment read, Setup& setup);

}  // namespace shakedown
