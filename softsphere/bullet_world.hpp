// SPDX-License-Identifier: MIT
// Grains and box as rigid bodies in a Bullet world of their own. Nothing process-wide in Bullet is touched,
// so worlds in several threads do not see each other.
#pragma once
#include <memory>

#include "accounts.hpp"
#include "bodies.hpp"

namespace shakedown {

class BulletWorld {
 public:
  /// `box_mass` 0: the box is held still.
  BulletWorld(const Setup& setup, const Physics& physics, double box_mass, const Bodies& bodies);
  ~BulletWorld();

  /// One step of Bullet: finds contacts, resolves them, moves everything in straight lines. Work and first
  /// touches by class go into the accounts. `force_on_box`, N, acts on the box during the step (Bullet's own
  /// semi-implicit Euler).
  void step(double seconds, double force_on_box, Accounts& accounts);

  void read(Bodies& bodies) const;       ///< copies places, velocities and spins out of Bullet
  void write_box(const Bodies& bodies);  ///< copies place and velocity of the box into Bullet
  bool box_sleeps() const;               ///< whether Bullet has put the box to sleep

 private:
  /// Copies places, velocities and spins of the grains into Bullet.
  void write_grains(const Bodies& bodies);
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace shakedown
