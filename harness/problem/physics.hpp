// SPDX-License-Identifier: MIT
// The setup with its effects written in: all that an engine reads of what acts on box and grains. SI units.
#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "dahl_friction.hpp"
#include "setup.hpp"

namespace shakedown {

enum class ContactClass { grain_grain = 0, end_wall = 1, side_wall = 2 };
constexpr int contact_classes = 3;
constexpr std::array<const char*, contact_classes> contact_class_names{"grain_grain", "end_wall",
                                                                       "side_wall"};

/// Returns nothing of a kind: 0, or a vector of zeros, which Eigen's own default is not.
template <class Value>
Value none_of() {
  if constexpr (std::is_same_v<Value, Vec3>)
    return Vec3::Zero();
  else
    return {};
}

/// A strength to which several effects contribute: engines let the sum act, and the energy ledger books each
/// contribution on the line of its own effect.
template <class Value>
class Slot {
 public:
  struct Share {
    Value strength;
    int effect;  ///< line in Setup::effects
  };

  /// `effect`: the line of the energy ledger that gets the share.
  void add(const Value& strength, int effect) {
    shares_.push_back({strength, effect});
    sum_ = shares_.size() == 1 ? strength : Value(sum_ + strength);
  }
  const Value& sum() const { return sum_; }
  const std::vector<Share>& shares() const { return shares_; }

 private:
  Value sum_ = none_of<Value>();
  std::vector<Share> shares_;
};

/// The law of a contact, in both views. Defaults: constant restitution, no friction, no attraction.
struct ContactLaw {
  std::array<double, contact_classes> restitution{0.75, 0.76, 0.76};
  /// Restitution at closing speed v > 0 (m/s) at first touch; empty: the constant above. The hard engine's
  /// view (rebound).
  std::function<double(ContactClass, double closing_speed)> restitution_at;
  /// The side walls' own restitution at closing speed v (m/s), whatever the law of the other contacts, also
  /// of `push`; empty: theirs.
  std::function<double(double closing_speed)> side_wall_restitution_at;
  /// Returns the restitution that the above give at this closing speed (m/s).
  double restitution_of(ContactClass kind, double closing_speed) const {
    if (kind == ContactClass::side_wall && side_wall_restitution_at)
      return side_wall_restitution_at(closing_speed);
    return restitution_at ? restitution_at(kind, closing_speed) : restitution[static_cast<std::size_t>(kind)];
  }
  /// Soft engine's own normal force (push), N, repulsive positive, from overlap > 0 (m), its rate (m/s) and
  /// the closing speed at first touch; empty: linear spring-dashpot that gives the restitution above at that
  /// speed.
  std::function<double(ContactClass, double overlap, double overlap_rate, double closing_speed,
                       double reduced_mass)>
      push;
  /// Elastic energy stored by `push` at this overlap, J.
  std::function<double(ContactClass, double overlap, double closing_speed, double reduced_mass)>
      stored_energy;
  /// Tells whether `push` is the normal force of this kind of contact.
  bool pushes(ContactClass kind) const {
    return push && !(kind == ContactClass::side_wall && side_wall_restitution_at);
  }

  std::array<double, contact_classes> friction{0, 0, 0};  ///< Coulomb coefficient
  /// Coefficient at a slip speed (m/s) of the touching points at first touch, and the constant above; empty:
  /// the constant.
  std::function<double(ContactClass, double slip_speed, double constant)> friction_at;
  /// Returns the Coulomb coefficient of this kind of contact at this slip (m/s).
  double friction_of(ContactClass kind, const Vec3& slip) const {
    const double constant = friction[static_cast<std::size_t>(kind)];
    return friction_at ? friction_at(kind, slip.norm(), constant) : constant;
  }
  bool rubs(ContactClass kind) const { return friction_at || friction[static_cast<std::size_t>(kind)] > 0; }
  double tangential_restitution = 1;  ///< slip reversed times this where friction suffices
  /// Tangential spring over the normal one. With 2/7 the slip of solid spheres has turned round when the
  /// contact ends.
  double stiffness_ratio = turning_ratio;
  static constexpr double turning_ratio = 2.0 / 7;
  bool has_friction() const { return friction_at || friction[0] > 0 || friction[1] > 0 || friction[2] > 0; }

  /// Torque against the relative rolling over reduced radius times normal force. Grains roll where there is
  /// friction: without it nothing turns them.
  std::array<double, contact_classes> rolling_resistance{0, 0, 0};
  bool resists_rolling() const {
    return has_friction() &&
           (rolling_resistance[0] > 0 || rolling_resistance[1] > 0 || rolling_resistance[2] > 0);
  }

  double attraction_force = 0;     ///< N, constant up to a gap of attraction_range
  double attraction_range = 0;     ///< m
  double attraction_of_walls = 1;  ///< force between a grain and a wall, of that between two grains
  int attraction_effect = -1;      ///< line in Setup::effects
  /// Tell whether grains attract each other, and whether the walls attract them too.
  bool has_attraction() const { return attraction_force > 0 && attraction_range > 0; }
  bool walls_attract() const { return has_attraction() && attraction_of_walls > 0; }
  /// Returns the attraction in this kind of contact, N; reach() returns the gap up to which it acts, m.
  double attraction(ContactClass contact) const {
    return contact == ContactClass::grain_grain ? attraction_force : attraction_force * attraction_of_walls;
  }
  double reach(ContactClass contact) const { return attraction(contact) > 0 ? attraction_range : 0; }
};

/// A sin(2 pi f t + phase), a number or a vector.
template <class Amplitude>
struct HarmonicOf {
  Amplitude amplitude = none_of<Amplitude>();  ///< N or m/s^2
  double frequency = 0;                        ///< Hz
  double phase = 0;                            ///< rad
  int effect = -1;                             ///< line in Setup::effects

