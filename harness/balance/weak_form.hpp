// SPDX-License-Identifier: MIT
// Writes the momentum balance in weak form: multiplied by a smooth bump phi and integrated by parts, so that
// no measured series is differentiated. On a window of length T, u = 2 (t - centre) / T: phi = (1 - u^2)^5.
// With F the force that the setup lacks,
//   Int phi'' (M x_box + N m x_com) + Int phi (k x_box - F_setup) = Int phi F,
// linear in every force of the form strength * g(x, v, t).
#pragma once
#include <Eigen/Core>
#include <vector>

#include "momentum_run.hpp"
#include "slow_wander.hpp"

namespace shakedown {

/// Holds a force of unit strength, frame by frame, as the sum of whichever parts are present: force, N; minus
/// d/dt of `potential` (a force -g(x) v has potential G, dG/dx = g: no velocity needed); minus the second
/// derivative of `momentum`, which a wrong mass or camera adds to M x_box + N m x_com.
struct ForceSamples {
  Eigen::ArrayXd force, force_dx, force_dv;  ///< N, N/m, N s/m
  Eigen::ArrayXd potential, potential_dx;    ///< N s, N s/m
  Eigen::ArrayXd momentum;                   ///< kg m
  Eigen::ArrayXd inertia_box, inertia_com;   ///< kg, what noise of x_box and x_com enters `momentum` with
  double plateau =
      0;  ///< change of the slope of the packed layer's distance against the box length (PlateauSlope)
  double stiffness = 0;  ///< relative change of the spring's
};

/// Adds strength * added to the samples, part by part.
void add_samples(ForceSamples& samples, const ForceSamples& added, double strength);

/// Makes the weak form of one run.
class WeakForm {
 public:
  /// Lays windows of `length` seconds every `hop` seconds; those stay whose frames are all usable. The run
  /// must outlive it.
  WeakForm(const MomentumRun& run, double length, double hop);

  const MomentumRun& run() const { return *run_; }  ///< whose weak form it is
  /// Returns the number of windows that stay.
  Eigen::Index windows() const { return static_cast<Eigen::Index>(first_.size()); }
  double centre(Eigen::Index window) const;  ///< s
  double excursion(Eigen::Index window) const {
    return excursion_[window];
  }  ///< m, max x - min x of the box, halved
  /// Keeps only the windows flagged.
  void keep(const std::vector<char>& flags);

  /// Returns the left side of each window: the impulse, N s, that no force of the setup explains.
  Eigen::VectorXd impulse() const;
  bool has_windows() const { return !first_.empty(); }
  /// Returns the right side of each window for one force of unit strength.
  Eigen::VectorXd column(const ForceSamples& samples) const;
  /// Returns a column for each node of a grid, windows x nodes: hats at `place` (in nodes, frame by frame),
  /// times `factor`, as force or as potential.
  Eigen::MatrixXd node_columns(const Eigen::ArrayXd& place, const Eigen::ArrayXd& factor, Eigen::Index nodes,
                               bool is_potential) const;
  /// Returns the columns of sin and cos of unit force at a frequency, Hz.
  Eigen::MatrixXd harmonic(double frequency) const;
  /// Returns the integral of phi, s, which turns an impulse into a mean force.
  double weight() const;
  /// Returns the covariance of the impulse, (N s)^2, from camera noise and a track that wanders, when the
  /// forces of the fit so far are `fitted`.
  Eigen::MatrixXd covariance(const ForceSamples& fitted, const Wander& wander = {}) const;

 private:
  const MomentumRun* run_;
  Eigen::Index frames_ = 0;  ///< of a window
  Eigen::ArrayXd phi_, slope_,
      curvature_;  ///< phi, phi', phi'' times the interval, on the frames of a window
  std::vector<Eigen::Index> first_;
  Eigen::ArrayXd excursion_;
  std::vector<int> filled_before_;
};

}  // namespace shakedown
