// SPDX-License-Identifier: MIT
// Keeps recordings under the digest of setup and run, so that diagnoses of many experiments that begin with
// one setup simulate its ensemble once. What a diagnosis answers does not depend on what is kept.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "camera.hpp"
#include "setup.hpp"

namespace shakedown {

/// Keeps recordings for all who share it.
class EnsembleCache {
 public:
  /// Returns the recording of run number `run` of the setup, from what is kept or from `simulate`; it is at
  /// least as long as the setup's duration. May be called from many threads.
  std::shared_ptr<const Recording> recording(const Setup& setup, int run,
                                             const std::function<Recording()>& simulate);

  /// Returns how many recordings came from what is kept instead of a simulation.
  std::int64_t reused() const { return reused_; }

 private:
  struct Kept {
    double duration;  // s
    std::shared_ptr<const Recording> recording;
  };
  std::mutex mutex_;
  std::map<std::string, Kept> kept_;
  std::int64_t reused_ = 0;
};

}  // namespace shakedown
