// SPDX-License-Identifier: MIT
#include "drawn_curves.hpp"

#include "effects.hpp"

namespace shakedown {

std::vector<MeasuredAgainstModel> drawn_curves(const Measurement& measurement, const Setup* given,
                                               const Setup& final_setup, const LastFit* fit,
                                               const Engine& engine, const Execution& execution) {
  CurveOptions options;
  options.execution = execution;
  options.known = all_effects();
  if (fit != nullptr) {
    options.final_of_run = setups_of(*fit, final_setup, all_effects());
    options.from_first_frame = fit->swing.has_value();
    if (fit->swing) options.runs = 1;
  }
  return measured_against_model(measurement, given, final_setup, engine, options);
}

}  // namespace shakedown
