// SPDX-License-Identifier: MIT
// Polynomials through points near each other. Places are best given within +-1, where the powers differ
// enough.
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>

namespace shakedown {

/// Returns the columns 1, u, u^2 ...: one row a place, one column a coefficient.
Eigen::MatrixXd powers_of(const Eigen::ArrayXd& places, Eigen::Index coefficients);

/// Returns 2 half + 1 places from -1 to 1, as far apart as frames of an even clock.
Eigen::ArrayXd even_places(int half);

/// Fits a polynomial by least squares (normal equations, by the closed form of a small inverse) to points
/// that come one by one.
template <int coefficients_>
class LocalPolynomial {
 public:
  using Vector = Eigen::Matrix<double, coefficients_, 1>;
  using Matrix = Eigen::Matrix<double, coefficients_, coefficients_>;

  /// Adds a point; all places are counted from the same origin and in the same unit.
  void add(double place, double value) {
    Vector row;
    row[0] = 1;
    for (int power = 1; power < coefficients_; ++power) row[power] = row[power - 1] * place;
    normal_ += row * row.transpose();
    right_ += row * value;
    ++count_;
  }
  int count() const { return count_; }  ///< points so far
  /// Returns the coefficients, constant first, in the value's unit. Needs as many places as coefficients.
  Vector coefficients() const { return covariance() * right_; }
  /// Returns their covariance where each value has variance 1.
  Matrix covariance() const { return normal_.inverse(); }

 private:
  Matrix normal_ = Matrix::Zero();
  Vector right_ = Vector::Zero();
  int count_ = 0;
};

}  // namespace shakedown
