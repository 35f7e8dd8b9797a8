// SPDX-License-Identifier: MIT
#include "drawn_curves.hpp"

#include "effects.hpp"

namespace shakedown {

std::vector<MeasuredAgainstModel> drawn_curves(const Measurement& measurement, const Setup* given,
                                               const Setup& final_setup, const Engine& engine, int threads,
                                               const std::atomic<bool>* stop) {
  CurveOptions options;
  options.threads = threads;
  options.known = all_effects();
  options.stop = stop;
  return measured_against_model(measurement, given, final_setup, engine, options);
}

}  // namespace shakedown
