// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>

namespace shakedown {

/// From now on Ctrl-C (and SIGTERM) only raises the returned flag, so that what is done can be kept; a
/// second one ends the program at once.
const std::atomic<bool>* catch_interruption();

}  // namespace shakedown
