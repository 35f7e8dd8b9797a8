// SPDX-License-Identifier: MIT
#pragma once
#include <memory>

#include "engine.hpp"

namespace shakedown {

/// Exact event-driven inelastic hard spheres in a box on a spring (the paper's model, made exact). Promises:
/// energy plus ledger constant to 1e-12 of E0 over 30 s, deepest overlap <= 1e-12 m, momentum to 1e-12 of M
/// Omega Delta0.
std::unique_ptr<Engine> make_hard_engine();

}  // namespace shakedown
