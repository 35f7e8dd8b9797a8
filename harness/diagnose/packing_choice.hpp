// SPDX-License-Identifier: MIT
#pragma once
#include "audit.hpp"
#include "setup.hpp"

namespace shakedown {

/// The grains' centre in the box before anything has moved tells the packing: the arrangements differ by
/// millimetres. A camera's bias or scale shortens all distances by the same share, which box lengths tell
/// from a packing. The setup's own where it is near enough, or where nothing was measured.
Packing packing_before_release(const Setup& setup, const Experiment& experiment, const Audit& audit,
                               std::span<const EffectRecord* const> known);

}  // namespace shakedown
