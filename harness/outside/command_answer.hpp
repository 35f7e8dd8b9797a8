// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <string>

#include "damper_state.hpp"
#include "trajectory.hpp"

namespace shakedown {

/// Reads the table that an outside code wrote, checked against what was asked. Throws PhysicsError that
/// begins with `who` and names line, column, what is wrong and what is expected.
Trajectory command_answer(const std::filesystem::path& table, const std::string& who, const Setup& setup,
                          const Physics& physics, const State& initial);

}  // namespace shakedown
