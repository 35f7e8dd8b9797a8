// SPDX-License-Identifier: MIT
// Keeps what the last fit of a diagnosis knows of every measured run: from it pages and files draw the very
// curves whose error is told.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "known_effects.hpp"
#include "refit_result.hpp"
#include "waveform.hpp"

namespace shakedown {

/// Holds the fit of boxes with grains.
struct EnsembleFit {
  Setup setup;                             ///< with the effects found; `fit` says where its numbers lie
  std::vector<MeasuredFeatures> measured;  ///< what was fitted to, each run
  Refit as_given, fit;                     ///< of these runs
};

/// Holds the fit of boxes without any.
struct SwingFound {
  std::vector<WaveformRun> runs;  ///< every frame
  WaveformFit fit;
  std::vector<Eigen::VectorXd> residual;  ///< m, measured less modelled, of `runs`
};

/// Holds the one fit or the other, and what was fitted to.
struct LastFit {
  Measurement measurement;  ///< each run from where the model of it begins
  std::optional<EnsembleFit> ensembles;
  std::optional<SwingFound> swing;
  std::vector<std::string> taken_back{};  ///< keys whose fitted values are not the answer's
};

/// Holds one observable of one measured run beside the model at the same moments.
struct FittedCurve {
  std::string run, observable;          ///< observable: "box" or "centre"
  std::vector<double> time;             ///< s
  std::vector<double> measured, model;  ///< m; model: the mean
  std::vector<double> as_given;         ///< m, mean of the setup as given
  std::vector<double> spread;           ///< m, standard deviation of measured less mean of a right model
};

/// Returns the curves of the runs in their order: of each the box and, where it was seen, the grains' centre.
/// A run of many frames is thinned to `most` of them.
std::vector<FittedCurve> curves_of(const LastFit& fit, std::size_t most = 6000);

/// Returns the same, thinned to 2000, as an array of objects, mm; a gap is null.
nlohmann::ordered_json curves_json(const LastFit& fit);

/// Returns the setup of each run of LastFit::measurement as the last fit has it: parameters, effects, camera,
/// masses, and where the box begins. `amended`: the setup of the answer.
std::vector<Setup> setups_of(const LastFit& fit, const Setup& amended, KnownEffects known);

/// Returns the n of which every n-th of so many leaves at most `most`.
std::size_t thinned_by(std::size_t count, std::size_t most);

}  // namespace shakedown
