// SPDX-License-Identifier: MIT
// How the walls across an axis move as the grains see them, in their falling frame.
#pragma once
#include <algorithm>
#include <optional>

#include "driven_box.hpp"
#include "falling_frame.hpp"

namespace shakedown {

/// Walls across axis 0 (end walls), 1 or 2 (side walls) of a driven box. With a blade of length l the box's z
/// position follows the arc arc_curvature x^2, arc_curvature = (3/5) / l, counted from its value at release.
struct DrivenWalls {
  const DrivenBox* box;
  const FallingFrame* frame;
  int axis;
  double arc_curvature, release_x;

  /// Returns place (m) and velocity (m/s) of the middle between the walls at time t, s, in the grains' frame.
  /// Across axis 0 it is the box's; across the others the place counts from its value at release.
  BoxMotion::Point at(double t) const {
    const FallingFrame::Point& fallen = frame->at(t);
    const double s = fallen.x[axis], v = fallen.v[axis];
    if (axis == 0) {
      const BoxMotion::Point p = box->at(t);
      return {p.x - s, p.v - v};
    }
    if (axis == 1 || arc_curvature == 0) return {-s, -v};
    const BoxMotion::Point p = box->at(t);
    return {arc_curvature * (p.x * p.x - release_x * release_x) - s, 2 * arc_curvature * p.x * p.v - v};
  }
  /// Returns a bound of the walls' acceleration until valid_until(), m/s^2.
  double top_acceleration() const {
    const double falling = frame->top(axis);
    if (axis == 0) return box->top_acceleration() + falling;
    if (axis == 1 || arc_curvature == 0) return falling;
    // |2 c (v^2 + x a)| with bounds of this piece. They lie below those of twice the present swing but where
    // the box hardly swings by itself.
    const double speed = 2 * box->top_speed(), reach = speed / box->angular_frequency();
    const DrivenBox::Point top = box->top_reach();
    return 2 * arc_curvature *
               std::max(speed * speed + reach * box->top_acceleration(),
                        top.v * top.v + top.x * box->top_acceleration()) +
           falling;
  }
  double top_speed() const { return box->top_speed(); }
  double angular_frequency() const { return box->angular_frequency(); }
  /// Returns the place, m, about which the walls swing harmonically until valid_until(); nothing where they
  /// move otherwise.
  std::optional<double> harmonic_centre() const {
    if (axis != 0 || !box->is_harmonic() || frame->top(0) != 0) return std::nullopt;
    return box->centre();
  }
  double valid_until() const {
    return axis == 0 || (axis == 2 && arc_curvature != 0) ? box->valid_until() : BoxMotion::valid_until();
  }
};

}  // namespace shakedown
