// SPDX-License-Identifier: MIT
#include "one_impact.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "bullet_world.hpp"
#include "effects.hpp"
#include "hard_sphere_system.hpp"
#include "soft_engine.hpp"

namespace shakedown {

namespace {

constexpr double box_in_radii = 40;

/// Hertz's force as somebody would write it who adds a law of contact of his own.
const EffectRecord& hertz_law() {
  static const EffectRecord record = [] {
    EffectRecord law;
    law.name = "hertz";
    law.engines = {{"soft", {Fidelity::exact}}};
    law.apply = [](const EffectChoice& choice, int, Physics& physics) {
      const double k = choice.number("stiffness");
      physics.contact.push = [k](ContactClass, double overlap, double, double, double) {
        return k * std::pow(overlap, 1.5);
      };
      physics.contact.stored_energy = [k](ContactClass, double overlap, double, double) {
        return 0.4 * k * std::pow(overlap, 2.5);
      };
    };
    return law;
  }();
  return record;
}

bool is_free(Partner partner) { return partner == Partner::end_wall || partner == Partner::side_wall; }

double largest_radius(const Encounter& it) {
  return it.partner == Partner::grain ? std::max(it.radius, it.other_radius) : it.radius;
}

/// s until they touch.
double waiting(const Encounter& it) { return (2 + it.phase / it.steps_per_contact) * it.contact_time; }

/// The state from which they will touch after `waiting`.
State approaching(const Encounter& it) {
  const Motion motion = before(it);
  const Vec3 normal = place_of(it.partner).normal;
  State state;
  const auto put = [&](const Vec3& touching, const Vec3& velocity, const Vec3& spin, double radius,
                       double mass) {
    state.position.push_back(touching - velocity * waiting(it));
    state.velocity.push_back(velocity);
    state.spin.push_back(spin);
    state.radius.push_back(radius);
    state.mass.push_back(mass);
  };
  if (it.partner == Partner::grain) {
    put(-normal * it.radius, motion.velocity, motion.spin, it.radius, it.mass);
    put(normal * it.other_radius, motion.other_velocity, motion.other_spin, it.other_radius, it.other_mass);
  } else {
    const double room = box_in_radii / 2 * largest_radius(it) - it.radius;
    put(normal * room, motion.velocity, motion.spin, it.radius, it.mass);
  }
  return state;
}

Motion motion_of(const Encounter& it, const State& state, const State& start) {
  // Without friction spins never change, and the hard engine keeps none.
  const std::vector<Vec3>& spin = state.spin.empty() ? start.spin : state.spin;
  if (it.partner == Partner::grain) return {state.velocity[0], state.velocity[1], spin[0], spin[1]};
  return {state.velocity[0], Vec3(state.v_box, 0, 0), spin[0], Vec3::Zero()};
}

std::int64_t sum(const std::array<std::int64_t, contact_classes>& counts) {
  return counts[0] + counts[1] + counts[2];
}

Outcome by_hard(const Encounter& it, Setup setup, const State& start) {
  if (!is_free(it.partner)) {  // a box that is held has no friction there: one that nothing moves
    setup.domain = Domain::damper;
    setup.box.mass = 1e12;
  }
  HardSphereSystem system(setup, start);
  system.advance_to(setup.run.duration);
  return {motion_of(it, system.state(), start), sum(system.collisions()), 0, 0, 0};
}

Outcome by_soft(const Encounter& it, const Setup& setup, const State& start) {
  const Trajectory result = run_soft_from(start, setup);
  const State& end = result.end_state;
  Outcome outcome{motion_of(it, end, start), sum(result.collisions), 0, result.health.deepest_overlap, 0};
  // The surfaces part at the speed they have at the end: that tells when they parted.
  const Encounter after = with_motion(it, outcome.motion);
  const double apart = it.partner == Partner::grain
                           ? (end.position[1] - end.position[0]).norm() - it.radius - it.other_radius
                           : box_in_radii / 2 * largest_radius(it) - it.radius -
                                 place_of(it.partner).normal.dot(end.position[0] - Vec3(end.x_box, 0, 0));
  outcome.seconds_in_contact = setup.run.duration - waiting(it) - apart / -after.closing();
  return outcome;
}

Outcome by_bullet(const Encounter& it, const Setup& setup, const State& start) {
  constexpr int steps = 100;
  const double box_mass = setup.domain == Domain::damper ? setup.box.mass : 0;
  Bodies bodies = bodies_of(start, box_mass);
  BulletWorld world(setup, physics_of(setup), box_mass, bodies);
  Accounts accounts;
  for (int step = 0; step < steps; ++step) world.step(setup.run.duration / steps, 0, accounts);
  world.read(bodies);
  return {motion_of(it, state_of(bodies), start), sum(accounts.collisions), 0, accounts.deepest_overlap, 0};
}

}  // namespace

Place place_of(Partner partner) {
  switch (partner) {
    case Partner::grain: return {Vec3(1, 2, 2) / 3, Vec3(2, 1, -2) / 3};
    case Partner::held_wall: return {Vec3(0, 0, -1), Vec3(0.6, 0.8, 0)};
    case Partner::end_wall: return {Vec3(1, 0, 0), Vec3(0, 0.6, 0.8)};
    case Partner::side_wall: return {Vec3(0, 0, -1), Vec3(1, 0, 0)};
  }
  return {};
}

Vec3 Encounter::slip() const {
  const Vec3 normal = place_of(partner).normal;
  const Vec3 turning =
      partner == Partner::grain ? Vec3(radius * spin + other_radius * other_spin) : Vec3(radius * spin);
  const Vec3 surfaces = velocity + turning.cross(normal);
  return surfaces - surfaces.dot(normal) * normal;
}

double Encounter::reduced_mass() const {
  switch (partner) {
    case Partner::grain: return mass * other_mass / (mass + other_mass);
    case Partner::end_wall: return mass * box_mass / (mass + box_mass);
    case Partner::held_wall:
    case Partner::side_wall: return mass;
  }
  return 0;
}

Vec3 Encounter::tangential_mass() const {
  if (partner == Partner::grain) return Vec3::Constant(reduced_mass() / 3.5);
  Vec3 felt = Vec3::Constant(mass / 3.5);
  if (partner == Partner::side_wall) felt.x() = 1 / (3.5 / mass + 1 / box_mass);
  return felt;
}

Encounter meets(Partner partner, double degrees, double speed) {
  const Place place = place_of(partner);
  const double angle = degrees * std::numbers::pi / 180;
  Encounter it;
  it.partner = partner;
  it.velocity = speed * (std::cos(angle) * place.normal + std::sin(angle) * place.tangent);
  return it;
}

Motion before(const Encounter& it) {
  if (it.partner != Partner::grain) return {it.velocity, Vec3::Zero(), it.spin, Vec3::Zero()};
  const double share = it.other_mass / (it.mass + it.other_mass);  // their centre rests
  return {it.velocity * share, it.velocity * (share - 1), it.spin, it.other_spin};
}

Encounter with_motion(Encounter it, const Motion& motion) {
  it.velocity = motion.velocity - motion.other_velocity;
  it.spin = motion.spin;
  it.other_spin = motion.other_spin;
  return it;
}

double energy_of(const Encounter& it, const Motion& motion) {
  const auto sphere = [](double mass, double radius, const Vec3& velocity, const Vec3& spin) {
    return mass * (velocity.squaredNorm() / 2 + 0.2 * radius * radius * spin.squaredNorm());
  };
  const double first = sphere(it.mass, it.radius, motion.velocity, motion.spin);
  if (it.partner == Partner::grain)
    return first + sphere(it.other_mass, it.other_radius, motion.other_velocity, motion.other_spin);
  return is_free(it.partner) ? first + it.box_mass * motion.other_velocity.squaredNorm() / 2 : first;
}

Motion pushed(const Encounter& it, const Vec3& across) {
  const Vec3 normal = place_of(it.partner).normal;
  const Vec3 impulse = across - it.reduced_mass() * (1 + it.restitution) * it.closing() * normal;
  Motion after = before(it);
  after.velocity += impulse / it.mass;
  after.spin += normal.cross(across) * (2.5 / (it.mass * it.radius));
  if (it.partner == Partner::grain) {
    after.other_velocity -= impulse / it.other_mass;
    after.other_spin += normal.cross(across) * (2.5 / (it.other_mass * it.other_radius));
  } else if (is_free(it.partner)) {
    after.other_velocity.x() -= impulse.x() / it.box_mass;  // guided along x
  }
  return after;
}

Motion with_slip_left(const Encounter& it, double share) {
  return pushed(it, (share - 1) * it.tangential_mass().cwiseProduct(it.slip()));
}

Motion by_rigid_bodies(const Encounter& it) {
  const Vec3 needed = -(1 + it.tangential_restitution) * it.tangential_mass().cwiseProduct(it.slip());
  const double allowed = it.friction * it.reduced_mass() * (1 + it.restitution) * it.closing();
  return pushed(it, needed.norm() <= allowed ? needed : Vec3(needed * (allowed / needed.norm())));
}

double by_tangential_spring(const Encounter& it) {
  const Vec3 slipping = it.slip();
  const double before = slipping.norm(), duration = it.contact_time, mass = it.reduced_mass();
  if (before == 0 || it.friction == 0) return 1;
  const double felt = it.tangential_mass().cwiseProduct(slipping).norm() / before;
  const double decay = -std::log(it.restitution) / duration, rate = std::numbers::pi / duration;
  const double stiffness = mass * (rate * rate + decay * decay);
  const double across = -std::log(std::max(it.tangential_restitution, 1e-4)) / duration;
  const double dashpot = 4.0 / 7 * mass * across,
               spring = it.stiffness_ratio * stiffness + 2.0 / 7 * mass * across * across;
  constexpr int steps = 10000;
  const double step = duration / steps;
  double slip = before, stretch = 0;
  for (int k = 0; k < steps; ++k) {
    const double time = (k + 0.5) * step;
    const double overlap = it.closing() / rate * std::exp(-decay * time) * std::sin(rate * time);
    stretch += slip * step / 2;
    const double wanted = -spring * stretch - dashpot * slip;
    const double most = it.friction * stiffness * overlap;
    const double force = std::clamp(wanted, -most, most);
    if (force != wanted) {  // slides: the spring keeps what its share of the force stands for
      const double of_spring = force + dashpot * slip;
      stretch = of_spring * force <= 0 ? 0 : -of_spring / spring;
    }
    slip += force / felt * step;
    stretch += slip * step / 2;
  }
  return slip / before;
}

Setup setup_of(const Encounter& it) {
  Setup setup;
  setup.domain = is_free(it.partner) ? Domain::damper : Domain::closed;
  setup.box.mass = it.box_mass;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = box_in_radii * largest_radius(it);
  setup.spring.frequency = 1e-6;  // so weak that it does nothing during an impact
  setup.release.displacement = 0;
  setup.grains.count = it.partner == Partner::grain ? 2 : 1;
  setup.grains.diameter = 2 * largest_radius(it);
  setup.grains.mass = it.mass;
  setup.restitution.grain_grain = setup.restitution.grain_wall = it.restitution;
  setup.soft.contact_time = it.contact_time;
  setup.soft.steps_per_contact = it.steps_per_contact;
  setup.run.duration = 2 * waiting(it) + 1.5 * it.contact_time;
  setup.run.sample_rate = 1 / setup.run.duration;
  if (it.friction > 0) {
    EffectChoice friction = with_defaults(*find_effect("grain_friction"));
    friction.values.insert_or_assign("grain_grain", it.friction);
    friction.values.insert_or_assign("grain_wall", it.friction);
    friction.values.insert_or_assign("tangential_restitution", it.tangential_restitution);
    friction.values.insert_or_assign("stiffness_ratio", it.stiffness_ratio);
    setup.effects.push_back(friction);
  }
  if (it.rolling_resistance > 0) {
    EffectChoice rolling = with_defaults(*find_effect("grain_rolling_resistance"));
    rolling.values.insert_or_assign("grain_grain", it.rolling_resistance);
    rolling.values.insert_or_assign("grain_wall", it.rolling_resistance);
    setup.effects.push_back(rolling);
  }
  if (it.hertz_stiffness > 0) {
    EffectChoice hertz{&hertz_law(), {}, {}};
    hertz.values.insert_or_assign("stiffness", it.hertz_stiffness);
    setup.effects.push_back(hertz);
  }
  return setup;
}

Outcome impact_by(const std::string& engine, const Encounter& it) {
  const Setup setup = setup_of(it);
  const State start = approaching(it);
  Outcome outcome = engine == "hard"   ? by_hard(it, setup, start)
                    : engine == "soft" ? by_soft(it, setup, start)
                                       : by_bullet(it, setup, start);
  outcome.energy_gained = energy_of(it, outcome.motion) / energy_of(it, before(it)) - 1;
  return outcome;
}

}  // namespace shakedown
