// SPDX-License-Identifier: MIT
// A stand-in for an engine whose motion is a formula, and which models every effect.
#pragma once
#include <string_view>
#include <utility>

#include "engine.hpp"

namespace shakedown {

class FormulaEngine : public Engine {
 public:
  std::string_view name() const override { return "stand-in"; }
  Capability can_model(const EffectRecord&) const override { return {Fidelity::exact, ""}; }

 protected:
  /// `motion(t)` gives the places of box and grains' centre, m, at t s; so many samples a second.
  template <typename Motion>
  static Trajectory sampled(const Setup& setup, double rate, Motion&& motion) {
    Trajectory trajectory;
    for (int k = 0; k <= static_cast<int>(setup.run.duration * rate); ++k) {
      const double t = k / rate;
      const std::pair<double, double> places = motion(t);
      trajectory.time.push_back(t);
      trajectory.x_box.push_back(places.first);
      trajectory.x_com.push_back(places.second);
    }
    trajectory.v_box = trajectory.total_energy = trajectory.x_box;
    return trajectory;
  }
};

}  // namespace shakedown
