// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <string_view>

#include "engine.hpp"

namespace shakedown {

/// Any program as an engine: "command:./my_code --its-option". It is run as
///     ./my_code --its-option SETUP.json MOTION.csv
/// without a shell, reads the first and writes the second; harness/outside/README.md is what it has to do.
/// What it answers is checked: times, columns, finite numbers, the first state. Domains: damper and closed.
/// What it does not tell is NaN, its collisions are -1.
constexpr std::string_view command_prefix = "command:";

/// Makes the engine of this name, which begins with the prefix. Throws InputError when no program is named.
std::unique_ptr<Engine> make_command_engine(std::string_view name);

}  // namespace shakedown
