// SPDX-License-Identifier: MIT
// Reads off a recorded run what is compared with a model: both positions in bins of 0.1 s, or of eight frames
// where these take longer. A bin's value is its level at the middle of the bin, by a parabola through its
// frames, so that lost frames do not shift it; simulated series are read at the very same frames.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "camera.hpp"
#include "measurement.hpp"

namespace shakedown {

enum class Observable { box, centre };

/// Says which tracks are compared. Grains that the table tracks and the setup lacks are not.
enum class Observed { box_only, all };

/// Describes one number that is compared: the level of one track in one bin.
struct Feature {
  Observable observable;
  double time;   ///< s, middle of the bin
  double noise;  ///< m, standard deviation of the camera's noise in it
};

/// Says how one measured run is looked at.
struct FeaturePlan {
  std::vector<Feature> features;
  double end = 0;  ///< s, last time that is needed of a simulation
  /// For each feature the frames that make it: times (s) and weights.
  struct Reading {
    std::vector<double> time, weight;
  };
  std::vector<Reading> readings;
};

/// Width of the bins of a run, of its period: 0.1 s of the paper's damper. A parabola follows the box there.
constexpr double bin_of_a_period = 0.123;

/// Returns the bins of a run from time 0 on, bin_of_a_period wide, or eight frames or a six hundredth of the
/// run where these take longer.
/// They end one and a quarter periods after the last frame that lies farther from where the box ends up than
/// 3.7 % of its release, or than 1.5 times its swing there where that is more (five times as much at most);
/// those of a damper that is shaken end with the film. Bins with too few frames are left out.
FeaturePlan plan_features(const Measurement::Run& measurement, Observed observed = Observed::all);

/// Returns the features of the measured run itself, m.
Eigen::VectorXd measured_features(const FeaturePlan& plan, const Measurement::Run& measurement);

/// Returns the features of two series (m) on the frames of the measured run, m; centre may be empty where no
/// feature needs it.
Eigen::VectorXd features_on_frames(const FeaturePlan& plan, const std::vector<double>& time,
                                   const std::vector<double>& box, const std::vector<double>& centre);

/// Returns the features of a simulated recording (of any constant rate), m.
Eigen::VectorXd simulated_features(const FeaturePlan& plan, const Recording& recording);

/// Simulations go on so long after the last time that is needed of them, s.
constexpr double simulated_beyond = 0.05;

/// Gives the setup the duration (half a second at least) and the sample rate with which it is simulated where
/// `end`, s, is the last time that is needed.
void simulate_until(Setup& setup, double end);

}  // namespace shakedown
