// SPDX-License-Identifier: MIT
// Residual gravity: what a parabolic flight leaves.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_constant_acceleration(const EffectChoice& choice, int index, Physics& physics) {
  const Vec3& acceleration = choice.vector("acceleration");
  physics.grains.constant.add(acceleration, index);
  physics.box.constant.add(physics.box_mass * acceleration.x(), index);
}
}  // namespace

extern const EffectRecord constant_acceleration{
    .name = "constant_acceleration",
    .label = "constant acceleration",
    .acts_on = ActsOn::all,
    .sentence = "A constant acceleration of grains and box.",
    .formula = "+m a on every grain and +M a_x on the box; +x points towards the release",
    .source =
        "M. N. Bannerman et al., Movers and shakers: granular damping in microgravity, Phys. Rev. E 84, "
        "011301 (2011), reports a residual acceleration of up to 0.05 g",
    .limits =
        "Constant over the run; across the axis it acts on the grains only because the blade holds the box.",
    .parameters = {{.name = "acceleration",
                    .kind = ParameterKind::vector,
                    .unit = "m/s^2",
                    .default_value = Vec3(0, 0, 0),
                    .required = true,
                    .low = -100,
                    .high = 100,
                    .neutral = 0,
                    .typical = 0.1,
                    .sentence = "Acceleration [x, y, z]."}},
    .engines = {{"hard", {Fidelity::exact}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "Runge-Kutta within each time step, error below rounding; the ledger closes to 1e-9"}},
                {"lammps",
                 {Fidelity::to_stated_error,
                  "fix addforce, exact for what flies freely; Verlet's error for the box"}}},
    // Across the axis both signs do the same to the box: nothing is linear about zero, and layers that lie on
    // a side wall cost three times the events.
    .search = {.strengths = {{.parameters = "acceleration.x", .strongest = 0.5},
                             {.parameters = "acceleration.y", .typical = 0.15, .even = true, .strongest = 2},
                             {.parameters = "acceleration.z", .typical = 0.15, .even = true, .strongest = 2}},
               .cost = Search::Cost::slow},
    .on_page = {.integrated = true},
    .apply = &apply_constant_acceleration,
    .applied_last = true};

}  // namespace shakedown::effect
