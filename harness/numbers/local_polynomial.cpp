// SPDX-License-Identifier: MIT
#include "local_polynomial.hpp"

#include <cmath>

namespace shakedown {

Eigen::MatrixXd powers_of(const Eigen::ArrayXd& places, Eigen::Index coefficients) {
  Eigen::MatrixXd columns(places.size(), coefficients);
  for (Eigen::Index i = 0; i < columns.rows(); ++i)
    for (Eigen::Index power = 0; power < coefficients; ++power)
      columns(i, power) = std::pow(places[i], static_cast<double>(power));
  return columns;
}

Eigen::ArrayXd even_places(int half) {
  Eigen::ArrayXd places(2 * half + 1);
  for (int i = 0; i < places.size(); ++i) places[i] = static_cast<double>(i - half) / half;
  return places;
}

}  // namespace shakedown
