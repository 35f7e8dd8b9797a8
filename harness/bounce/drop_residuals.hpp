// SPDX-License-Identifier: MIT
// Computes what a law leaves of the flights, and how timing and scatter make it vary. From the measured
// duration T_i of a flight follow take-off, landing speed u, the next take-off e(u) u and the next duration
// F(T_i). The residual r_i = T_(i+1) - F(T_i) holds the errors d of three instants, d_(i+1) - (1 + F') d_i +
// F' d_(i-1), which it shares with its neighbours, and the scatter of e at the one impact between, (dT/dv) u
// xi. That is the likelihood of all instants with the speed of the first flight integrated out; F is linear
// over an error.
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "drops.hpp"
#include "flight.hpp"
#include "restitution_law.hpp"

namespace shakedown {

/// How the air is treated.
enum class AirModel { none, ball, free };

/// A law with the numbers beside it that are not known exactly.
struct BounceModel {
  LawKind law = LawKind::constant;
  AirModel air = AirModel::none;
  bool heights = false;                       ///< drops have heights, with one error in common
  double reference = 1;                       ///< m/s
  double gravity = 9.81;                      ///< m/s^2
  std::shared_ptr<const BallFlights> ball{};  ///< for AirModel::ball
  double height_error = 0.01;                 ///< m, common to all heights (one standard deviation)
  double release_error = 0.002;               ///< m, of each drop by itself

  /// Returns the law's parameters, then `drag_factor` (ball) or `ln_drag` (free; of 1/m), then, with heights,
  /// `height_offset`, m.
  std::vector<LawParameter> parameters() const;
  /// Returns the flights of a ball in this air. `value`: of parameters(), in their order.
  Flight flight(const Eigen::VectorXd& value) const;
};

/// One impact between two flights (or after a fall from a height).
struct ImpactRow {
  std::size_t flights = 0;  ///< index of its Flights
  std::size_t drop = 0;
  int impact = 0;
  double speed = 0;                  ///< m/s, of impact
  double restitution = 0;            ///< by the two flights beside it
  double per_restitution = 0;        ///< s, change of the next duration by that of e
  std::array<double, 3> instants{};  ///< weight of the errors of the instants before, at and after the impact
  double other_variance = 0;         ///< s^2, of the height
};

/// Residuals and their slopes, s, at `value`; rows in the order of flights and impacts.
struct Linearised {
  std::vector<ImpactRow> rows;
  Eigen::VectorXd value, residual;
  Eigen::MatrixXd slope;  ///< of the residual by the parameters
};

/// Computes residuals and slopes at `value`, a value of each of model.parameters() in their order. A row is
/// an impact between two flights, before them of each Flights with a height the impact of the fall.
Linearised linearised(const std::vector<Flights>& flights, const BounceModel& model,
                      const Eigen::VectorXd& value);

}  // namespace shakedown
