// SPDX-License-Identifier: MIT
#include "local_polynomial.hpp"

#include "expect.hpp"
#include "least_squares.hpp"

namespace shakedown {

Eigen::MatrixXd local_polynomial(const Eigen::VectorXd& offsets, int degree) {
  EXPECT(degree >= 0 && offsets.size() > degree);
  const double reach = offsets.cwiseAbs().maxCoeff();
  const double unit = reach > 0 ? reach : 1;  // powers of numbers up to 1 keep the matrix well conditioned
  Eigen::MatrixXd powers(offsets.size(), degree + 1);
  powers.col(0).setOnes();
  for (int k = 1; k <= degree; ++k) powers.col(k) = powers.col(k - 1).cwiseProduct(offsets / unit);
  Eigen::MatrixXd weights = least_squares_weights(powers);
  double scale = 1;
  for (int k = 1; k <= degree; ++k) weights.row(k) /= scale *= unit;
  return weights;
}

Eigen::MatrixXd local_polynomial(int half, int degree) {
  return local_polynomial(Eigen::VectorXd::LinSpaced(2 * half + 1, -half, half), degree);
}

}  // namespace shakedown
