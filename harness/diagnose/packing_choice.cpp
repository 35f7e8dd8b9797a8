// SPDX-License-Identifier: MIT
#include "packing_choice.hpp"

#include <algorithm>
#include <cmath>

#include "experiment_file.hpp"
#include "initial_state.hpp"

namespace shakedown {

namespace {

/// Farther than this from the grains' centre of a packing (m) lies another. Layers are the same in every run,
/// grains laid at random are not.
double other_than(Packing packing) {
  return packing == Packing::random || packing == Packing::spread ? 2.5e-3 : 0.5e-3;
}

/// Where the grains' centre of a measured run lies in the box before anything has moved.
struct ReleasedCentre {
  std::size_t run;
  double apart;  ///< m, x_com - x_box
};

std::vector<ReleasedCentre> released_centres(const Experiment& experiment, const Audit& audit) {
  constexpr double still = 0.03;  // s
  std::vector<ReleasedCentre> list;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    const MeasuredRun& run = experiment.runs[r];
    if (!run.has_com()) continue;
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < run.time.size() && run.time[i] < still; ++i)
      if (const double apart = audit.runs[r].x_com[i] - audit.runs[r].x_box[i]; std::isfinite(apart))
        sum += apart, ++count;
    if (count >= 3) list.push_back({r, sum / count});
  }
  return list;
}

/// rms of measured - scale * modelled, m. The scale is free within a tenth where box lengths tell it.
double misfit_up_to_scale(const std::vector<ReleasedCentre>& measured, const std::vector<double>& modelled) {
  double cross = 0, square = 0, low = 1e9, high = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    cross += measured[i].apart * modelled[i];
    square += modelled[i] * modelled[i];
    low = std::min(low, modelled[i]), high = std::max(high, modelled[i]);
  }
  const double scale = high - low > 0.01 && square > 0 ? std::clamp(cross / square, 0.88, 1.1) : 1.0;
  double squares = 0;
  for (std::size_t i = 0; i < measured.size(); ++i)
    squares += std::pow(measured[i].apart - scale * modelled[i], 2);
  return std::sqrt(squares / static_cast<double>(measured.size()));
}

}  // namespace

PackingChoice packing_before_release(const Setup& given, const Experiment& experiment, const Audit& audit,
                                     std::span<const EffectRecord* const> known) {
  PackingChoice best{given.release.packing};
  if (!given.release.initial_grains.empty() || given.grains.count == 0) return best;
  const std::vector<ReleasedCentre> measured = released_centres(experiment, audit);
  if (measured.empty()) return best;
  const auto misfit_of = [&](Packing packing) {
    Setup setup = given;
    setup.release.packing = packing;
    std::vector<double> modelled;
    const std::vector<Setup> setups = setups_of_runs(setup, experiment, known);
    for (const ReleasedCentre& centre : measured) {
      const State state = initial_state(setups[centre.run]);
      modelled.push_back(centre_of_mass_x(state) - state.x_box);
    }
    return misfit_up_to_scale(measured, modelled);
  };
  best.apart = misfit_of(best.packing);
  if (best.apart < other_than(Packing::fcc)) return best;
  double least = best.apart / 2;
  best.fits = best.apart < other_than(best.packing);
  for (const Packing packing : {Packing::fcc, Packing::square, Packing::random, Packing::spread}) {
    const double misfit = misfit_of(packing);
    if (misfit >= least || misfit >= other_than(packing)) continue;
    best = {packing, misfit};
    least = misfit;
  }
  return best;
}

}  // namespace shakedown
