// SPDX-License-Identifier: MIT
// The box between kicks, under the spring and every force on it that is not a grain.
#pragma once
#include "accounts.hpp"
#include "bodies.hpp"

namespace shakedown {

/// Linear spring alone: an exact rotation. Anything more: the classical Runge-Kutta method with the work of
/// each force as further components. A soft step is a 50 000th of the box's period, so its error, (Omega
/// step)^5 / 120 of the state, is below rounding. Dry friction is piecewise smooth: the moment at which the
/// box stops is found, and it stays stopped when the other forces cannot overcome the clamp.
/// Dahl's friction is a closed form of the position from one stop to the next.
class BoxFlow {
 public:
  explicit BoxFlow(const Physics& physics);
  /// Moves the box from `time` by `step`; the impulse and the work of its forces go into the accounts.
  void advance(double time, double step, double& x, double& v, Accounts& accounts);
  /// Returns the energy of the spring with the box at x (m), J.
  double spring_energy(double x) const;

 private:
  struct Phase {
    double x, v;
  };
  struct Work {
    double joule;
    int effect;
  };
  /// Goes on by `step`, s, on the linear spring alone: an exact rotation of x (m) and v (m/s).
  void rotate(double step, double& x, double& v);
  /// Goes on by `step`, s, in pieces short enough for the joints, and books what the forces do.
  void advance_with_effects(double time, double step, Phase& now, Accounts& accounts);
  /// Returns the force of spring, effects and joints on the box at time t, N; dry friction is not in it.
  double force(double t, double x, double v) const;
  void rub(double time, double step, Phase& now, Accounts& accounts);
  Phase integrate(double time, double step, Phase from, double sliding);
  double time_of_stop(double time, double step, Phase from, double sliding);

  double mass_, stiffness_, cubic_;
  BoxForces forces_;
  DahlState dahl_;
  bool plain_;
  std::vector<Work> works_;  // of each force in the last call of integrate()
  double prepared_step_ = -1, cosine_less_one_ = 0, sine_over_rate_ = 0, rate_times_sine_ = 0;
};

}  // namespace shakedown
