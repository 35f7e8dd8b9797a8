// SPDX-License-Identifier: MIT
// Says how many simulations a ranking of effects takes.
#pragma once

namespace shakedown {

/// Numbers of simulations of each different setup of a candidate at each level, by what a run costs.
struct LevelEffort {
  int plain, slow, dear;
};

/// Numbers of simulations of each different setup.
struct ScreenEffort {
  int slopes = 64;                 ///< for what the fitted parameters do, beside those that fits have made
  int nothing = 96;                ///< of the model without candidates
  int nothing_more = 128;          ///< of it, beside those that fits have made
  LevelEffort glance{12, 8, 8};    ///< of every candidate
  LevelEffort look{24, 16, 12};    ///< more, of those that a glance leaves open
  LevelEffort decide{96, 32, 24};  ///< more, of those about which that does not decide
  bool middle_alone = false;       ///< of each sign, where that can be simulated
};

}  // namespace shakedown
