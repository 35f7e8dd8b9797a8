// SPDX-License-Identifier: MIT
#include "referees.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "effects.hpp"
#include "hard_sphere_system.hpp"
#include "soft_engine.hpp"

namespace shakedown {

namespace {

constexpr double gravity = 9.81;

/// A box with a floor at -z; the hard engine takes fields in a damper alone: one that nothing moves.
Setup box_with_gravity(const std::string& engine, double radius, double restitution) {
  Setup setup;
  setup.domain = engine == "hard" ? Domain::damper : Domain::closed;
  setup.box.mass = 1e12;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 400 * radius;
  setup.spring.frequency = 1e-6;
  setup.release.displacement = 0;
  setup.grains.count = 1;
  setup.grains.diameter = 2 * radius;
  setup.restitution.grain_grain = setup.restitution.grain_wall = restitution;
  EffectChoice pull = with_defaults(*find_effect("constant_acceleration"));
  pull.values.insert_or_assign("acceleration", Vec3(0, 0, -gravity));
  setup.effects.push_back(pull);
  return setup;
}

State state_after(const std::string& engine, Setup setup, const State& start, double time) {
  setup.run.duration = time;
  setup.run.sample_rate = 1 / time;
  if (engine != "hard") return run_soft_from(start, setup).end_state;
  HardSphereSystem system(setup, start);
  system.advance_to(time);
  return system.state();
}

double contact_time(const Fall& ball) {
  const double rate = std::log(ball.restitution);
  return std::sqrt(ball.mass() * (std::numbers::pi * std::numbers::pi + rate * rate) / ball.stiffness);
}

Encounter spinning(Encounter it, double degrees) {
  it.restitution = 0.5;
  it.friction = 0.4;
  it.contact_time = 1e-4;
  const auto& [normal, tangent] = place_of(it.partner);
  const double slip = it.closing() * std::tan(degrees * std::numbers::pi / 180);
  it.spin = normal.cross(tangent) * (slip / it.radius);
  return it;
}

}  // namespace

Hertz hertz_impact(const Encounter& it, double youngs_modulus, double poisson_ratio) {
  const bool pair = it.partner == Partner::grain;
  const double modulus = youngs_modulus / (1 - poisson_ratio * poisson_ratio) / (pair ? 2 : 1);
  const double radius = pair ? it.radius * it.other_radius / (it.radius + it.other_radius) : it.radius;
  const double stiffness = 4.0 / 3 * modulus * std::sqrt(radius), speed = it.closing();
  const double deepest = std::pow(1.25 * it.reduced_mass() * speed * speed / stiffness, 0.4);
  return {stiffness, deepest, stiffness * std::pow(deepest, 1.5), 2.9432750 * deepest / speed};
}

Encounter sphere_meets(Partner partner, double degrees, double speed, double radius, double density) {
  Encounter it = meets(partner, degrees, speed);
  it.radius = it.other_radius = radius;
  it.mass = it.other_mass = density * 4 / 3 * std::numbers::pi * radius * radius * radius;
  return it;
}

Encounter impact_of(const published::NormalImpact& it) {
  Encounter one =
      sphere_meets(it.pair ? Partner::grain : Partner::held_wall, 0, it.speed, it.radius, it.density);
  one.restitution = 1;
  one.steps_per_contact = 1000;
  return one;
}

Encounter normal_impact(double restitution) {
  Encounter it = sphere_meets(Partner::held_wall, 0, 3.9, 0.0025, 4000);
  it.restitution = restitution;
  it.contact_time = 1e-5;
  return it;
}

Encounter oblique_impact(double degrees) {
  Encounter it = sphere_meets(Partner::held_wall, degrees, 3.9, 0.0025, 4000);
  it.restitution = 0.98;
  it.friction = 0.092;
  it.contact_time = hertz_impact(it, 3.8e11, 0.23).duration;
  return it;
}

Encounter scaled_impact(double slip_over_mu_normal) {
  constexpr double closing = 5, friction = 0.3;
  const double tangent = friction * slip_over_mu_normal;
  Encounter it = sphere_meets(Partner::held_wall, std::atan(tangent) * 180 / std::numbers::pi,
                              closing * std::hypot(1, tangent), 1e-5, 7850);
  it.restitution = 1;
  it.friction = friction;
  it.contact_time = 1e-8;
  return it;
}

Encounter spinning_impact(double degrees) {
  return spinning(sphere_meets(Partner::held_wall, 0, 0.2, 0.1, 2700), degrees);
}

Encounter twin_impact(double spin) {
  Encounter it = spinning(sphere_meets(Partner::grain, 0, 0.4, 0.1, 2700), 0);
  const auto& [normal, tangent] = place_of(it.partner);
  it.spin = normal.cross(tangent) * spin;
  it.other_spin = -it.spin;
  return it;
}

Encounter spinning_impact_on_large(double degrees) {
  Encounter it = sphere_meets(Partner::grain, 0, 0.2, 0.1, 2700);
  it.other_radius = 0.5;
  it.other_mass *= 1000 * 125;
  return spinning(it, degrees);
}

Rebound rebound_of(const Encounter& it, const Motion& motion) {
  const auto& [normal, tangent] = place_of(it.partner);
  const Encounter after = with_motion(it, motion);
  const double slip = after.slip().dot(tangent), closing = -after.closing();
  return {after.velocity.dot(tangent), motion.spin.dot(normal.cross(tangent)), slip, closing,
          std::atan(slip / closing) * 180 / std::numbers::pi};
}

double Roll::slipping() const { return 2.0 / 7 * speed * (1 + backspin) / (friction * gravity); }
double Roll::rolling_speed() const { return speed * (5 - 2 * backspin) / 7; }

Rolled roll(const std::string& engine, const Roll& ball, double time) {
  constexpr double radius = 0.005, restitution = 0.76;
  Setup setup = box_with_gravity(engine, radius, restitution);
  EffectChoice friction = with_defaults(*find_effect("grain_friction"));
  friction.values.insert_or_assign("grain_wall", ball.friction);
  friction.values.insert_or_assign("tangential_restitution", ball.tangential_restitution);
  setup.effects.push_back(friction);
  if (ball.rolling_resistance > 0) {
    EffectChoice rolling = with_defaults(*find_effect("grain_rolling_resistance"));
    rolling.values.insert_or_assign("grain_wall", ball.rolling_resistance);
    setup.effects.push_back(rolling);
  }
  State start;
  // Hard spheres cannot lie still: this one hops, by less and less down to the height that they are left.
  const double hop = engine == "hard" ? 1e-4 : 0;
  start.position.emplace_back(0, 0, -setup.box.width[1] / 2 + radius + hop);
  start.velocity.emplace_back(ball.speed, 0, 0);
  start.spin.emplace_back(0, -ball.backspin * ball.speed / radius, 0);
  start.radius.push_back(radius);
  start.mass.push_back(4.04e-3);
  const State end = state_after(engine, setup, start, time);
  return {end.velocity[0].x(), end.spin[0].y() * radius, end.position[0].x()};
}

double Fall::mass() const { return 2600 * 4.0 / 3 * std::numbers::pi * radius * radius * radius; }

double peak_by(const std::string& engine, const Fall& ball) {
  Setup setup = box_with_gravity(engine, ball.radius, ball.restitution);
  setup.soft.contact_time = contact_time(ball);
  setup.soft.steps_per_contact = 500;
  const double floor = -setup.box.width[1] / 2;
  State start;
  start.position.emplace_back(0, 0, floor + ball.height);
  start.velocity.emplace_back(0, 0, 0);
  start.spin.emplace_back(0, 0, 0);
  start.radius.push_back(ball.radius);
  start.mass.push_back(ball.mass());
  // A little before the peak: at it the ball would rest, and the ledger's error would be one of nothing.
  const double time = (engine == "hard" ? peak_by_impacts(ball) : peak_by_spring(ball)).time - 2e-3;
  const State end = state_after(engine, setup, start, time);
  return end.position[0].z() - floor + end.velocity[0].z() * end.velocity[0].z() / (2 * gravity);
}

Peak peak_by_impacts(const Fall& ball) {
  double flights = 1;  // in times of the fall
  for (int k = 1; k <= ball.bounces; ++k)
    flights += (k < ball.bounces ? 2 : 1) * std::pow(ball.restitution, k);
  const double drop = ball.height - ball.radius;
  return {drop * std::pow(ball.restitution, 2 * ball.bounces) + ball.radius,
          flights * std::sqrt(2 * drop / gravity)};
}

Peak peak_by_spring(const Fall& ball) {
  const double duration = contact_time(ball), rate = std::numbers::pi / duration;
  const double decay = -std::log(ball.restitution) / duration;
  const double sag = gravity * ball.mass() / ball.stiffness;
  double height = ball.height, time = 0;
  for (int k = 0; k < ball.bounces; ++k) {
    const double speed = std::sqrt(2 * gravity * (height - ball.radius));
    const double sine = (speed - decay * sag) / rate;
    const auto overlap = [&](double t) {
      return std::exp(-decay * t) * (sine * std::sin(rate * t) - sag * std::cos(rate * t)) + sag;
    };
    double pressed = duration / 2, apart = 1.9 * duration;
    while (apart - pressed > 1e-15) {
      const double middle = (pressed + apart) / 2;
      (overlap(middle) > 0 ? pressed : apart) = middle;
    }
    const double leaving = std::exp(-decay * apart) * ((rate * sine + decay * sag) * std::cos(rate * apart) +
                                                       (rate * sag - decay * sine) * std::sin(rate * apart));
    height = ball.radius + leaving * leaving / (2 * gravity);
    time += speed / gravity + apart + std::abs(leaving) / gravity;
  }
  return {height, time};
}

}  // namespace shakedown
