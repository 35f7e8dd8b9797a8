// SPDX-License-Identifier: MIT
#include "known_to_errors.hpp"

#include "camera_features.hpp"
#include "damper_errors.hpp"
#include "key_unit.hpp"

namespace shakedown {

KnownToErrors known_to_errors(const Setup& setup, const Measurement& measurement, const Wander& wander,
                              const Workshop& workshop) {
  constexpr int first_run = 900'000;  // random numbers of their own, beside those of the fits
  KnownToErrors known{features_with_camera(measurement, workshop.known),
                      camera_knobs(setup, measurement, workshop.known),
                      {}};
  add_wander(wander, known.measured);
  const std::vector<DamperError> errors = damper_errors(measurement);
  add_columns(errors, columns_of(errors, known.measured, simulations_of_a_column, first_run, workshop),
              workshop.known, known.measured);
  known.of_damper = knobs_of(errors, setup);
  return known;
}

std::vector<NuisanceFound> nuisances_of(const Refit& fit, KnownEffects known) {
  std::vector<NuisanceFound> list;
  for (std::size_t k = 0; k < fit.values.size(); ++k) {
    const Knob& knob = fit.knobs[k];
    if (!knob.exact) continue;
    list.push_back({knob.key, si_unit_of_key(knob.key, known), knob.believed_error,
                    fit.values[k].value - knob.believed, fit.values[k].error});
  }
  return list;
}

}  // namespace shakedown
