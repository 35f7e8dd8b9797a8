// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "audit.hpp"
#include "setup.hpp"

namespace shakedown {

struct ReleaseScale {
  double value;  ///< recorded displacement at release over the setup's, less one
  double error;  ///< standard error
};

/// How much too long the camera records lengths, by the box alone before it has moved: the setup says where
/// that was. From the first 20 ms of each run, x = x0 + b t^2; none when no run has enough frames there.
std::optional<ReleaseScale> scale_at_release(const Setup& setup, const Experiment& experiment,
                                             const Audit& audit, std::span<const EffectRecord* const> known);

}  // namespace shakedown
