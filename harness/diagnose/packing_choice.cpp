// SPDX-License-Identifier: MIT
#include "packing_choice.hpp"

#include <algorithm>
#include <cmath>

#include "initial_state.hpp"
#include "running_statistic.hpp"

namespace shakedown {

namespace {

/// How far from where a packing has the grains' centre (m, standard deviation) grains of that packing may be
/// laid, at least: another hand, or another program, lays them otherwise.
constexpr double layers_within = 0.25e-3, loose_within = 1.25e-3;

bool is_loose(Packing packing) { return packing == Packing::random || packing == Packing::spread; }

/// Says where a packing has the grains' centre before release.
struct LaidCentre {
  double apart;   ///< m, x_com - x_box
  double within;  ///< m, standard deviation
};

/// Returns where the setup's packing has the centre. Layers are the same in every run; of grains laid at
/// random each run is one draw among many.
LaidCentre laid_centre(const Setup& setup) {
  const auto apart = [&](int run) {
    const State state = initial_state(setup, run);
    return centre_of_mass_x(state) - state.x_box;
  };
  if (!is_loose(setup.release.packing)) return {apart(0), layers_within};
  constexpr int draws = 24;
  RunningStatistic drawn;
  for (int run = 0; run < draws; ++run) drawn.add(apart(run));
  return {drawn.statistic().mean, std::max(loose_within, drawn.statistic().sd)};
}

/// A camera's scale or bias (standard deviation), and what another packing must bring in chi2.
constexpr double usual_scale = 0.03, better_by = 5;

/// Says where the grains' centre of a measured run lies in the box before anything has moved.
struct ReleasedCentre {
  std::size_t run;
  double apart;  ///< m, x_com - x_box
  double error;  ///< m, of the camera's noise
};

std::vector<ReleasedCentre> released_centres(const Measurement& measurement) {
  constexpr double still = 0.03;  // s
  std::vector<ReleasedCentre> list;
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    const MeasuredRun& run = measurement.runs[r].recorded;
    const RunAudit& audit = measurement.runs[r].audit;
    if (!run.has_com()) continue;
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < run.time.size() && run.time[i] < still; ++i)
      if (const double apart = audit.x_com[i] - audit.x_box[i]; std::isfinite(apart)) sum += apart, ++count;
    const double noise = std::hypot(audit.com.standard_deviation, audit.box.standard_deviation);
    constexpr double for_a_mean = 3;  // frames
    if (count >= for_a_mean) list.push_back({r, sum / count, noise / std::sqrt(count)});
  }
  return list;
}

struct Misfit {
  double rms;     ///< m
  double within;  ///< m, what it may be (standard deviation) without the camera's noise
  double chi2;  ///< up to what all packings share; the less certain places of a wide packing count against it
};

/// Returns the misfit of measured - scale * modelled. Where box lengths tell the scale it is free from 0.88
/// to 1.1.
Misfit misfit_up_to_scale(const std::vector<ReleasedCentre>& measured,
                          const std::vector<LaidCentre>& modelled) {
  double cross = 0, square = 0, low = 1e9, high = 0;
  const auto variance_of = [&](std::size_t i) {
    return modelled[i].within * modelled[i].within + std::pow(measured[i].error, 2);
  };
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double weight = 1 / variance_of(i), apart = modelled[i].apart;
    cross += weight * measured[i].apart * apart;
    square += weight * apart * apart;
    low = std::min(low, apart), high = std::max(high, apart);
  }
  const double known = 1 / (usual_scale * usual_scale);
  constexpr double tells = 0.01;                 // m, between box lengths
  constexpr double least = 0.88, largest = 1.1;  // of scales
  const double scale =
      high - low > tells ? std::clamp((cross + known) / (square + known), least, largest) : 1.0;
  Misfit misfit{0, 0, known * std::pow(scale - 1, 2)};
  const double runs = static_cast<double>(measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double squared = std::pow(measured[i].apart - scale * modelled[i].apart, 2);
    misfit.rms += squared / runs;
    misfit.within += modelled[i].within * modelled[i].within / runs;
    misfit.chi2 += squared / variance_of(i) + std::log(variance_of(i));
  }
  misfit.within = std::sqrt(misfit.within);
  misfit.rms = std::sqrt(misfit.rms);
  return misfit;
}

}  // namespace

PackingChoice packing_before_release(const Setup& given, const Measurement& measurement, KnownEffects known) {
  PackingChoice best{given.release.packing};
  if (!given.release.initial_grains.empty() || given.grains.count == 0) return best;
  const std::vector<ReleasedCentre> measured = released_centres(measurement);
  if (measured.empty()) return best;
  const auto misfit_of = [&](Packing packing) {
    Setup setup = given;
    setup.release.packing = packing;
    std::vector<LaidCentre> modelled;
    for (const ReleasedCentre& centre : measured)
      modelled.push_back(laid_centre(setup_of_run(setup, measurement.runs[centre.run].recorded, known)));
    return misfit_up_to_scale(measured, modelled);
  };
  const auto fits = [](const Misfit& misfit) { return misfit.rms < 2 * misfit.within; };
  const Misfit of_given = misfit_of(best.packing);
  best.apart = of_given.rms;
  best.fits = fits(of_given);
  double least = of_given.chi2 - better_by;
  for (const Packing packing : {Packing::fcc, Packing::square, Packing::random, Packing::spread}) {
    try {
      const Misfit misfit = misfit_of(packing);
      if (misfit.chi2 >= least || !fits(misfit)) continue;
      best = {packing, misfit.rms};
      least = misfit.chi2;
    } catch (const InputError&) {  // so many grains do not fit laid like that
    }
  }
  return best;
}

}  // namespace shakedown
