// SPDX-License-Identifier: MIT
// Checks lengths of boxes against the layer of grains in them: a run filed under a wrong length, runs
// swapped.
#pragma once
#include <string>
#include <vector>

#include "experiment.hpp"

namespace shakedown {

/// Returns notes on runs whose length does not fit their layer. While the grains lie packed at an end wall
/// their centre is L/2 - h from the box's; h, half the layer's thickness, is the same in all runs with the
/// same grains. `setups` are those of the runs. At least three runs with the same grains are needed.
std::vector<std::string> notes_on_layers(const Experiment& experiment, const std::vector<Setup>& setups);

}  // namespace shakedown
