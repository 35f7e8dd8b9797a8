// SPDX-License-Identifier: MIT
#include "momentum_terms.hpp"

#include <algorithm>
#include <cmath>

namespace shakedown {

namespace {

Eigen::ArrayXd constant(const MomentumRun& run, double value) {
  return Eigen::ArrayXd::Constant(run.time.size(), value);
}

/// The spring's stiffness larger by the fraction `strength`.
ForceSamples spring_samples(const MomentumRun& run, double) {
  ForceSamples s;
  s.force = -run.stiffness * run.x_box;
  s.force_dx = constant(run, -run.stiffness);
  return s;
}

ForceSamples acceleration_samples(const MomentumRun& run, double) {
  ForceSamples s;
  s.force = constant(run, run.box_mass + run.grain_mass);
  return s;
}

ForceSamples viscous_samples(const MomentumRun& run, double) {
  ForceSamples s;
  s.potential = run.x_box;
  s.potential_dx = constant(run, 1);
  return s;
}

ForceSamples quadratic_samples(const MomentumRun& run, double) {
  ForceSamples s;
  s.force = -run.v_smooth * run.v_smooth.abs();
  s.force_dv = -2 * run.v_smooth.abs();
  return s;
}

/// The noise of the moment of change enters through force_dv.
ForceSamples dry_samples(const MomentumRun& run, double) {
  const KnownSign known = known_sign(run);
  ForceSamples s;
  s.force = -known.sign;
  s.force_dv = -known.slope;
  return s;
}

ForceSamples cubic_samples(const MomentumRun& run, double) {
  const double scale = run.stiffness / (run.displacement * run.displacement);
  ForceSamples s;
  s.force = -scale * run.x_box.cube();
  s.force_dx = -3 * scale * run.x_box.square();
  return s;
}

ForceSamples blade_mass_samples(const MomentumRun& run, double) {
  ForceSamples s;
  s.inertia_box = constant(run, 1);
  return s;
}

/// x_com = x_box + (1 + strength)(recorded difference): the balance lacks strength N m (x_com - x_box)''.
ForceSamples com_bias_samples(const MomentumRun& run, double) {
  ForceSamples s;
  s.inertia_com = constant(run, run.grain_mass);
  s.inertia_box = constant(run, -run.grain_mass);
  return s;
}

/// The balance lacks N m (1/cos(1.5 x/l) - 1) (x_com - x_box)''; strength 1/l^2.
ForceSamples camera_arc_samples(const MomentumRun& run, double strength) {
  const Eigen::ArrayXd angle2 = (1.5 * run.x_box).square() * std::max(strength, 1e-6);
  ForceSamples s;
  s.inertia_com = run.grain_mass * (1 / angle2.min(1.0).sqrt().cos() - 1) / std::max(strength, 1e-6);
  s.inertia_box = -s.inertia_com;
  return s;
}

/// Recorded x_box = x + d t: the spring seems to lack the force k d t.
ForceSamples drift_samples(const MomentumRun& run, double) {
  ForceSamples s;
  s.force = run.stiffness * run.time;
  return s;
}

}  // namespace

const std::vector<MomentumTerm>& momentum_terms() {
  static const std::vector<MomentumTerm> terms{
      {"spring.frequency", "spring.frequency", "", TermKind::refit, false, spring_samples},
      {"constant_acceleration", "acceleration", "m/s^2", TermKind::physics, false, acceleration_samples},
      {"blade_viscous_damping", "damping", "N s/m", TermKind::physics, true, viscous_samples},
      {"blade_quadratic_drag", "drag", "N s^2/m^2", TermKind::physics, true, quadratic_samples},
      {"clamp_dry_friction", "force", "N", TermKind::physics, true, dry_samples},
      {"spring_cubic", "coefficient", "", TermKind::physics, false, cubic_samples},
      {"blade_mass", "mass", "kg", TermKind::physics, true, blade_mass_samples},
      {"camera_com_bias", "bias", "", TermKind::camera, false, com_bias_samples, true,
       [](double strength) { return strength / (1 + strength); }},
      {"camera_arc", "blade_length", "m", TermKind::camera, true, camera_arc_samples, false,
       [](double strength) { return strength > 0 ? 1 / std::sqrt(strength) : 0.0; }},
      {"camera_drift", "drift", "m/s", TermKind::camera, false, drift_samples},
  };
  return terms;
}

}  // namespace shakedown
