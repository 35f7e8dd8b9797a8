// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ensemble.hpp"
#include "setup.hpp"

namespace shakedown {

constexpr int summary_schema_version = 1;

/// Returns the results as JSON (README.md, "summary.json"): of one run plain numbers, of an ensemble each
/// number as {mean, sd, n}, of the promises of `health` also the largest. null: there is no such number.
/// Everything but wall_seconds and collisions_per_second is the same to the last byte whenever setup, engine,
/// seed and program are.
std::string summary_json(const Ensemble& ensemble, const Setup& setup);

}  // namespace shakedown
