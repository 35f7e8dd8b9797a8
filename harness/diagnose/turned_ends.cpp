// SPDX-License-Identifier: MIT
#include "turned_ends.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace shakedown {

std::pair<double, double> bounds_of(const TurnedNumber& number) {
  constexpr double least = 0.05, most = 0.999;  // of a restitution
  if (number.key.starts_with("restitution")) return {least, most};
  return {number.best - 0.5 * std::abs(number.best), number.best + 0.5 * std::abs(number.best)};
}

void set_ends(TurnedModel& model, const std::vector<Knob>& knobs) {
  for (std::size_t k = 0; k < model.numbers.size(); ++k) {
    TurnedNumber& number = model.numbers[k];
    const double low = std::min({number.from, number.given, number.best}),
                 high = std::max({number.to, number.given, number.best}), margin = 0.15 * (high - low);
    number.low = low - margin, number.high = high + margin;
    if (std::isfinite(number.absent) && number.absent <= low) number.low = number.absent;
    if (number.role == NumberRole::parameter) {
      const auto [least, most] = bounds_of(number);
      number.low = std::max(number.low, least), number.high = std::min(number.high, most);
    } else if (k < knobs.size() && !number.inverse && !knobs[k].exact) {
      number.low = std::max(number.low, knobs[k].low);
      number.high = std::min(number.high, knobs[k].high);
    }
    number.low = std::min(number.low, low), number.high = std::max(number.high, high);
  }
}

std::vector<Eigen::MatrixXd> squares_of(const TurnedModel& model, const EnsembleFit& fit) {
  std::vector<Eigen::MatrixXd> list;
  for (std::size_t r = 0; r < fit.measured.size(); ++r) {
    Eigen::MatrixXd all(fit.measured[r].values.size(), 1 + std::ssize(model.terms));
    all.col(0) = fit.fit.runs[r].residual;
    if (!model.columns.empty()) all.rightCols(std::ssize(model.terms)) = model.columns[r];
    const Eigen::LLT<Eigen::MatrixXd> root(fit.fit.covariances[r]);
    const Eigen::MatrixXd white = root.matrixL().solve(all);
    list.push_back(white.transpose() * white);
  }
  return list;
}

}  // namespace shakedown
