// SPDX-License-Identifier: MIT
// How the walls across an axis move as the grains see them, in their falling frame.
#pragma once
#include <algorithm>

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

  BoxMotion::Point at(double t) const {
    const double s = frame->displacement(t)[axis], v = frame->velocity(t)[axis];
    if (axis == 0) {
      const BoxMotion::Point p = box->at(t);
      return {p.x - s, p.v - v};
    }
    if (axis == 1 || arc_curvature == 0) return {-s, -v};
    const BoxMotion::Point p = box->at(t);
    return {arc_curvature * (p.x * p.x - release_x * release_x) - s, 2 * arc_curvature * p.x * p.v - v};
  }
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
  double valid_until() const {
    return axis == 0 || (axis == 2 && arc_curvature != 0) ? box->valid_until() : BoxMotion::valid_until();
  }
};

}  // namespace shakedown
