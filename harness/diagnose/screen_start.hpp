// SPDX-License-Identifier: MIT
// Says what a ranking of effects begins with.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "emulator.hpp"
#include "refit_result.hpp"

namespace shakedown {

/// Holds what the fit of the model without candidates has found already; where it is empty the screen
/// simulates.
struct ScreenStart {
  /// Covariances of each measured run's features, m^2: by which changes of the means are looked for, and by
  /// which a run is likely.
  std::vector<Eigen::MatrixXd> for_means{}, likeliest{};
  /// Straight emulators about the fitted values, by these knobs' widths.
  std::vector<Emulator> emulators{};
  std::vector<Knob> knobs{};
};

/// Returns what the screen of the model at `knobs`, where this fit has put it, need not simulate again.
ScreenStart start_from(const Refit& fit, const std::vector<Knob>& knobs);

}  // namespace shakedown
