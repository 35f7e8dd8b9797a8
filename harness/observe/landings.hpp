// SPDX-License-Identifier: MIT
// Reads from tracks of the box and of the grains' centre what the layer of grains does when it lands on an
// end wall. In microgravity the layer flies from wall to wall, and what it gives to the wall from one flight
// to the next, how it rebounds, how thick it lies and how long it takes to land tell of the contacts (A. Sack
// et al., Phys. Rev. Lett. 111, 018001 (2013), "collect and collide").
#pragma once
#include <vector>

namespace shakedown {

struct Landing {
  double time = 0;   ///< s, when the layer has lost half of its speed relative to the wall
  double speed = 0;  ///< m/s, greatest relative speed before
  /// kg m/s, of the grains in the flight before less in the one after, towards the wall
  double momentum = 0;
  /// Mean relative speed away from the wall within `landing_window` after it has landed, over `speed`: a
  /// rebound that the wall catches sooner shows less.
  double rebound = 0;
  double lasting = 0;    ///< s, from 90 % to 10 % of the speed
  double thickness = 0;  ///< m, twice the distance of the grains' centre from the wall when it has landed
};

/// The box of a recording, as far as a landing tells of it.
struct LandingBox {
  double length = 0;       ///< m
  double grains_mass = 0;  ///< kg, all grains
  double period = 0;       ///< s, of the swing
};

/// Speeds are slopes of straight lines over this part of a period, by which a layer that is caught at once
/// comes 14 % too slow: two recordings are to be compared at the same frames. With fewer than five frames in
/// it nothing is told.
constexpr double landing_window = 1.0 / 30;

/// Returns the landings in order of time, up to the last that a flight follows. `box`, `centre`: m, in the
/// laboratory, at `time`, s; NaN where missing. A number that the frames do not tell is NaN.
std::vector<Landing> landings(const std::vector<double>& time, const std::vector<double>& box,
                              const std::vector<double>& centre, const LandingBox& of);

}  // namespace shakedown
