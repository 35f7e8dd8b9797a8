// SPDX-License-Identifier: MIT
#pragma once
#include <array>

#include "engine.hpp"

namespace shakedown {

/// What changes when the step of engine "soft" is halved, and halved again, over a time short enough that
/// chaos has not amplified the difference (0.05 s in the paper's damper; after 0.2 s even rounding shows).
struct HalvingCheck {
  double steps_per_contact = 0;            ///< taken by the setup as it stands
  double predicted_restitution_error = 0;  ///< largest over all phases of first touch
  std::array<double, 2> change_of_box{};   ///< m, largest |x_box| difference: step to half, half to a quarter
  std::array<double, 2>
      change_of_loss{};  ///< of E0, largest difference of the energy lost by any class at the end
};

HalvingCheck halving_check(const Setup& setup, double duration = 0.05, const RunOptions& options = {});

}  // namespace shakedown
