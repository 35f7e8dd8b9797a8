// SPDX-License-Identifier: MIT
// The setup with its effects written in: all that an engine reads of what acts on box and grains. SI units.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "setup.hpp"

namespace shakedown {

enum class ContactClass { grain_grain = 0, end_wall = 1, side_wall = 2 };
constexpr int contact_classes = 3;
constexpr std::array<const char*, contact_classes> contact_class_names{"grain_grain", "end_wall",
                                                                       "side_wall"};

/// The law of a contact, in both views. Defaults: constant restitution, no friction, no attraction.
struct ContactLaw {
  std::array<double, contact_classes> restitution{0.75, 0.76, 0.76};
  /// Restitution at closing speed v > 0 (m/s) at first touch; empty: the constant above. The hard engine's
  /// view (rebound).
  std::function<double(ContactClass, double closing_speed)> restitution_at;
  /// Soft engine's own normal force (push), N, repulsive positive, from overlap > 0 (m), its rate (m/s) and
  /// the closing speed at first touch; empty: linear spring-dashpot that gives the restitution above at that
  /// speed.
  std::function<double(ContactClass, double overlap, double overlap_rate, double closing_speed,
                       double reduced_mass)>
      push;
  /// Elastic energy stored by `push` at this overlap, J.
  std::function<double(ContactClass, double overlap, double closing_speed, double reduced_mass)>
      stored_energy;

  std::array<double, contact_classes> friction{0, 0, 0};  ///< Coulomb coefficient
  double tangential_restitution = 1;  ///< slip reversed times this where friction suffices
  bool has_friction() const { return friction[0] > 0 || friction[1] > 0 || friction[2] > 0; }

  double attraction_force = 0;  ///< N, constant attraction up to a gap of
  double attraction_range = 0;  ///< m
  bool has_attraction() const { return attraction_force > 0 && attraction_range > 0; }
};

/// A sin(2 pi f t + phase).
struct Harmonic {
  double amplitude = 0;  ///< N or m/s^2
  double frequency = 0;  ///< Hz
  double phase = 0;      ///< rad
  int effect = -1;       ///< line in Setup::effects
};

/// A force on the box that is none of the closed forms; x, v, t of the box in the lab.
struct FreeForce {
  std::function<double(double x, double v, double t)> newton;
  int effect = -1;
};

/// Forces on the box besides the linear spring and the grains. Each effect's index is its line in the ledger,
/// -1: unused.
struct BoxForces {
  double viscous = 0;  ///< N s/m: -c v
  int viscous_effect = -1;
  double dry_friction = 0;  ///< N: -F sgn(v), sticks
  int dry_friction_effect = -1;
  double constant = 0;  ///< N
  int constant_effect = -1;
  std::vector<Harmonic> harmonics;  ///< N
  std::vector<FreeForce> free;      ///< anything else
};

/// Accelerations of the grains between contacts.
struct GrainForces {
  Vec3 constant = Vec3::Zero();  ///< m/s^2
  int constant_effect = -1;
  struct HarmonicVector {
    Vec3 amplitude = Vec3::Zero();  ///< m/s^2
    double frequency = 0, phase = 0;
    int effect = -1;
  };
  std::vector<HarmonicVector> harmonics;
  double linear_drag =
      0;  ///< N s/m per grain, against air that moves with the box; the box feels the reaction
  double quadratic_drag = 0;  ///< N s^2/m^2
  int drag_effect = -1;
  /// Force on a grain along x, N, as a function of the grain's own x, v and t in the lab.
  std::vector<FreeForce> free;
  /// Length of the blade whose tip the box follows on an arc, m; 0: straight. Transverse (z) acceleration of
  /// the grains in the box frame: -(6/5)(v^2 + x a)/l; in the lab the box's z position is (3/5) x^2/l.
  double arc_length = 0;
  int arc_effect = -1;
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
  double scale = 0;   ///< positions times 1 + s
  double drift = 0;   ///< m/s, times t added to positions
  double origin = 0;  ///< m, added to positions
  double time_offset = 0;  ///< s, t_recorded = t + offset
};

struct Physics {
  double box_mass = 0;      ///< kg, moving mass of the box, added mass included
  double stiffness = 0;     ///< N/m, k = M (2 pi f)^2 with the setup's M
  double spring_cubic = 0;  ///< m^-2: spring force -k x (1 + spring_cubic x^2)
  int spring_cubic_effect = -1;
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

/// The setup's numbers with each of its effects applied in turn. Not for sharing between threads when it
/// holds a user's formula: each run makes its own, or takes a copy.
Physics physics_of(const Setup& setup);

}  // namespace shakedown
