// SPDX-License-Identifier: MIT
#include "drawn_curves.hpp"

#include "effects.hpp"

namespace shakedown {

std::vector<MeasuredAgainstModel> drawn_curves(const Measurement& measurement, const Setup* given,
                                               const Setup& final_setup, const Engine& engine,
                                               const Execution& execution) {
  CurveOptions options;
  options.execution = execution;
  options.known = all_effects();
  return measured_against_model(measurement, given, final_setup, engine, options);
}

}  // namespace shakedown
