// SPDX-License-Identifier: MIT
// What of a recorded run is compared with a model: both positions in bins of 0.1 s. A bin's value is its
// level at the middle of the bin, by a parabola through its frames, so that lost frames do not shift it;
// simulated series are read at the very same frames.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "camera.hpp"
#include "measurement.hpp"

namespace shakedown {

enum class Observable { box, centre };

/// Grains that the table has and the setup has not cannot be compared.
enum class Observed { box_only, all };

struct Feature {
  Observable observable;
  double time;   ///< s, middle of the bin
  double noise;  ///< m, standard deviation of the camera's noise in it
};

/// How one measured run is looked at.
struct FeaturePlan {
  std::vector<Feature> features;
  double end = 0;  ///< s, last time that is needed of a simulation
  /// For each feature the frames that make it: times (s) and weights.
  struct Reading {
    std::vector<double> time, weight;
  };
  std::vector<Reading> readings;
};

/// Bins from release to the end of what still moves: the last peak above `rest` (m), and one second more; of
/// a damper that is shaken to the end of the film.
FeaturePlan plan_features(const Measurement::Run& measurement, Observed observed = Observed::all,
                          double rest = 4e-3, double bin = 0.1);

/// The features of the measured run itself.
Eigen::VectorXd measured_features(const FeaturePlan& plan, const Measurement::Run& measurement);

/// The features of two series on the frames of the measured run; centre may be empty where no feature needs
/// it.
Eigen::VectorXd features_on_frames(const FeaturePlan& plan, const std::vector<double>& time,
                                   const std::vector<double>& box, const std::vector<double>& centre);

/// The features of a simulated recording (500 Hz or any constant rate).
Eigen::VectorXd simulated_features(const FeaturePlan& plan, const Recording& recording);

}  // namespace shakedown
