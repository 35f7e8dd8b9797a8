// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ensemble.hpp"
#include "setup.hpp"

namespace shakedown {

/// Returns the results for people, about twenty lines.
std::string readable_summary(const Ensemble& ensemble, const Setup& setup);

}  // namespace shakedown
