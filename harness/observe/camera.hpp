// SPDX-License-Identifier: MIT
// The camera as a model: what it makes of a motion, the inverse, and how a recording changes with each of its
// errors. All of it is arithmetic on positions; nothing is simulated.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "known_effects.hpp"
#include "physics.hpp"
#include "trajectory.hpp"

namespace shakedown {

/// What a measurement holds of a motion.
struct Recording {
  std::vector<double> time;   ///< s
  std::vector<double> x_box;  ///< m
  std::vector<double> x_com;  ///< m; NaN without grains; empty: the grains are not tracked
};

/// Returns the trajectory as the camera sees it (Physics::Camera).
Recording recorded_by(const Camera& camera, const Trajectory& trajectory);

/// Returns the recording that a camera makes of another recording, so that a camera can be put on top of
/// another. Positions that are NaN stay NaN. Where the shutter moves a frame in time, the position follows a
/// local cubic (moved_in_time.hpp): of the paper's swing it is off by 4e-9 m at 500 frames a second, 4e-8 m
/// at 240 (2 ms for 0.4 m), and some micrometres in the few frames around an impact.
Recording seen_through(const Camera& camera, const Recording& recording);

/// Returns what went into seen_through(camera, .) to give this recording, to 1e-12 m: the exact inverse,
/// found by fixed point. Needs a picture that does not fold: 1 + 3 lens (x / camera_lens_reach)^2 > 0.
Recording undone(const Camera& camera, const Recording& recording);

/// A parameter of the camera, as the record of its effect says it.
struct CameraParameter {
  std::string path;    ///< of the effect's parameter in a setup, "camera_lens.distortion"
  double typical = 0;  ///< SI, of an ordinary camera
  double Camera::*field = nullptr;
  bool optical = false;         ///< CameraNumber
  bool inverse_square = false;  ///< the recording is linear in 1 / value^2 (a length; infinite: no error)
};
/// Returns the parameter of an effect of the camera; nothing for an effect that is none.
std::optional<CameraParameter> camera_parameter_of(const EffectRecord& record);
/// Returns the parameters of all effects of the camera that are known, a clock's offset among them.
std::vector<CameraParameter> camera_parameters(KnownEffects known);
/// Returns the parameter of this path, "camera_lens.distortion"; nothing where none is known.
std::optional<CameraParameter> find_camera_parameter(KnownEffects known, std::string_view path);

/// Returns the change of the positions, m, at each recorded time per unit of the parameter (SI; of 1 /
/// value^2 where inverse_square), at a parameter of zero: the derivative of seen_through() that puts this
/// error alone on top of the recording. All three series have the recording's length; `time` is the
/// recording's.
Recording derivative(const Recording& recording, const CameraParameter& parameter);

}  // namespace shakedown