  /// Returns the value at time t, s, in the unit of the amplitude.
  Amplitude at(double t) const { return amplitude * std::sin(2 * std::numbers::pi * frequency * t + phase); }
};
using Harmonic = HarmonicOf<double>;
using HarmonicVector = HarmonicOf<Vec3>;

/// A force on the box that is none of the closed forms; x, v, t of the box in the lab.
struct FreeForce {
  std::function<double(double x, double v, double t)> newton;
  int effect = -1;
};

/// Forces on the box besides its spring and the grains.
struct BoxForces {
  Slot<double> viscous;             ///< N s/m: -c v
  Slot<double> dry_friction;        ///< N: -F sgn(v), sticks
  Slot<double> constant;            ///< N
  std::vector<Harmonic> harmonics;  ///< N
  std::vector<FreeForce> free;      ///< anything else
  std::vector<DahlFriction> dahl;   ///< depends on the path: DahlState

  bool none() const;  ///< nothing acts
  /// Returns the sum of all forces but the frictions, N, on a box at x (m) with velocity v (m/s) at time t
  /// (s), added to `spring`, the force of its spring.
  double newton(double x, double v, double t, double spring = 0) const;
  /// Calls use(newton, effect) for every contribution to newton(), the spring left out.
  template <class Use>
  void each(double x, double v, double t, Use&& use) const {
    for (const auto& share : viscous.shares()) use(-share.strength * v, share.effect);
    for (const auto& share : constant.shares()) use(share.strength, share.effect);
    for (const Harmonic& harmonic : harmonics) use(harmonic.at(t), harmonic.effect);
    for (const FreeForce& force : free) use(force.newton(x, v, t), force.effect);
  }
};

/// Drag of the air on one grain: -(linear + quadratic |w|) w at a speed w against air that moves with the
/// box.
struct AirDrag {
  double linear = 0;     ///< N s/m
  double quadratic = 0;  ///< N s^2/m^2

  AirDrag operator+(const AirDrag& other) const {
    return {linear + other.linear, quadratic + other.quadratic};
  }
  double over_speed(double speed) const { return linear + quadratic * speed; }  ///< N s/m
  bool none() const { return linear == 0 && quadratic == 0; }                   ///< whether there is no drag
};

/// Accelerations of the grains between contacts.
struct GrainForces {
  Slot<Vec3> constant;                    ///< m/s^2
  std::vector<HarmonicVector> harmonics;  ///< m/s^2
  Slot<AirDrag> drag;                     ///< on each grain; the box feels the reaction
  /// Force on a grain along x, N, as a function of the grain's own x, v and t in the lab.
  std::vector<FreeForce> free;
  /// Length of the blade whose tip the box follows on an arc, m; 0: straight. Transverse (z) acceleration of
  /// the grains in the box frame: -(6/5)(v^2 + x a)/l; in the lab the box's z position is (3/5) x^2/l.
  double arc_length = 0;
  int arc_effect = -1;

  bool none() const;  ///< nothing acts
};

/// The shutter's number is a time for this length of track, and the lens's a distortion at this distance from
/// the optical axis, m.
constexpr double camera_track = 0.4, camera_lens_reach = 0.2;

/// What the camera does to the truth, in this order. The optical axis meets the track at x = 0.
struct Camera {
  double shutter = 0;      ///< s for camera_track; a thing at x is seen at t + shutter x / camera_track
  double centre_bias = 0;  ///< centre = x_box + (1 - b)(x_com - x_box)
  double arc_length = 0;   ///< m; centre = x_box + (x_com - x_box) cos(1.5 x_box/l); 0: off
  double depth = 0;   ///< centre times 1 + depth: the grains are nearer to the lens (> 0) than the marker
  double lens = 0;    ///< positions times 1 + lens (x / camera_lens_reach)^2
  double tilt = 0;    ///< positions times 1 + tilt x / camera_lens_reach, with the lens's
  double scale = 0;   ///< positions times 1 + s
  double drift = 0;   ///< m/s, times t added to positions
  double origin = 0;  ///< m, added to positions
  double time_offset = 0;  ///< s, t_recorded = t + offset
  bool operator==(const Camera&) const = default;
};

struct Physics {
  double box_mass = 0;              ///< kg, moving mass of the box, added mass included
  double stiffness = 0;             ///< N/m, k = M (2 pi f)^2 with the setup's M
  double spring_cubic = 0;          ///< m^-2: spring force -k x (1 + spring_cubic x^2)
  double initial_box_velocity = 0;  ///< m/s
  double release_displacement = 0;  ///< m, of the setup: effects scale with it
  double soft_contact_time =
      0;  ///< s, of the setup: laws with a stiffness of their own choose it to last this long
  double relative_diameter_deviation = 0;
  Packing packing = Packing::fcc;
  ContactLaw contact;
  BoxForces box;
  GrainForces grains;
  Camera camera;
};

/// Returns the setup's numbers with each of its effects applied in turn. Threads must not share it when it
/// holds a user's formula: each run makes its own, or takes a copy.
Physics physics_of(const Setup& setup);

}  // namespace shakedown
