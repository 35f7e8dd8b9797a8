// SPDX-License-Identifier: MIT
// Contacts of a soft run: which exist, their geometry, and with what weight their forces enter the coming
// half kick.
#pragma once
#include <vector>

#include "accounts.hpp"
#include "contact.hpp"
#include "neighbours.hpp"

namespace shakedown {

struct FoundContacts {
  std::vector<Contact> contacts;                        ///< in order of their keys
  std::array<std::int64_t, contact_classes> touches{};  ///< first touches among them
  double deepest_overlap = 0;                           ///< m
};

/// Returns the contacts after a drift of `step` seconds. `before` are those of the step before; those that
/// have separated come back marked `over`. The answer is built in the memory of `memory`.
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

/// Returns the energy stored in springs and attraction, J.
double stored_energy(const ContactModel& model, const Contact& contact);

}  // namespace shakedown
