// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

namespace shakedown {

/// Returns the sum of a column, added from first to last. Eigen's own adds as many at a time as the
/// processor's vectors hold, so that its last digits differ from one processor to the next.
template <class Column>
double sum_in_order(const Eigen::DenseBase<Column>& column) {
  double sum = 0;
  for (Eigen::Index i = 0; i < column.size(); ++i) sum += column.derived().coeff(i);
  return sum;
}

}  // namespace shakedown
