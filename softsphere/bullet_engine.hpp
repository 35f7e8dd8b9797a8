// SPDX-License-Identifier: MIT
#pragma once
#include <memory>

#include "engine.hpp"

namespace shakedown {

/// Engine "bullet": Bullet's own rigid bodies and impulse solver, the result that a user of Bullet would
/// get. With the settings that make its restitution right (no speculative contacts, no energy from overlap
/// correction, no sleeping) binary impacts are exact; simultaneous ones are not. With bullet.defaults = true
/// the settings are as Bullet ships them, to show what that does: slow impacts do not bounce, fast ones
/// bounce too much, and the box falls asleep off centre. Domains: damper and closed.
std::unique_ptr<Engine> make_bullet_engine();

}  // namespace shakedown
