// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "damper_state.hpp"

namespace shakedown {

/// The version of both files; it rises when a key or a column changes its meaning.
constexpr int command_format = 1;

/// Returns the number of rows that are asked for: at 0, 1/rate, 2/rate ... up to the duration.
std::size_t command_rows(const Setup& setup);

/// Returns what an outside code is asked, as JSON in SI. Effects that every engine has, because they are in
/// the first state, the masses or the camera, are not listed.
std::string command_question(const Setup& setup, const Physics& physics, const State& initial, int run);

}  // namespace shakedown
