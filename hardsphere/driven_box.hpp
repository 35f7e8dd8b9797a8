// SPDX-License-Identifier: MIT
// Flight of the box between kicks when more than its linear spring acts on it:
//   M x'' = -k x (1 + b x^2) - c x' - F sgn x' + constant + sum of harmonics + free forces + Dahl's friction
// Linear terms in closed form; dry friction as a sequence of closed forms from one turning point to the next,
// with sticking; the rest by Gauss-Legendre collocation (8 nodes, a polynomial of degree 9 in time) on pieces
// short enough that the last term of the acceleration's expansion moves the box by less than 1e-14 m and
// changes its speed by less than 1e-11 m/s, corners of a force among them.
#pragma once
#include <limits>
#include <vector>

#include "box_motion.hpp"
#include "collocation.hpp"
#include "physics.hpp"

namespace shakedown {

/// Tells whether anything acts besides linear spring and constant restitution; what acts costs only those
/// setups that have it.
bool is_driven(const Physics& physics);

class DrivenBox {
 public:
  using Point = BoxMotion::Point;

  DrivenBox(const Physics& physics, double x, double v, double time = 0);

  /// Returns position and velocity at time t, last kick <= t <= valid_until().
  Point at(double t) const;
  /// A kick: from time t on the box flies from (x, v). Work and impulse must have been accounted for up to t.
  void restart(double t, double x, double v);
  /// End of the present piece, s: a turning point under dry friction, the end of a polynomial; infinity when
  /// there is none.
  double valid_until() const { return valid_until_; }
  /// Begins the next piece at valid_until().
  void go_on();
  /// Bound of |x''| until valid_until(), m/s^2.
  double top_acceleration() const { return top_acceleration_; }
  /// Bounds of |x| and |x'| until valid_until(), m and m/s.
  Point top_reach() const { return top_reach_; }
  /// Returns the speed that the box would reach on its spring alone, m/s: the scale of the elastic limit at
  /// the walls.
  double top_speed() const { return top_speed_; }
  double angular_frequency() const { return angular_frequency_; }
  /// Tells whether it swings about centre() with angular_frequency() and does nothing else until
  /// valid_until().
  bool is_harmonic() const { return piece_ == Piece::closed && decay_ == 0 && responses_.empty(); }
  double centre() const { return centre_; }  ///< m
  double mass() const { return mass_; }
  double stiffness() const { return stiffness_; }
  double spring_energy(double x) const { return stiffness_ * x * x * (0.5 + 0.25 * cubic_ * x * x); }  ///< J
  double x() const { return x_; }
  double v() const { return v_; }
  double time() const { return time_; }

  /// Adds up work and impulse of all forces but the grains' from the last call to time t.
  void account(double t);
  double outer_impulse() const { return impulse_; }  ///< N s, spring included
  const std::vector<double>& effect_work() const {
    return work_;
  }  ///< J done on the box by each line of Setup::effects

 private:
  enum class Piece { closed, stuck, dense };
  struct Response {  // to one harmonic force: p sin(w t + phase) + q cos(w t + phase)
    double p, q, frequency, phase;
  };
  static constexpr std::size_t nodes = node_count;
  struct Here {  // where the box is at a time; of a closed piece cosine and sine of its phase, what damping
                 // left
    double time = -std::numeric_limits<double>::infinity();
    Point point{0, 0};
    double cosine = 1, sine = 0, shrink = 1;
  };
  struct Flown {  // since the start of a closed piece: m, m s (integral of x), m^2/s (integral of v^2)
    double way = 0, moment = 0, squares = 0;
  };

  /// Computes the box at time t from the present piece.
  Here look(double t) const;
  Flown flown(double t) const;
  void account_closed(double t);
  void do_work(int effect, double joules) {
    if (effect >= 0) work_[static_cast<std::size_t>(effect)] += joules;
  }
  bool rubs() const { return forces_.dry_friction.sum() > 0 || dahl_.any(); }
  /// Begin the next piece at the present state: whichever kind the forces ask for, and each of the three
  /// kinds. `friction_force`: N, of dry friction in this piece.
  void begin();
  void begin_closed(double friction_force);
  void begin_stuck();
  void begin_dense(double friction_force);
  bool try_dense(double length, double friction_force);
  /// Writes the acceleration at the nodes, m/s^2, as the coefficients of the piece.
  void write_dense(const std::array<double, nodes>& value);
  double first_standstill(double jerk_bound) const;
  double smooth_force(double x, double v, double t) const;
  double acceleration_at(double t) const;

  double mass_, stiffness_, angular_frequency_, cubic_;
  BoxForces forces_;
  bool needs_dense_;

  double time_ = 0, x_ = 0, v_ = 0, top_speed_ = 0;  // at the start of the piece
  mutable Here here_;                                // the latest that was asked for
  double valid_until_ = std::numeric_limits<double>::infinity(), top_acceleration_ = 0;
  Point top_reach_{0, 0};
  Piece piece_ = Piece::closed;
  double friction_ = 0;  // N, force of dry friction in this piece
  DahlState dahl_;
  double direction_ = 0;  // of the motion in this piece where a friction acts
  // closed: centre + responses + exp(-g s) (a cos w s + b sin w s), s = t - time
  double centre_ = 0, a_ = 0, b_ = 0, decay_ = 0, damped_frequency_ = 0;
  std::vector<Response> responses_;
  Flown booked_;  // as far as is accounted
  // dense: polynomials in u = s / length: the acceleration, m/s^2, and what it adds to x over u^2, m, and to
  // x' over u, m/s
  std::array<double, nodes> acceleration_{}, displacement_{}, gained_speed_{};
  double length_ = 0, inverse_length_ = 0, planned_length_ = 2e-3;
  int short_pieces_ = 0;  // of the shortest, one after the other

  double accounted_ = 0, impulse_ = 0;
  std::vector<double> work_;
};

}  // namespace shakedown
