// SPDX-License-Identifier: MIT
// g-jitter: vibration of the aircraft or of the table.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_oscillating_acceleration(const EffectChoice& choice, int index, Physics& physics) {
  const Vec3& amplitude = choice.vector("amplitude");
  const double frequency = choice.number("frequency"), phase = choice.number("phase");
  physics.grains.harmonics.push_back({amplitude, frequency, phase, index});
  if (amplitude.x() != 0)
    physics.box.harmonics.push_back({physics.box_mass * amplitude.x(), frequency, phase, index});
}
}  // namespace

extern const EffectRecord oscillating_acceleration{
    .name = "oscillating_acceleration",
    .label = "oscillating acceleration",
    .acts_on = ActsOn::all,
    .sentence = "A harmonic acceleration of grains and box.",
    .formula = "+m a sin(2 pi f t + phi) on every grain and +M a_x sin(2 pi f t + phi) on the box",
    .source = "R. Monti (ed.), Physics of Fluids in Microgravity (Taylor & Francis, 2001), on g-jitter",
    .limits = "One frequency with a constant phase; real jitter is broad.",
    .parameters = {{.name = "amplitude",
                    .kind = ParameterKind::vector,
                    .unit = "m/s^2",
                    .default_value = Vec3(0, 0, 0),
                    .required = true,
                    .low = -100,
                    .high = 100,
                    .neutral = 0,
                    .typical = 0.1,
                    .sentence = "Amplitude [x, y, z]."},
                   {.name = "frequency",
                    .unit = "Hz",
                    .default_value = 1.0,
                    .low = 1e-3,
                    .high = 1e3,
                    .typical = 1,
                    .sentence = "Frequency."},
                   {.name = "phase",
                    .unit = "rad",
                    .default_value = 0.0,
                    .low = -10,
                    .high = 10,
                    .sentence = "Phase at release."}},
    .engines = {{"hard", {Fidelity::exact}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "Runge-Kutta within each time step, error below rounding; the ledger closes to 1e-9"}},
                {"lammps",
                 {Fidelity::to_stated_error,
                  "fix addforce with variables of time, second order in the step"}}},
    .search = {.strengths = {{.parameters = "amplitude.x", .typical = 0.1}},
               .harmonic = SearchedHarmonic{"amplitude.x", "frequency", "phase"}},
    .on_page = {.integrated = true},
    .apply = &apply_oscillating_acceleration,
    .applied_last = true};

}  // namespace shakedown::effect
