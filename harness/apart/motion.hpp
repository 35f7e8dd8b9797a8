// SPDX-License-Identifier: MIT
// Steps in time: half a drift, a kick at the middle, half a drift (J. J. Moreau's midpoint rule). Velocities
// against which something drags enter the kick implicitly, dry friction as an impulse of bounded size.
#pragma once
#include <vector>

#include "encounters.hpp"

namespace shakedown::apart {

class Motion {
 public:
  /// Begins at `state`. `model` must outlive it; `step`: s, length of all steps; `effects`: number of lines
  /// in Setup::effects, to which losses are booked.
  Motion(const Model& model, State state, double step, std::size_t effects);

  /// Goes on by one step from this time, s.
  void advance(double time);

  const State& state() const { return state_; }  ///< after the last step, SI
  /// Returns the energy of spring, box and grains and what contacts hold, J.
  double energy() const;
  /// Return what was lost in contacts of each class and to each effect since the start, J.
  std::array<double, contact_classes> contact_loss() const;
  const std::vector<double>& effect_loss() const { return effect_loss_; }
  const Encounters& encounters() const { return encounters_; }

 private:
  /// Moves box and grains for half a step at their velocities.
  void drift();
  void kick_grains(double time);
  /// Changes the velocity of the box by the forces of a whole step, `time` its middle, s, and books what they
  /// take.
  void kick_box(double time);
  void follow_arc();
  /// Returns the force of an effect on the box that does not depend on its speed, N; 0 of one that does.
  double push_of(const BoxPush& push, double time) const;
  double drag_at(double speed) const;
  void enter_contact_work();

  const Model& model_;
  State state_;
  double step_;
  Encounters encounters_;
  std::vector<Vec3> force_, torque_, velocity_before_, spin_before_;
  double box_force_ = 0, box_before_ = 0, box_change_ = 0, arc_before_ = 0;
  const std::vector<Push>* pushes_ = nullptr;
  std::array<double, contact_classes> contact_work_{};
  std::vector<double> effect_loss_;
  bool turns_;
};

}  // namespace shakedown::apart
