// SPDX-License-Identifier: MIT
// Small experiments with something hidden in them, and what their user believes.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "hidden_case.hpp"
#include "measurement.hpp"

namespace shakedown {

struct Hidden {
  std::vector<std::string> effects;
  std::vector<Override> parameters{};
  RecordingSettings recording{};
  std::vector<double> lengths{0.065, 0.104};  // m
  std::uint64_t seed = 5;
  std::string duration = "5 s";  // long enough for the decay of these lengths
};

/// The paper's damper.
Setup believed(const std::string& duration = "5 s");

/// As a diagnosis sees it.
Measurement as_measured(const Experiment& experiment, const Setup& setup = believed());

/// By the engine of this name.
Experiment measured(const Hidden& hidden, const std::string& laboratory = "soft");

}  // namespace shakedown
