// SPDX-License-Identifier: MIT
// Contacts of a soft run: which exist, their geometry, and with what weight their forces enter the coming
// half kick.
#pragma once
#include <vector>

#include "accounts.hpp"
#include "bodies.hpp"
#include "neighbours.hpp"
#include "spring_dashpot.hpp"

namespace shakedown {

struct Contact {
  std::uint64_t key = 0;  ///< order in which forces are summed: pairs by (i, j), then walls by (grain, wall)
  int i = 0, j = 0;       ///< j is the box when it is the number of grains
  ContactClass kind = ContactClass::grain_grain;
  Vec3 normal = Vec3::Zero();  ///< unit, from j to i
  double overlap = 0;          ///< m, negative: a gap bridged by attraction
  double reduced_mass = 0;     ///< kg
  double closing_speed = 0;    ///< m/s, at first touch
  double friction = 0;         ///< Coulomb coefficient of the slip at first touch
  SpringDashpot spring;
  bool touching = false;
  bool over = false;  ///< separated in this step; leaves after the closing half kick
  // Weights in the coming half kick.
  double dashpot = 1;
  double attraction = 0;
  Vec3 stretch = Vec3::Zero();  ///< m, of the tangential spring
  // Forces found at the last evaluation.
  double normal_force = 0;               ///< N, on i along the normal
  double elastic_force = 0;              ///< N, the share of overlap alone in it
  Vec3 tangential_force = Vec3::Zero();  ///< N, on i
  Vec3 rolling_torque = Vec3::Zero();    ///< N m, on i; on j the opposite
  bool sliding = false;                  ///< the tangential force is at its limit
};

/// What contacts of one run share.
struct ContactModel {
  ContactLaw law;
  double contact_time = 0;  ///< s
  double box_mass = 0;      ///< kg; 0: held still
  double length = 0;        ///< m, inner size of the box
  std::array<double, 2> width{};
};

struct FoundContacts {
  std::vector<Contact> contacts;                        ///< in order of their keys
  std::array<std::int64_t, contact_classes> touches{};  ///< first touches among them
  double deepest_overlap = 0;                           ///< m
};

/// The contacts after a drift of `step` seconds. `before` are those of the step before; those that have
/// separated come back marked `over`. `memory` is taken over for the answer.
///
/// Why weights: the dashpot force jumps at touch and at separation, and a Verlet step that samples it in full
/// makes a random first-order error in the restitution. The trapezoid rule over the part of the step in
/// contact is second order: with a fraction f of the step in contact the closing half kick counts the dashpot
/// 2 f times when the contact begins and 2 f - 1 times when it ends (the opening half kick having counted it
/// once).
FoundContacts find_contacts(const ContactModel& model, const Bodies& bodies, const std::vector<Pair>& pairs,
                            double step, const std::vector<Contact>& before, FoundContacts memory = {});

/// Puts all weights to those of an opening half kick and drops the contacts that are over.
void settle_contacts(std::vector<Contact>& contacts);

/// Energy stored in springs and attraction, J.
double stored_energy(const ContactModel& model, const Contact& contact);

}  // namespace shakedown
