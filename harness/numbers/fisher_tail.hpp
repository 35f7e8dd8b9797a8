// SPDX-License-Identifier: MIT
#pragma once

namespace shakedown {

/// Returns the probability that Fisher's F of these degrees of freedom, real and positive, exceeds `value`.
double fisher_tail(double value, double degrees_above, double degrees_below);

}  // namespace shakedown
