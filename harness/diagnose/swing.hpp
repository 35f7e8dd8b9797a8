// SPDX-License-Identifier: MIT
// Handles a box without grains that starts anywhere in its motion: one run of the engine from its first
// turning point is the model.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "engine.hpp"
#include "measurement.hpp"

namespace shakedown {

/// Sample rate of the model's motion, Hz; a line between two samples misses by 5e-5 of the amplitude at 3 Hz.
constexpr double swing_model_rate = 1000;

/// Says where a run turns for the first time.
struct FirstTurn {
  double time = 0, place = 0;  ///< s, m
};

/// Frames of one run from its start on: s, m.
struct SwingFrames {
  std::vector<double> time, x;
};
/// Returns the frames of a run that have a position, from its start on.
SwingFrames frames_of(const Measurement::Run& run);

/// Returns the middle of all frames, m: half way between the farthest places.
double middle_of(const SwingFrames& frames);

/// Returns half the way between the farthest places, m.
double half_span_of(const SwingFrames& frames);

/// Returns "mostly a swing of 0.27 Hz (1.4 mm)" where one frequency makes half of what is left or more; else
/// an empty text.
std::string words_of_swing(const std::vector<double>& time, const Eigen::VectorXd& left);

/// Returns the frame farthest from `middle` (m) within the first 1.1 periods; its place counts from `middle`.
/// `period`: s.
FirstTurn first_turn(const SwingFrames& frames, double middle, double period);

/// Returns measured less modelled, m, of the frames from the turn on. PhysicsError passes.
Eigen::VectorXd residual_of(const SwingFrames& frames, const FirstTurn& turn, Setup setup,
                            const Engine& engine);

/// Holds the fitted turn of a run and what it leaves.
struct SwingFit {
  FirstTurn turn;
  double origin = 0;         ///< m, of the recorded positions; 0 where it is known
  std::vector<double> time;  ///< s, of the frames of `residual`
  Eigen::VectorXd residual;  ///< m, of the frames after the first guess of the turn
};

/// Fits time and place of the turn, and the origin where it is unknown, by a few steps of Gauss and Newton.
/// The frames that count stay those after the first guess.
SwingFit fit_of(const SwingFrames& frames, FirstTurn turn, const Setup& setup, const Engine& engine,
                bool origin_unknown);
/// Fits the first turn of a measured run; its origin counts as unknown where the run starts anywhere.
SwingFit fit_of(const Measurement::Run& run, const Engine& engine);

/// Returns the measurement with each run without grains that starts anywhere counted from its first turn, as
/// a release from rest about x = 0: what simulations of the setup can be compared with. Others stay as they
/// are. The turn is fitted to so many periods from it: all of them beside a model that is judged as it is,
/// few where something that damps may still be missing.
Measurement from_first_turns(const Measurement& measurement, const Engine& engine,
                             double periods = std::numeric_limits<double>::infinity());

}  // namespace shakedown
