// SPDX-License-Identifier: MIT
#include "observables.hpp"

#include <cmath>

namespace shakedown {

double small_peak(const Setup& setup) { return small_share * std::abs(setup.release.displacement); }

double shortest_half_period(const Setup& setup) { return 0.05 / setup.spring.frequency; }

double seconds_to_energy_fraction(const Trajectory& trajectory, double fraction) {
  const double level = fraction * trajectory.initial_energy;
  for (std::size_t i = 0; i < trajectory.total_energy.size(); ++i) {
    const double energy = trajectory.total_energy[i];
    if (!(energy <= level)) continue;  // an outside program may not tell it
    if (i == 0) return trajectory.time[0];
    const double before = trajectory.total_energy[i - 1];
    return trajectory.time[i - 1] +
           (trajectory.time[i] - trajectory.time[i - 1]) * (before - level) / (before - energy);
  }
  return absent;
}

Observables observe(const Trajectory& trajectory, const Setup& setup) {
  Observables seen;
  const SampledMotion motion{trajectory.time, trajectory.x_box, trajectory.v_box};
  if (setup.domain == Domain::damper) {
    seen.zero_crossings = zero_crossings(motion, shortest_half_period(setup));
    seen.peaks = largest_extrema(motion, seen.zero_crossings);
    seen.frequency = frequency_of(seen.zero_crossings);
    seen.small_peak = small_peak(setup);
    seen.first_small_peak = first_small_peak(seen.peaks, seen.small_peak);
    seen.decay = decay_of(seen.peaks, seen.small_peak);
    seen.slope = seen.decay.linear.slope;
    if (motion.size() > 0) seen.damping = damping_of(trajectory.x_box.front(), seen.peaks);
    seen.steady = steady_state_if_any(setup, trajectory);
  }
  for (std::size_t i = 0; i < energy_fractions.size(); ++i)
    seen.seconds_to_energy_fraction[i] = seconds_to_energy_fraction(trajectory, energy_fractions[i]);
  for (std::size_t i = 0; i < contact_classes; ++i)
    seen.energy_loss[i] = trajectory.ledger.contact_loss[i] / trajectory.initial_energy;
  for (const double loss : trajectory.ledger.effect_loss)
    seen.effect_loss.push_back(loss / trajectory.initial_energy);
  return seen;
}

}  // namespace shakedown
