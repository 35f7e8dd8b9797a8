// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>

namespace shakedown {

/// Lets Ctrl-C (and SIGTERM) only raise the returned flag from now on, so that what is done can be kept; a
/// second one ends the program at once.
const std::atomic<bool>* catch_interruption();

}  // namespace shakedown
