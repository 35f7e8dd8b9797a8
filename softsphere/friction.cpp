// SPDX-License-Identifier: MIT
#include "friction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace shakedown {

namespace {
/// Returns the rate, 1/s, by which the dashpot reduces the slip of a contact that sticks to the tangential
/// restitution.
double tangential_decay(const ContactModel& model) {
  return -std::log(std::clamp(model.law.tangential_restitution, 1e-4, 1.0)) / model.contact_time;
}

double tangential_stiffness(const ContactModel& model, const Contact& contact) {
  const double decay = tangential_decay(model);
  const double as_stiff = model.law.stiffness_ratio / ContactLaw::turning_ratio;
  return ContactLaw::turning_ratio *
         (as_stiff * contact.spring.stiffness + contact.reduced_mass * decay * decay);
}

/// Returns the force of the dashpot against the slip, N, with its weight in the coming half kick.
Vec3 dashpot_force(const ContactModel& model, const Bodies& bodies, const Contact& contact) {
  const double damping = 2 * ContactLaw::turning_ratio * contact.reduced_mass * tangential_decay(model);
  if (damping == 0) return Vec3::Zero();
  return -contact.dashpot * damping * slip_velocity(bodies, contact);
}
}  // namespace

double energy_of_stretch(const ContactModel& model, const Contact& contact) {
  return tangential_stiffness(model, contact) * contact.stretch.squaredNorm() / 2;
}

double lever_of_first(const Bodies& bodies, const Contact& contact) {
  const double shared = contact.kind == ContactClass::grain_grain ? contact.overlap / 2 : contact.overlap;
  return bodies.radius(contact.i) - shared;
}

double lever_of_second(const Bodies& bodies, const Contact& contact) {
  return contact.kind == ContactClass::grain_grain ? bodies.radius(contact.j) - contact.overlap / 2 : 0.0;
}

Vec3 slip_velocity(const Bodies& bodies, const Contact& contact) {
  Vec3 velocity = bodies.velocity_of(contact.i) - bodies.velocity_of(contact.j);
  velocity -= lever_of_first(bodies, contact) * bodies.spin_of(contact.i).cross(contact.normal);
  if (contact.kind == ContactClass::grain_grain)
    velocity -= lever_of_second(bodies, contact) * bodies.spin_of(contact.j).cross(contact.normal);
  return velocity - velocity.dot(contact.normal) * contact.normal;
}

bool rubs(const ContactModel& model, const Contact& contact) { return model.law.rubs(contact.kind); }

void stretch_tangentially(const Bodies& bodies, double time, Contact& contact) {
  if (!contact.touching) {
    contact.stretch.setZero();
    return;
  }
  const double length = contact.stretch.norm();
  Vec3 turned = contact.stretch - contact.stretch.dot(contact.normal) * contact.normal;
  const double turned_length = turned.norm();
  if (turned_length > 0) turned *= length / turned_length;
  contact.stretch = turned + slip_velocity(bodies, contact) * time;
}

void set_friction(const ContactModel& model, const Bodies& bodies, Contact& contact) {
  contact.tangential_force.setZero();
  contact.sliding = false;
  if (!contact.touching || !rubs(model, contact)) return;
  const Vec3 force =
      -tangential_stiffness(model, contact) * contact.stretch + dashpot_force(model, bodies, contact);
  const double limit = contact.friction * std::max(contact.elastic_force, 0.0);
  const double size = force.norm();
  contact.sliding = size > limit;
  contact.tangential_force = contact.sliding ? Vec3(force * (limit / size)) : force;
}

void let_slide(const ContactModel& model, const Bodies& bodies, Contact& contact) {
  if (!contact.touching || !contact.sliding) return;
  const Vec3 of_spring = contact.tangential_force - dashpot_force(model, bodies, contact);
  // A dashpot that alone exceeds the limit must not stretch the spring the other way.
  if (of_spring.dot(contact.tangential_force) <= 0)
    contact.stretch.setZero();
  else
    contact.stretch = -of_spring / tangential_stiffness(model, contact);
}

}  // namespace shakedown
