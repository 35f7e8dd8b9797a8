// SPDX-License-Identifier: MIT
#include "judged_as_given.hpp"

#include "known_to_errors.hpp"
#include "parameter_knobs.hpp"
#include "refit.hpp"
#include "refit_options.hpp"

namespace shakedown {

JudgedAsGiven judged_as_given(const Setup& setup, const Measurement& measurement, const Wander& wander,
                              const Workshop& workshop, int count) {
  RefitOptions options;
  options.count = count;
  options.rounds = options.most_rounds = 1;
  KnownToErrors known = known_to_errors(setup, measurement, wander, workshop);
  std::vector<Knob> knobs = as_given(setup, measurement.known, workshop.known);
  for (std::vector<Knob>* list : {&known.of_camera, &known.of_damper})
    for (Knob& knob : *list) knobs.push_back(std::move(knob));
  Refit fit = refit(known.measured, knobs, workshop, options);
  return {std::move(known.measured), std::move(fit)};
}

}  // namespace shakedown
