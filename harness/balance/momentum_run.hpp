// SPDX-License-Identifier: MIT
// Makes one measured run ready for the momentum balance M x_box'' + N m x_com'' = -k x_box + F.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "measurement.hpp"

namespace shakedown {

/// Holds a run on an even clock. Lost frames are filled by cubic interpolation so that integrals stay smooth;
/// where a gap is longer than the interpolation is good for, the frame is not usable and no window of the
/// weak form touches it.
struct MomentumRun {
  static constexpr std::size_t fewest_frames = 8;  ///< below there is no motion to speak of
  std::string name;
  double box_mass = 0;               ///< kg, M
  double grain_mass = 0;             ///< kg, N m; 0: empty box
  double stiffness = 0;              ///< N/m, k
  double displacement = 0;           ///< m, release at which a cubic spring's coefficient is the change
  std::vector<std::string> effects;  ///< that the setup has: the balance may find too much of them
  double interval = 0;               ///< s, between frames
  Eigen::ArrayXd time;               ///< s
  Eigen::ArrayXd x_box, x_com;       ///< m; x_com = x_box where the box is empty
  /// Position and velocity of the box by a local cubic, m and m/s; forces take x_box itself, whose noise has
  /// no bias.
  Eigen::ArrayXd x_smooth, v_smooth;
  double v_noise = 0;  ///< m/s, standard deviation of v_smooth
  /// Force on box and grains from the setup's own effects, N; drag between box and air cancels. A viscous
  /// drag -c v is minus d/dt of `viscous` times x_box: no velocity is needed.
  Eigen::ArrayXd model_force;
  double viscous = 0;         ///< N s/m
  bool dry_friction = false;  ///< model_force has one that turns with the motion: unknown while the box rests
  /// Derivatives of model_force by the box's position and velocity, N/m and N s/m; the latter over the
  /// velocity's blur, so that a force that jumps at a turning point lets in what is not known of the moment.
  Eigen::ArrayXd model_force_dx, model_force_dv;
  std::vector<char> usable;                  ///< frame measured or well interpolated
  std::vector<char> box_filled, com_filled;  ///< position interpolated
  double com_gain = 1;                       ///< true (x_com - x_box) over recorded, by the setup's camera
  double plateau_gain =
      1;  ///< recorded (x_com - x_box) of a packed layer over true, in the middle of the track
  NoiseFound box_noise, com_noise;  ///< of the recorded series
};

/// Returns the run with the camera effects of its setup taken out of the data and its forces in model_force.
/// Without x_com (and with grains) there is no balance: returns a run without frames.
MomentumRun momentum_run(const Measurement::Run& measurement);

/// Returns the same frames with the masses and forces of another setup, whose camera is the same.
MomentumRun with_forces_of(const Setup& setup, MomentumRun run);

/// Returns the standard deviation of the velocity in each frame about v_smooth, m/s: its noise, and what it
/// changes by in the frame's length. A force that turns within it lets the noise in by its slope over as
/// much.
Eigen::ArrayXd velocity_blur(const MomentumRun& run);

/// Holds the sign of the box's velocity, frame by frame, as far as it is known: its mean over the blur, erf(v
/// / (sqrt(2) blur)); and the derivative by v. Summed over a turning point the derivative lets in the impulse
/// 2 dt that a moment unknown by dt makes.
struct KnownSign {
  Eigen::ArrayXd sign, slope;
};
/// Returns the known sign of a run.
KnownSign known_sign(const MomentumRun& run);

/// Holds the weights of a local cubic fit over 2 * half + 1 frames, for the value and for the derivative (per
/// frame) at the centre.
struct LocalCubic {
  Eigen::VectorXd value, slope;
};
/// Returns the weights of this half width, frames.
LocalCubic local_cubic(int half);
/// Returns how many frames to either side smooth the velocity of frames `interval` (s) apart: 20 ms, three at
/// least.
int smoothing_half_width(double interval);

/// Returns the weights at the four known places for the value at `at`: Lagrange.
Eigen::Vector4d cubic_weights(const Eigen::Vector4d& places, double at);

}  // namespace shakedown
