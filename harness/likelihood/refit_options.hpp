// SPDX-License-Identifier: MIT
// Says how much a fit of a model's numbers simulates, and what it is judged by.
#pragma once
#include <algorithm>
#include <limits>

#include "refit_result.hpp"

namespace shakedown {

/// Simulations of each different setup in a round that only finds the way: half of those of the round that
/// judges, and `fewest_on_the_way` at least (an assumption).
constexpr int fewest_on_the_way = 64;
constexpr int simulations_on_the_way(int count) { return std::max(fewest_on_the_way, count / 2); }

/// Says how a fit is made; numbers of simulations are of each different setup.
struct RefitOptions {
  int count = 192;       ///< simulations in the last round; simulations_on_the_way() of it before
  int rounds = 2;        ///< re-centrings
  int most_rounds = 4;   ///< when the solution keeps leaving the box
  int most_looks = 2;    ///< again, as look_again_below and look_beside_below ask for them
  int first_run = 1000;  ///< addresses the random numbers of the simulations
  /// What two codes of the same physics differ by where restitutions are free, in parts of the release
  /// displacement. In the paper's damper at 40, 65 and 104 mm, soft contacts (0.15, 0.3 and 0.4 ms; means of
  /// 48 runs) less hard impacts (of 200), restitutions moved by -0.013 and 0.024 at most, leave 0.03 to 0.04,
  /// 0.04 to 0.07 and 0.07 to 0.15 mm of the box, most of it the noise of those means.
  double model_error = 5e-4;
  const Refit* judged_by = nullptr;  ///< a fit to the same measured runs; null: by itself
  /// Simulations of each different setup at the solution, which then move it to the minimum that they and the
  /// emulator's slopes show, and judge it: its chi2, errors, p-value and cells. An emulator that cannot
  /// follow the model takes its own misfit for chaos, and where the model is wrong it promises too much. 0:
  /// the emulator judges.
  int confirming = 0;
  /// Where the emulator promised much more than the simulations at the solution confirm, the fit looks again
  /// in a narrower box, if what was promised is below this judged_chi2.
  double look_again_below = std::numeric_limits<double>::infinity();
  /// Misfit over that of the model's own runs where the fit begins, as simulations there have shown it. Where
  /// the fit ends with clearly more, its emulator has led it away, and it looks again about its beginning, in
  /// narrower boxes. Infinite: nobody has looked.
  double scatter_at_start = std::numeric_limits<double>::infinity();
  /// At this p-value or below, where the misfit is not gross, the fit looks again on both sides along the
  /// direction that is known least, and keeps the best, because the emulator of a valley is noisy.
  double look_beside_below = 0;
};

}  // namespace shakedown
