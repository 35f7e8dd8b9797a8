// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>

namespace shakedown {

/// Says on how many threads to work and who may stop the work. No result depends on either.
struct Execution {
  int threads = 0;                          ///< 0: one for each core
  const std::atomic<bool>* stop = nullptr;  ///< set to true (by a signal handler, say) to stop; may be null

  /// Tells whether somebody has stopped the work.
  bool stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
};

}  // namespace shakedown
