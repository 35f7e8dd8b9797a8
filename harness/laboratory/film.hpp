// SPDX-License-Identifier: MIT
// Films a motion as a laboratory does: with the camera as it is, frame by frame. It is written apart from the
// camera of the model (observe/camera), which a test holds against it; a slip in one of them would otherwise
// stay unseen.
#pragma once
#include <vector>

#include "camera.hpp"

namespace shakedown {

/// Says when the frames are taken, and what the table says of it.
struct Frames {
  std::vector<double> instant;  ///< s since release; before it box and grains rest
  std::vector<double> stamp;    ///< s, time in the table but for the camera's own offset
};

/// Returns the frames of an even clock (`rate`, Hz) that starts `late` (s) after the release and runs to
/// `end` (s since release).
Frames even_frames(double rate, double late, double end);

/// Returns an encoder's rows, from `start` (s since release) on: where the box passes a multiple of `edge`
/// (m).
Frames edge_frames(double edge, double start, const Trajectory& motion);

/// Returns what the table says of the motion. Between its samples the box follows cubics with its own
/// velocity, the grains' centre cubics with slopes of parabolas.
Recording filmed(const Camera& errors, const Frames& frames, const Trajectory& motion);

}  // namespace shakedown
