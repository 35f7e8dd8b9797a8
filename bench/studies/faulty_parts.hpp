// SPDX-License-Identifier: MIT
// Faulty parts handed to a diagnosis from outside, one at a time: a study is worth something when its figures
// notice them.
#pragma once
#include <array>
#include <memory>
#include <string_view>

#include "trial.hpp"

namespace shakedown {

/// no-refit: the user's restitutions and frequency are taken for the truth. no-centre: the grains' positions
/// are lost. wrong-sign: an engine in which grains become harder where they should become softer.
/// smoothed: a tracker that averages over 25 frames and does not say so.
constexpr std::array<std::string_view, 5> fault_names{"none", "no-refit", "no-centre", "wrong-sign",
                                                      "smoothed"};

/// Makes an engine that runs the setup with the restitution of grain on grain on the other side of the user's
/// own.
std::unique_ptr<Engine> with_mirrored_restitution(const Engine& engine, double believed);

/// Puts the faulty part of this name into `tools`, for as long as it lives.
class FaultyParts {
 public:
  FaultyParts(std::string_view fault, const Setup& believed, TrialTools& tools);

 private:
  std::unique_ptr<Engine> engine_;
};

}  // namespace shakedown
