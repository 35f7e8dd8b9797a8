// SPDX-License-Identifier: MIT
// What the frames themselves say, before any model: noise and its colour, outliers, gaps, release, packed
// layer.
#pragma once
#include <string>
#include <vector>

#include "experiment.hpp"
#include "noise.hpp"

namespace shakedown {

/// The first 60 ms: x = displacement + velocity t - acceleration t^2 / 2.
struct ReleaseFound {
  double displacement = 0, displacement_error = 0;  ///< m
  double velocity = 0, velocity_error = 0;          ///< m/s at t = 0
  double time = 0, time_error = 0;                  ///< s, when the velocity was zero
};

struct RunAudit {
  std::string run;
  double frame_interval = 0;  ///< s
  NoiseFound box, com;        ///< com: zero standard deviation when not measured
  ReleaseFound release;
  double plateau = 0;  ///< m, |x_com - x_box| while the grains lie packed at an end wall; NaN without x_com
  double plateau_error = 0;          ///< m
  std::vector<double> x_box, x_com;  ///< the run's series with outliers taken out (NaN)
};

/// |x_com - x_box| of the packed layer is (1 - b)(1 + s)(L/2 - h): its slope against L tells a camera's bias
/// or scale from the mass.
struct PlateauSlope {
  double slope = 0, error = 0;  ///< per m of box length; 1/2 expected; NaN with one length only
};

struct Audit {
  std::vector<RunAudit> runs;
  PlateauSlope plateau;
  std::vector<std::string> warnings;  ///< sentences for people
};

Audit audit(const Experiment& experiment);
RunAudit audit_run(const MeasuredRun& run);

}  // namespace shakedown
