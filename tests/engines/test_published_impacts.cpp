// SPDX-License-Identifier: MIT
// Single impacts of benchmarks that others wrote, as far as the engines can express them: figures read off
// their diagrams, their closed forms. The tables are in bench/results/2026-11-26-referees-of-one-impact.md.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "referees.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr std::array engines{"hard", "soft", "bullet"};

Rebound rebound(const std::string& engine, Encounter it, double tangential_restitution) {
  it.tangential_restitution = engine == "bullet" ? 0 : tangential_restitution;  // the one that it has
  it.steps_per_contact = 200;
  return rebound_of(it, impact_by(engine, it).motion);
}

}  // namespace

TEST(PublishedImpact, HertzsForceGivesTheCurvesOfChungAndOoi) {
  for (const auto& figure : published::normal_impacts) {
    SCOPED_TRACE(figure.what);
    Encounter it = impact_of(figure);
    const Hertz hertz = hertz_impact(it, figure.youngs_modulus, figure.poisson_ratio);
    WITHIN(figure.peak_force / hertz.peak_force, 1, 2e-3, 8.8e-4);
    WITHIN(figure.duration / hertz.duration, 1, 0.01, 6.4e-3);
    it.contact_time = hertz.duration;
    it.hertz_stiffness = hertz.stiffness;
    const Outcome seen = impact_by("soft", it);
    WITHIN(seen.deepest_overlap / hertz.deepest, 1, 1e-5, 8.5e-7);
    WITHIN(seen.seconds_in_contact / hertz.duration, 1, 5e-6, 4.5e-7);
    WITHIN(seen.energy_gained, 0, 4e-8, 2.3e-9);
  }
}

/// Of the duration of Hertz's contact the linear spring is pressed 6 % less, by 15 % less force.
TEST(PublishedImpact, ALinearSpringOfHertzsDurationIsPressedLess) {
  constexpr double hertz_duration = 2.9432750;  // in depths over speeds
  for (const auto& figure : published::normal_impacts) {
    Encounter it = impact_of(figure);
    const Hertz hertz = hertz_impact(it, figure.youngs_modulus, figure.poisson_ratio);
    it.contact_time = hertz.duration;
    const Outcome seen = impact_by("soft", it);
    WITHIN(seen.deepest_overlap / hertz.deepest, hertz_duration / std::numbers::pi, 1e-5, 1.1e-6);
    const double rate = std::numbers::pi / it.contact_time;
    WITHIN(it.reduced_mass() * rate * rate * seen.deepest_overlap / hertz.peak_force,
           std::numbers::pi / (1.25 * hertz_duration), 1e-5, 1e-6);
  }
}

TEST(PublishedImpact, LeavesWithTheRestitutionThatWasAsked) {
  for (const char* engine : engines)
    for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      const Encounter it = normal_impact(e);
      WITHIN(rebound(engine, it, 1).closing / it.closing(), e, 5e-5, 4.4e-6) << engine;
    }
}

/// Beyond 32.5 degrees test 4 of Chung and Ooi slides, and no compliance of the surfaces is seen.
TEST(PublishedImpact, SlidesAtTheAnglesOfChungAndOoi) {
  for (const auto& figure : published::oblique_impacts) {
    if (figure.degrees < 32.5) continue;
    const Encounter it = oblique_impact(figure.degrees);
    for (const char* engine : engines) {
      SCOPED_TRACE(std::string(engine) + " at " + std::to_string(figure.degrees));
      const Rebound seen = rebound(engine, it, 1);
      WITHIN(seen.tangential / it.velocity.dot(place_of(it.partner).tangent), figure.tangential_restitution,
             0.01, 2.9e-3);
      WITHIN(-seen.spin, figure.spin, 10, 3.5);
      WITHIN(seen.contact_degrees, figure.contact_degrees, 1.5, 0.52);
    }
  }
}

/// From 49 degrees on what Kharaz, Gorham and Salman measured left 1 to 2 degrees farther out.
TEST(PublishedImpact, SlidesAtTheAnglesOfKharazWhereNothingSticks) {
  for (const auto& figure : published::measured_angles) {
    const Encounter it = oblique_impact(figure.degrees);
    SCOPED_TRACE(figure.degrees);
    for (const char* engine : engines) {
      if (figure.degrees < 32.5) continue;
      WITHIN(rebound(engine, it, 1).contact_degrees, figure.contact_degrees, 3, 2.0) << engine;
    }
  }
}

/// Below 32 degrees surfaces give way sideways. With the tangential spring of elastic bodies of alumina
/// (Poisson's ratio 0.23) hard and soft leave as what was measured, with nothing fitted; with that of 2/7
/// they are 5.6 degrees off (root of the mean square).
TEST(PublishedImpact, LeavesAtTheAnglesOfKharazWithTheSpringOfElasticBodies) {
  for (const char* engine : {"hard", "soft"}) {
    double squares = 0, rigid_squares = 0;
    int angles = 0;
    for (const auto& figure : published::measured_angles) {
      Encounter it = oblique_impact(figure.degrees);
      if (figure.degrees > 32.5) continue;
      const double rigid = rebound(engine, it, 1).contact_degrees - figure.contact_degrees;
      it.stiffness_ratio = 2 * (1 - 0.23) / (2 - 0.23);
      SCOPED_TRACE(figure.degrees);
      const double seen = rebound(engine, it, 1).contact_degrees;
      WITHIN(seen, figure.contact_degrees, 2, 0.98) << engine;
      squares += std::pow(seen - figure.contact_degrees, 2);
      rigid_squares += rigid * rigid;
      ++angles;
    }
    WITHIN(std::sqrt(squares / angles), 0.7, 0.2, 0.025) << engine;
    WITHIN(std::sqrt(rigid_squares / angles), 5.6, 0.3, 0.021) << engine;
  }
}

