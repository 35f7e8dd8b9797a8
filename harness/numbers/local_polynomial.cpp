// SPDX-License-Identifier: MIT
#include "local_polynomial.hpp"

namespace shakedown {

Eigen::MatrixXd powers_of(const Eigen::ArrayXd& places, Eigen::Index coefficients) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(places.size(), coefficients);
  for (Eigen::Index power = 1; power < coefficients; ++power)
    columns.col(power) = (columns.col(power - 1).array() * places).matrix();
  return columns;
}

}  // namespace shakedown
