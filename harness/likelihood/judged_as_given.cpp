// SPDX-License-Identifier: MIT
#include "judged_as_given.hpp"

#include "camera_features.hpp"
#include "parameter_knobs.hpp"
#include "refit.hpp"
#include "refit_options.hpp"

namespace shakedown {

Refit judged_as_given(const Setup& setup, const Measurement& measurement,
                      const std::vector<MeasuredFeatures>& measured, const Workshop& workshop, int count) {
  RefitOptions options;
  options.count = count;
  options.rounds = options.most_rounds = 1;
  std::vector<Knob> knobs = as_given(setup, measurement.known, workshop.known);
  for (Knob& knob : camera_knobs(setup, measurement, workshop.known)) knobs.push_back(std::move(knob));
  return refit(measured, knobs, workshop, options);
}

}  // namespace shakedown
