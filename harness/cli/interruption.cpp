// SPDX-License-Identifier: MIT
#include "interruption.hpp"

#include <csignal>

#include "packing.hpp"

namespace shakedown {

namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void raise_flag(int signal) {
  stop = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>* catch_interruption() {
  stop_packing_when(&stop);
  std::signal(SIGINT, raise_flag);
  std::signal(SIGTERM, raise_flag);
  return &stop;
}

}  // namespace shakedown
