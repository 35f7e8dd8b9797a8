// SPDX-License-Identifier: MIT
// Finds who is near whom, keeps what each of these contacts remembers, and computes the forces of a step.
#pragma once
#include <random>
#include <vector>

#include "damper_state.hpp"
#include "model.hpp"

namespace shakedown::apart {

/// What a contact remembers from step to step.
struct Memory {
  bool pressed = false;  ///< there has been a force in this impact
  double begun = 0;      ///< m, overlap at which this impact began: 0, or where the last one ended
  double deepest = 0;    ///< m, greatest overlap of this impact, from `begun`
  LatchingSpring spring;
  double slip_stiffness = 0;    ///< N/m
  Vec3 stretch = Vec3::Zero();  ///< m, of the tangential spring
  double stored = 0;            ///< J, in springs and well, at the last step
};

/// A force of this step: on grain `i`, and the other way on grain `j` or, where j < 0, on the box.
struct Push {
  int i = 0, j = -1;
  ContactClass kind = ContactClass::grain_grain;
  Vec3 newton = Vec3::Zero(), normal = Vec3::Zero();  ///< the normal points from j to i
  double arm_i = 0, arm_j = 0;                        ///< m, from the centres to the point of contact
};

class Encounters {
 public:
  /// `model` must outlive it; `step`: s, length of all steps.
  Encounters(const Model& model, const State& state, double step);

  /// Returns the forces of a step from places at its middle and velocities before it.
  const std::vector<Push>& forces(const State& state);
  /// J, held by springs and wells of each class at the last step.
  const std::array<double, contact_classes>& stored() const { return stored_; }
  /// Returns the number of impacts begun so far, by class.
  const std::array<std::int64_t, contact_classes>& touches() const { return touches_; }
  /// Returns the deepest overlap so far, m.
  double deepest() const { return deepest_; }
  /// Adds to the way that the fastest grain can have gone, m; to be called whenever grains have moved.
  void moved(double way) { wandered_ += way; }

 private:
  struct Pair {
    int i, j;
    Memory memory;
  };
  struct Meeting {
    int i, j;
    ContactClass kind;
    Vec3 normal;
    double overlap, reduced_mass, slip_mass;
  };
  void list_pairs(const State& state);
  /// Adds the forces of all contacts of grains with walls.
  void at_walls(const State& state);
  /// Adds the force of one contact. `rate` below: m/s, by which the overlap grows.
  void meet(const State& state, const Meeting& meeting, Memory& memory);
  /// Begins an impact: draws its restitution and makes its springs.
  void begin(const Meeting& meeting, double rate, Memory& memory);
  double press(const Meeting& meeting, double rate, Memory& memory);
  double pull(const Meeting& meeting, double rate, Memory& memory) const;
  /// Returns the force of friction on the first body, N. `slip`: m/s; `press`: N.
  Vec3 rub(const Meeting& meeting, const Vec3& slip, double press, double rate, Memory& memory) const;

  const Model& model_;
  double step_, skin_, wandered_ = 0;
  std::vector<Pair> pairs_;
  std::vector<Memory> walls_;  ///< six a grain: -x, +x, -y ...
  std::vector<Push> pushes_;
  std::array<double, contact_classes> stored_{};
  std::array<std::int64_t, contact_classes> touches_{};
  double deepest_ = 0;
  std::mt19937_64 random_;
};

}  // namespace shakedown::apart