/// Test 5: where the slip is 5 times friction times the normal speed and more, steel slides; the finite
/// elements slide from 7 on. In between a hard sphere whose slip is turned round lies on the steel's line.
TEST(PublishedImpact, SlidesWhereSteelAndFiniteElementsDo) {
  const auto check = [](const auto& figures, double from) {
    constexpr double scale = 0.3 * 5;
    for (const auto& figure : figures) {
      if (figure.slip < from) continue;
      const Encounter it = scaled_impact(figure.slip);
      for (const char* engine : engines) {
        if (std::string(engine) == "bullet" && figure.slip < 7) continue;  // it stops the slip
        SCOPED_TRACE(std::string(engine) + " at " + std::to_string(figure.slip));
        const Rebound seen = rebound(engine, it, 1);
        WITHIN(seen.slip / scale, figure.slip_after, 0.2, 0.07);
        WITHIN(seen.spin * it.radius / scale, figure.spin_after, 0.2, 0.06);
      }
    }
  };
  check(published::steel_spheres, 4.9);
  check(published::finite_elements, 7);
}

/// Tests 6 and 8: slides from 65 degrees on, on a plane as on a sphere of five times the radius.
TEST(PublishedImpact, SpinsSlideOnPlanesAndLargeSpheres) {
  for (const auto& figure : published::spinning_impacts) {
    const Encounter plane = spinning_impact(figure.degrees),
                    sphere = spinning_impact_on_large(figure.degrees);
    for (const char* engine : engines) {
      SCOPED_TRACE(std::string(engine) + " at " + std::to_string(figure.degrees));
      const double on_plane = -rebound(engine, plane, 1).slip / plane.slip().norm();
      const double on_sphere = -rebound(engine, sphere, 1).slip / sphere.slip().norm();
      WITHIN(on_plane, on_sphere, 2e-4, 2.2e-5);
      if (figure.degrees < 65) continue;
      WITHIN(on_plane, figure.alloy, 0.02, 0.008);
      WITHIN(on_plane, figure.nylon, 0.02, 8.3e-3);
      WITHIN(on_sphere, figure.on_large_sphere, 0.02, 0.004);
    }
  }
}

/// Test 7: surfaces that go along with each other have no friction.
TEST(PublishedImpact, TwinsWhoseSurfacesGoTogetherKeepTheirSpins) {
  for (const char* engine : engines)
    for (const double spin : {0.17, 1.4, 5.5, 22.9}) {
      const Encounter it = twin_impact(spin);
      const Motion after = impact_by(engine, it).motion;
      WITHIN((after.spin - it.spin).norm(), 0, 4e-13, 4.3e-14) << engine;
      WITHIN((after.other_spin - it.other_spin).norm(), 0, 4e-13, 4.3e-14) << engine;
      WITHIN(after.velocity.dot(place_of(it.partner).tangent), 0, 2e-16, 1.4e-17) << engine;
    }
}

/// MFiX-DEM's verification cases DEM01 and DEM02 (mfix.netl.doe.gov/doc/vvuq-manual).
TEST(SlowPublishedImpact, BouncesToTheHeightsOfMfix) {
  for (const double e : {0.5, 0.6, 0.7, 0.8, 0.9, 1.0})
    for (const int bounces : {1, 2, 3}) {
      Fall ball;
      ball.restitution = e;
      ball.bounces = bounces;
      WITHIN(peak_by("hard", ball), peak_by_impacts(ball).height, 5e-14, 3.8e-15);
      for (const double stiffness : {5e4, 5e5, 5e6}) {
        ball.stiffness = stiffness;
        WITHIN(peak_by("soft", ball), peak_by_spring(ball).height, 2e-5, 6.4e-6) << stiffness;
      }
    }
}

/// DEM04, and a ball thrown with backspin: up to 2.5 it rolls on, beyond it comes back.
TEST(PublishedImpact, SlipsUntilItRolls) {
  for (const double friction : {0.3, 0.6})
    for (const double backspin : {0.0, 1.0, 2.5, 4.0}) {
      SCOPED_TRACE(std::to_string(friction) + ", backspin " + std::to_string(backspin));
      Roll ball{.backspin = backspin, .friction = friction, .tangential_restitution = 0};
      const double slipping = ball.slipping();
      const Rolled rolled = roll("hard", ball, 3 * slipping);
      WITHIN(rolled.speed, ball.rolling_speed(), 1e-14, 9e-16);
      WITHIN(rolled.surface_speed, ball.rolling_speed(), 2e-14, 2.2e-15);
      ball.tangential_restitution = 1;
      for (const char* engine : {"hard", "soft"}) {
        // Nothing turns it about the line on the floor that it touches.
        for (const double share : {0.3, 2.0}) {
          const Rolled seen = roll(engine, ball, share * slipping);
          WITHIN(seen.speed + 0.4 * seen.surface_speed, 1.4 * ball.rolling_speed(), 1e-4, 1.3e-5) << engine;
        }
      }
      WITHIN(roll("soft", ball, slipping / 2).speed, ball.speed * (6 - backspin) / 7, 5e-4, 9.8e-5);
      WITHIN(roll("soft", ball, 3 * slipping).speed, ball.rolling_speed(), 2e-3, 5.6e-4);
    }
}
