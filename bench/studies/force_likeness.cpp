// SPDX-License-Identifier: MIT
#include "force_likeness.hpp"

#include <cmath>
#include <numeric>

namespace shakedown {

std::vector<double> force_along(const std::string& formula, const std::map<std::string, double>& constants,
                                const Trajectory& motion) {
  const Formula force(formula, constants);
  std::vector<double> values;
  for (std::size_t i = 0; i < motion.time.size(); ++i)
    values.push_back(force(motion.x_box[i], motion.v_box[i], motion.time[i]));
  return values;
}

double force_likeness(std::vector<double> a, std::vector<double> b, const std::vector<double>& x) {
  const auto dot = [](const std::vector<double>& p, const std::vector<double>& q) {
    return std::inner_product(p.begin(), p.end(), q.begin(), 0.0);
  };
  for (std::vector<double>* series : {&a, &b}) {
    const double share = dot(*series, x) / dot(x, x);
    for (std::size_t i = 0; i < x.size(); ++i) (*series)[i] -= share * x[i];
  }
  const double size = std::sqrt(dot(a, a) * dot(b, b));
  return size > 0 ? std::abs(dot(a, b)) / size : 0;
}

}  // namespace shakedown
