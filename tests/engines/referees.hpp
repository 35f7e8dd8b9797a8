// SPDX-License-Identifier: MIT
// The cases of other people's benchmarks as encounters of ours, and balls that bounce and roll.
#pragma once
#include "one_impact.hpp"
#include "published_figures.hpp"

namespace shakedown {

/// Hertz's elastic impact: F = k overlap^(3/2).
struct Hertz {
  double stiffness, deepest, peak_force, duration;  ///< N/m^1.5, m, N, s
};
/// Of materials: E* = E / (1 - nu^2) at a rigid plane, half of it between alike spheres.
Hertz hertz_impact(const Encounter& encounter, double youngs_modulus, double poisson_ratio);

/// A solid sphere of this radius (m) and density (kg/m^3) that meets its partner.
Encounter sphere_meets(Partner partner, double degrees, double speed, double radius, double density);

/// Tests of Chung and Ooi (published_figures.hpp has what they ask).
Encounter impact_of(const published::NormalImpact& normal);  ///< 1 and 2
Encounter normal_impact(double restitution);                 ///< 3
Encounter oblique_impact(double degrees);                    ///< 4
Encounter scaled_impact(double slip_over_mu_normal);         ///< 5
Encounter spinning_impact(double degrees);                   ///< 6
Encounter twin_impact(double spin);                  ///< 7, rad/s: their surfaces go along with each other
Encounter spinning_impact_on_large(double degrees);  ///< 8

/// What benchmarks look at after an impact.
struct Rebound {
  double tangential;       ///< tangential velocity of the centre, m/s
  double spin;             ///< about normal x tangent, rad/s
  double slip;             ///< of the point of contact along the tangent, m/s
  double closing;          ///< normal velocity, m/s, positive: apart
  double contact_degrees;  ///< angle at which the point of contact leaves
};
Rebound rebound_of(const Encounter& encounter, const Motion& after);

/// A ball on a floor: 10 mm, restitution 0.76, gravity 9.81 m/s^2.
struct Roll {
  double speed = 0.5;   ///< m/s along x at the start
  double backspin = 0;  ///< surface speed against it over it
  double friction = 0.3, tangential_restitution = 1;
  double rolling_resistance = 0;
  double slipping() const;       ///< s until it rolls
  double rolling_speed() const;  ///< m/s
};
struct Rolled {
  double speed, surface_speed, distance;  ///< m/s, m/s forwards, m
};
Rolled roll(const std::string& engine, const Roll& ball, double time);

/// A ball that falls on a floor and bounces (MFiX DEM01 and DEM02): 0.2 m, 2600 kg/m^3, from 0.5 m.
struct Fall {
  double radius = 0.1, height = 0.5;          ///< m, of the centre
  double restitution = 0.9, stiffness = 5e5;  ///< N/m, of the soft engine's spring
  int bounces = 1;
  double mass() const;
};
struct Peak {
  double height, time;  ///< m, of the centre; s since it was let go
};
/// The peak after the bounces by instantaneous impacts, and of a spring with a dashpot that feels the weight
/// while it is pressed.
Peak peak_by_impacts(const Fall& ball);
Peak peak_by_spring(const Fall& ball);
/// Height of an engine's peak, m: its ball is looked at when one of these says that it is there.
double peak_by(const std::string& engine, const Fall& ball);

}  // namespace shakedown
