// SPDX-License-Identifier: MIT
#pragma once
#include <memory>

#include "engine.hpp"

namespace shakedown {

/// Engine "apart": the damper and its effects coded a second time, for laboratories whose diagnosis must not
/// share their code. Springs that latch in place of dashpots, the midpoint rule in place of Verlet's,
/// implicit drags, a neighbour search of its own; README.md. It shares the setup and the first state with the
/// others and no code with engines or effects. Domains: damper and closed. Contacts last soft.contact_time,
/// steps are soft.contact_time / soft.steps_per_contact or shorter.
std::unique_ptr<Engine> make_apart_engine();

}  // namespace shakedown
