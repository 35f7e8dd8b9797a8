// SPDX-License-Identifier: MIT
#include "objective.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>

#include "random.hpp"

namespace shakedown {

namespace {

/// Returns the objective by its logarithm, which has the same minimum. Far from it the sum is some thousand
/// times the degrees, by which a search is scaled badly and stops on its way.
double scaled(const Objective& objective, const Eigen::VectorXd& z) {
  return objective.degrees * std::log1p(std::max(0.0, objective(z)) / objective.degrees);
}

double evaluate(const std::vector<double>& z, std::vector<double>& gradient, void* data) {
  const auto& objective = *static_cast<const Objective*>(data);
  const Eigen::Map<const Eigen::VectorXd> at(z.data(), static_cast<Eigen::Index>(z.size()));
  if (!gradient.empty())
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      Eigen::VectorXd up = at, down = at;
      up[k] += 1e-4;
      down[k] -= 1e-4;
      gradient[static_cast<std::size_t>(k)] = (scaled(objective, up) - scaled(objective, down)) / 2e-4;
    }
  return scaled(objective, at);
}

}  // namespace

double Objective::true_sum(const Eigen::VectorXd& phi) const {
  const double measured = sum(phi), wider = inflation(phi), expected = degrees * wider;
  return measured > expected ? degrees + measured - expected : measured / wider;
}

double Objective::chi2(const Eigen::VectorXd& z) const {
  return true_sum(regression_terms(*knobs, z)) + disbelief(z);
}

double Objective::disbelief(const Eigen::VectorXd& z) const {
  double sum = 0;
  for (std::size_t k = 0; k < knobs->size(); ++k) {
    const Knob& knob = (*knobs)[k];
    if (knob.believed_error > 0)
      sum += std::pow((knob.at(z[static_cast<Eigen::Index>(k)]) - knob.believed) / knob.believed_error, 2);
  }
  return sum;
}

double Objective::operator()(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd phi = regression_terms(*knobs, z);
  // The emulator's error widens what chaos and a wrong model leave: by less where these leave more.
  const double left = true_sum(phi), of_model = std::max(1.0, left / degrees);
  return left + degrees * std::log1p((inflation(phi) - 1) / of_model) + disbelief(z);
}

Minimum minimum_of(const Objective& objective, double farthest, int starts, const Eigen::VectorXd& first) {
  const std::vector<Knob>& knobs = *objective.knobs;
  if (knobs.empty()) return {Eigen::VectorXd(0), objective(Eigen::VectorXd(0))};
  std::vector<double> low, high;
  for (const Knob& knob : knobs) {
    low.push_back(knob.exact ? knob.z_of(knob.low) : std::max(-farthest, knob.z_of(knob.low)));
    high.push_back(knob.exact ? knob.z_of(knob.high) : std::min(farthest, knob.z_of(knob.high)));
  }
  Minimum best{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(knobs.size())), 0};
  for (int start = 0; start < starts; ++start) {
    Random random(17, static_cast<std::uint64_t>(start), Stream::other);
    std::vector<double> z;
    for (std::size_t k = 0; k < knobs.size(); ++k)
      z.push_back(std::clamp(start > 0          ? 1.6 * random.uniform() - 0.8
                             : first.size() > 0 ? first[static_cast<Eigen::Index>(k)]
                                                : 0.0,
                             low[k], high[k]));
    nlopt::opt search(nlopt::LD_SLSQP, static_cast<unsigned>(knobs.size()));
    search.set_lower_bounds(low);
    search.set_upper_bounds(high);
    search.set_min_objective(evaluate, const_cast<Objective*>(&objective));
    search.set_xtol_abs(1e-6);
    search.set_maxeval(200);
    double value = 0;
    try {
      search.optimize(z, value);
    } catch (const std::runtime_error&) {  // stopped by rounding at the minimum: z is good
      std::vector<double> none;
      value = evaluate(z, none, const_cast<Objective*>(&objective));
    }
    if (start == 0 || value < best.value)
      best = {Eigen::Map<Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size())), value};
  }
  return best;
}

}  // namespace shakedown
