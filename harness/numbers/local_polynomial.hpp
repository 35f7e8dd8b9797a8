// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

namespace shakedown {

/// Weights of a polynomial fitted by least squares to values at `offsets` (Savitzky and Golay, Anal. Chem.
/// 36, 1627 (1964), here for any spacing): row k, multiplied with the values, gives the coefficient of
/// offset^k, which is the k-th derivative at offset 0 over k!. (degree + 1) rows, one column a value, in
/// units of 1/offset^k. Needs more than `degree` different offsets.
Eigen::MatrixXd local_polynomial(const Eigen::VectorXd& offsets, int degree);

/// The same for offsets -half ... half in steps of 1.
Eigen::MatrixXd local_polynomial(int half, int degree);

}  // namespace shakedown
