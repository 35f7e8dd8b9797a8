// SPDX-License-Identifier: MIT
#include "collocation.hpp"

#include <cmath>
#include <numbers>

namespace shakedown {

Collocation::Collocation() {
  std::array<long double, node_count> exact{};
  constexpr int n = static_cast<int>(node_count);
  for (int i = 0; i < n; ++i) {
    long double z = std::cos(std::numbers::pi_v<long double> * (i + 0.75L) / (n + 0.5L)), slope = 1;
    for (int iteration = 0; iteration < 50; ++iteration) {
      long double p = 1, q = 0;
      for (int k = 0; k < n; ++k) {
        const long double r = q;
        q = p;
        p = ((2 * k + 1) * z * q - k * r) / (k + 1);
      }
      slope = n * (z * p - q) / (z * z - 1);
      z -= p / slope;
    }
    const auto place = static_cast<std::size_t>(n - 1 - i);
    exact[place] = (1 + z) / 2;
    node[place] = static_cast<double>(exact[place]);
    weight[place] = static_cast<double>(1 / ((1 - z * z) * slope * slope));
  }
  // Lagrange polynomials of the nodes, multiplied out.
  for (std::size_t j = 0; j < node_count; ++j) {
    std::array<long double, node_count> product{1};
    for (std::size_t m = 0, degree = 0; m < node_count; ++m) {
      if (m == j) continue;
      const long double scale = 1 / (exact[j] - exact[m]);
      for (std::size_t k = ++degree; k > 0; --k)
        product[k] = (product[k - 1] - exact[m] * product[k]) * scale;
      product[0] *= -exact[m] * scale;
    }
    for (std::size_t k = 0; k < node_count; ++k) coefficient[k][j] = static_cast<double>(product[k]);
    for (std::size_t to = 0; to < node_count; ++to) {
      long double first = 0, second = 0;
      for (std::size_t k = node_count; k-- > 0;) {
        const auto order = static_cast<long double>(k);
        first = first * exact[to] + product[k] / (order + 1);
        second = second * exact[to] + product[k] / ((order + 1) * (order + 2));
      }
      once[j][to] = static_cast<double>(first * exact[to]);
      twice[j][to] = static_cast<double>(second * exact[to] * exact[to]);
    }
  }
}

const Collocation& collocation() {
  static const Collocation table;
  return table;
}

}  // namespace shakedown
