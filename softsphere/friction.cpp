// SPDX-License-Identifier: MIT
#include "friction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace shakedown {

namespace {
double tangential_damping(const ContactModel& model, const Contact& contact) {
  const double restitution = std::clamp(model.law.tangential_restitution, 1e-4, 1.0);
  return -2 * (2.0 / 7) * contact.reduced_mass * std::log(restitution) / model.contact_time;
}
}  // namespace

double tangential_stiffness(const Contact& contact) { return 2.0 / 7 * contact.spring.stiffness; }

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
  const double coefficient = model.law.friction[static_cast<std::size_t>(contact.kind)];
  if (!contact.touching || coefficient == 0) return;
  Vec3 force = -tangential_stiffness(contact) * contact.stretch;
  const double damping = tangential_damping(model, contact);
  if (damping > 0) force -= contact.dashpot * damping * slip_velocity(bodies, contact);
  // Attraction does not press: without it the normal force is what the spring and dashpot make.
  const double pressing = contact.normal_force + contact.attraction * model.law.attraction_force;
  const double limit = coefficient * std::max(pressing, 0.0);
  const double size = force.norm();
  contact.sliding = size > limit;
  contact.tangential_force = contact.sliding ? Vec3(force * (limit / size)) : force;
}

void let_slide(Contact& contact) {
  // A spring on its way back is held by the dashpot with less than its own force, and does not slide for that.
  if (!contact.touching || !contact.sliding) return;
  const double stiffness = tangential_stiffness(contact);
  const double held = contact.tangential_force.norm() / stiffness;
  const double length = contact.stretch.norm();
  // Only shortened: a dashpot's share of the force must not lengthen the spring.
  if (held < length) contact.stretch *= held / length;
}

}  // namespace shakedown
