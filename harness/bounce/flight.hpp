// SPDX-License-Identifier: MIT
// The flight of a ball between two impacts on a level floor. In still air the equation of motion is
// (m + m_a/2) dv/dt = -(m - m_a) g - (1/2) rho C_d A |v| v, m_a the mass of the air displaced: weight less
// buoyancy, drag, and half the displaced air moving along. Source of drag coefficient and added mass:
// R. Clift, J. R. Grace and M. E. Weber, Bubbles, Drops, and Particles (Academic Press, 1978), table 5.1 and
// section 11; the history of the flow (Basset) is left out.
#pragma once
#include <vector>

namespace shakedown {

/// Returns the drag coefficient of a smooth sphere, R. Clift and W. H. Gauvin (1971):
/// 24/Re (1 + 0.15 Re^0.687) + 0.42/(1 + 42500 Re^-1.16).
/// It is within 6 % of the measurements for 0 < Re < 3e5.
double sphere_drag_coefficient(double reynolds);

struct Ball {
  double mass = 0, diameter = 0;                           ///< kg, m; 0: not said
  bool known() const { return mass > 0 && diameter > 0; }  ///< whether both are said
};

/// Air of 23 C and 1010 hPa, kg/m^3 and Pa s (ICAO standard atmosphere's law for the viscosity).
constexpr double air_density = 1.19, air_viscosity = 1.83e-5;

/// Computes the duration of a flight and the speed of landing from the speed of take-off.
class Flight {
 public:
  /// Without air. `gravity` m/s^2.
  explicit Flight(double gravity) : gravity_(gravity) {}
  /// With a drag of `drag` v^2 per mass, 1/m: closed form. T = (w/g)(atan x + asinh x), landing
  /// v/sqrt(1 + x^2), with the terminal speed w = sqrt(g/drag) and x = v/w.
  Flight(double gravity, double drag) : gravity_(gravity), drag_(drag) {}

  double duration(double takeoff) const;        ///< s
  double landing(double takeoff) const;         ///< m/s
  double height(double takeoff) const;          ///< m, of the highest point
  double takeoff(double duration) const;        ///< m/s; inverse of duration() to 1e-13
  double fall(double height) const;             ///< m/s, speed at impact after a fall from rest
  double duration_slope(double takeoff) const;  ///< d duration/d takeoff, s^2/m

 private:
  friend class BallFlights;
  double correction(const std::vector<double>& table, double takeoff) const;
  double gravity_, drag_ = 0;
  std::vector<double> longer_, slower_,
      lower_;  ///< over vacuum's, at the speeds of BallFlights; empty: closed form
};

/// Flights of a sphere with the drag coefficient at each moment's Reynolds number, integrated from the
/// highest point: back to take-off by Simpson's rule in steps of the speed, down by Runge-Kutta of fourth
/// order. Made once (5 ms).
class BallFlights {
 public:
  /// `gravity` m/s^2. Throws InputError where the ball is lighter than air.
  BallFlights(const Ball& ball, double gravity);
  /// Returns flights with the drag times `factor` (1: the sphere's); quadratic between factors 0.8, 1, 1.2,
  /// error below 1e-5 of duration and speed from 0.7 to 1.3.
  Flight at(double factor) const;

 private:
  double gravity_;  ///< of the ball in air
  std::vector<Flight> tabulated_;
};

}  // namespace shakedown
