// SPDX-License-Identifier: MIT
// Gauss-Legendre collocation: a motion as a polynomial through the accelerations at eight nodes of a piece.
#pragma once
#include <array>
#include <cstddef>

namespace shakedown {

constexpr std::size_t node_count = 8;

/// A value at each node, or of each coefficient.
using Nodes = std::array<double, node_count>;

/// Gauss-Legendre nodes and weights on [0, 1], the matrix that turns values at the nodes into coefficients of
/// a polynomial, and those that integrate it once and twice from 0 to each node (shape [of value][to node]).
struct Collocation {
  Nodes node{}, weight{};
  std::array<Nodes, node_count> coefficient{}, once{}, twice{};

  Collocation();
};

/// Returns the tables, which are made at the first call.
const Collocation& collocation();

/// Returns the sum of the rows of a matrix, each times its value.
inline Nodes combined(const std::array<Nodes, node_count>& rows, const Nodes& value) {
  Nodes sum{};
  for (std::size_t j = 0; j < node_count; ++j)
    for (std::size_t k = 0; k < node_count; ++k) sum[k] += rows[j][k] * value[j];
  return sum;
}

}  // namespace shakedown
