// SPDX-License-Identifier: MIT
// Recordings kept by the digest of setup and run: diagnoses of many experiments that begin with one setup
// simulate its ensemble once. What a diagnosis answers does not depend on what is kept.
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

class EnsembleCache {
 public:
  /// The recording of run `run` of the setup, from what is kept or from `simulate`; at least as long as the
  /// setup's duration. May be called from many threads.
  std::shared_ptr<const Recording> recording(const Setup& setup, int run,
                                             const std::function<Recording()>& simulate);

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
