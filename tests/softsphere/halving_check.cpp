// SPDX-License-Identifier: MIT
#include "halving_check.hpp"

#include <algorithm>
#include <cmath>

#include "soft_engine.hpp"
#include "spring_dashpot.hpp"

namespace shakedown {

HalvingCheck halving_check(const Setup& setup, double duration, const RunOptions& options) {
  Setup finer = setup;
  finer.run.duration = std::min(duration, setup.run.duration);
  std::array<Trajectory, 3> runs;
  HalvingCheck check;
  for (std::size_t k = 0; k < 3; ++k) {
    runs[k] = make_soft_engine()->run(finer, options);
    if (k == 0)
      check.steps_per_contact =
          setup.soft.contact_time * static_cast<double>(runs[0].events) / runs[0].end_time;
    // Twice the steps that were taken, not that were asked for: samples fall on steps.
    finer.soft.steps_per_contact =
        2 * setup.soft.contact_time * static_cast<double>(runs[k].events) / runs[k].end_time;
  }
  check.predicted_restitution_error = predicted_restitution_error(check.steps_per_contact);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < std::min(runs[k].x_box.size(), runs[k + 1].x_box.size()); ++i)
      check.change_of_box[k] =
          std::max(check.change_of_box[k], std::abs(runs[k].x_box[i] - runs[k + 1].x_box[i]));
    for (std::size_t kind = 0; kind < contact_classes; ++kind)
      check.change_of_loss[k] =
          std::max(check.change_of_loss[k],
                   std::abs(runs[k].ledger.contact_loss[kind] - runs[k + 1].ledger.contact_loss[kind]) /
                       runs[0].initial_energy);
  }
  return check;
}

}  // namespace shakedown
