// SPDX-License-Identifier: MIT
// A box without grains that starts anywhere in its motion: one run of the engine from its first turning point
// is the model.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "engine.hpp"
#include "measurement.hpp"

namespace shakedown {

/// Hz, of the model's motion; a line between two samples misses by 5e-5 of the amplitude at 3 Hz.
constexpr double swing_model_rate = 1000;

/// Where a run turns for the first time.
struct FirstTurn {
  double time = 0, place = 0;  ///< s, m
};

/// SwingFrames of one run from its start on: s, m.
struct SwingFrames {
  std::vector<double> time, x;
};
SwingFrames frames_of(const Measurement::Run& run);

/// m, of all frames: half way between the farthest places.
double middle_of(const SwingFrames& frames);

/// m, half the way between the farthest places.
double half_span_of(const SwingFrames& frames);

/// "mostly a swing of 0.27 Hz (1.4 mm)" where one frequency makes half of what is left or more; else empty.
std::string words_of_swing(const std::vector<double>& time, const Eigen::VectorXd& left);

/// The farthest place within the first period, s.
FirstTurn first_turn(const SwingFrames& frames, double middle, double period);

/// Measured less modelled, m, from the turn on.
Eigen::VectorXd residual_of(const SwingFrames& frames, const FirstTurn& turn, Setup setup,
                            const Engine& engine);

struct SwingFit {
  FirstTurn turn;
  double origin = 0;         ///< m, of the recorded positions; 0 where it is known
  std::vector<double> time;  ///< s, of the frames of `residual`
  Eigen::VectorXd residual;  ///< m, of the frames after the first guess of the turn
};

/// Time and place of the turn, and the origin, by a few steps of Gauss and Newton. The frames that count stay
/// those after the first guess.
SwingFit fit_of(const SwingFrames& frames, FirstTurn turn, const Setup& setup, const Engine& engine,
                bool origin_unknown);
SwingFit fit_of(const Measurement::Run& run, const Engine& engine);

/// The measurement with each run without grains that starts anywhere counted from its first turn, as a
/// release from rest about x = 0: what simulations of the setup can be compared with. Others stay as they
/// are. The turn is fitted to so many periods from it: all of them beside a model that is judged as it is,
/// few where something that damps may still be missing.
Measurement from_first_turns(const Measurement& measurement, const Engine& engine,
                             double periods = std::numeric_limits<double>::infinity());

}  // namespace shakedown
