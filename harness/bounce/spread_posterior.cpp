// SPDX-License-Identifier: MIT
#include "spread_posterior.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "expect.hpp"
#include "row_covariance.hpp"

namespace shakedown {

namespace {

constexpr double share_from = -3, share_to = 8, share_step = 0.5;  // ln(f/(1-f))
constexpr double drops_from = -7, drops_to = 2, drops_step = 1;    // ln w
// Probabilities before the data; intervals of drops drawn with and without scatter then hold the truth alike.
constexpr double no_scatter = 0.6, no_drop_scatter = 0.75;
constexpr std::size_t least_drops = 3;
constexpr double timing_known_to = 0.1;
// Of V about its best value, in deviations of ln V: Student's tails reach far up.
constexpr double below = -4, above = 4, further = 12, volume_step = 0.5;
constexpr double negligible = 1e-7;
/// This times width^-2 is the precision of a uniform prior, which keeps what the data say nothing about from
/// being singular.
constexpr double nearly_flat = 1e-6;

double normal_below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Returns the share of a normal distribution that lies within the bounds.
double within(double mean, double deviation, double low, double high) {
  if (!(deviation > 0)) return mean >= low && mean <= high ? 1 : 1e-300;
  return std::max(1e-300, normal_below((high - mean) / deviation) - normal_below((low - mean) / deviation));
}

/// The products of residual and slopes with the inverse covariance of V = 1.
struct Products {
  Eigen::MatrixXd sum;
  double log_determinant = 0;
};

/// The products of each drop without the scatter of drops, and those with the vector of that scatter.
struct ByDrop {
  std::vector<Eigen::MatrixXd> inner;
  std::vector<Eigen::VectorXd> crossed;
  std::vector<double> own;
  double log_determinant = 0;

  /// Returns the products with scatter of drops, by the formula of Sherman and Morrison, drop by drop.
  Products with(double drop_variance) const {
    Products all{Eigen::MatrixXd::Zero(inner[0].rows(), inner[0].cols()), log_determinant};
    for (std::size_t d = 0; d < inner.size(); ++d) {
      const double divisor = 1 + drop_variance * own[d];
      all.sum += inner[d] - drop_variance / divisor * crossed[d] * crossed[d].transpose();
      all.log_determinant += std::log(divisor);
    }
    return all;
  }
};

ByDrop by_drop(const RowCovariance& covariance, const RowVariances& variances,
               const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd wide(columns.rows(), columns.cols() + 1);
  wide << columns, covariance.of_drop();
  const BandRoot root = covariance.divided(variances, std::move(wide));
  ByDrop found;
  found.log_determinant = root.log_determinant;
  const auto& drops = covariance.drops();
  for (std::size_t d = 0; d + 1 < drops.size(); ++d) {
    const auto part = root.columns.middleRows(drops[d], drops[d + 1] - drops[d]);
    const auto own = part.leftCols(columns.cols());
    found.inner.push_back(own.transpose() * own);
    found.crossed.push_back(own.transpose() * part.rightCols(1));
    found.own.push_back(part.rightCols(1).squaredNorm());
  }
  return found;
}

class Grid {
 public:
  Grid(const Linearised& at, const std::vector<LawParameter>& parameters, const TimingKnown& timing,
       double usual_variance)
      : at_(at), parameters_(parameters), timing_(timing), covariance_(at.rows), usual_(usual_variance) {
    columns_.resize(at.residual.size(), 1 + at.slope.cols());
    columns_ << at.residual, at.slope;
    precision_ = Eigen::VectorXd::Zero(at.value.size());
    away_ = Eigen::VectorXd::Zero(at.value.size());
    for (Eigen::Index k = 0; k < at.value.size(); ++k) {
      const LawParameter& p = parameters[static_cast<std::size_t>(k)];
      if (p.deviation > 0) {
        precision_[k] = 1 / (p.deviation * p.deviation);
        away_[k] = at.value[k] - p.mean;
        prior_ -= std::log(p.deviation) + std::log(within(p.mean, p.deviation, p.low, p.high));
      } else {
        precision_[k] = nearly_flat / ((p.high - p.low) * (p.high - p.low));
        prior_ -= std::log(p.high - p.low) - 0.5 * std::log(2 * std::numbers::pi);
      }
    }
  }

  SpreadPosterior sum() {
    add_share(0, no_scatter);
    const int shares = static_cast<int>((share_to - share_from) / share_step) + 1;
    for (int i = 0; i < shares; ++i)
      add_share(1 / (1 + std::exp(-(share_from + i * share_step))), (1 - no_scatter) / shares);
    return weighed();
  }

 private:
  void add_share(double share, double prior) {
    const RowVariances variances{(1 - share) / covariance_.mean_timing(), share / covariance_.mean_scatter(),
                                 1 / usual_};
    const ByDrop parts = by_drop(covariance_, variances, columns_);
    const bool many = parts.inner.size() >= least_drops;
    add_volumes(parts.with(0), share, 0, prior * (many ? no_drop_scatter : 1));
    const int steps = static_cast<int>((drops_to - drops_from) / drops_step) + 1;
    for (int i = 0; many && i < steps; ++i) {
      const double weight = std::exp(drops_from + i * drops_step);
      add_volumes(parts.with(weight / covariance_.mean_scatter()), share, weight,
                  prior * (1 - no_drop_scatter) / steps);
    }
  }

  double least_volume(double share) const {
    const double noise = std::max(1e-9, timing_.resolution / std::sqrt(12.0));
    return share < 1 ? noise * noise * covariance_.mean_timing() : 1e-18;
  }

  void add_volumes(const Products& products, double share, double drop_weight, double prior) {
    const double count = static_cast<double>(at_.residual.size());
    const double degrees = std::max(1.0, count - static_cast<double>(at_.slope.cols()));
    const Eigen::MatrixXd a = products.sum.bottomRightCorner(at_.slope.cols(), at_.slope.cols());
    const Eigen::VectorXd b = products.sum.bottomLeftCorner(at_.slope.cols(), 1);
    const Eigen::MatrixXd ridge = 1e-12 * a.diagonal().asDiagonal().toDenseMatrix();
    const double left = products.sum(0, 0) - b.dot((a + ridge).ldlt().solve(b));
    const double least = least_volume(share), best = std::max(left / degrees, least);
    const double deviation = std::sqrt(2 / degrees);
    const double top = above + further / std::sqrt(degrees);
    for (double z = below; z <= top; z += volume_step) {
      const double volume = best * std::exp(z * deviation);
      if (volume < least * 0.999) continue;
      add_node(products, volume, {share, drop_weight, prior * volume_step * deviation});
    }
  }

  struct Place {
    double share, drop_weight, prior;
  };

  /// Adds the node of the scale V = `volume` with fixed covariance of the release (other_variance) beside it.
  void add_node(const Products& products, double volume, const Place& place) {
    const Eigen::Index n = at_.slope.cols();
    Eigen::MatrixXd curvature = products.sum.bottomRightCorner(n, n) / volume;
    curvature.diagonal() += precision_;
    const Eigen::VectorXd pull =
        products.sum.bottomLeftCorner(n, 1) / volume + precision_.cwiseProduct(away_);
    const Eigen::LLT<Eigen::MatrixXd> root(curvature);
    if (root.info() != Eigen::Success) return;
    const Eigen::VectorXd step = root.solve(pull);
    SpreadNode node;
    node.mean = at_.value - step;
    node.covariance = root.solve(Eigen::MatrixXd::Identity(n, n));
    node.timing = std::sqrt(volume * (1 - place.share) / covariance_.mean_timing());
    node.scatter = std::sqrt(volume * place.share / covariance_.mean_scatter());
    node.drop_scatter = std::sqrt(volume * place.drop_weight / covariance_.mean_scatter());
    const double count = static_cast<double>(at_.residual.size());
    double log = std::log(place.prior) + prior_ -
                 0.5 * (count * std::log(2 * std::numbers::pi * volume) + products.log_determinant +
                        products.sum(0, 0) / volume + precision_.dot(away_.cwiseAbs2()) - pull.dot(step));
    for (Eigen::Index k = 0; k < n; ++k) {
      const LawParameter& p = parameters_[static_cast<std::size_t>(k)];
      const double deviation = std::sqrt(node.covariance(k, k));
      log += std::log(within(node.mean[k], deviation, p.low, p.high)) - std::log(root.matrixLLT()(k, k));
    }
    if (std::isfinite(timing_.deviation) && node.timing > 0) {
      const double off = std::log(node.timing / timing_.deviation) / timing_known_to;
      log -= off * off / 2 + std::log(timing_known_to * std::sqrt(2 * std::numbers::pi));
    }
    if (!std::isfinite(log)) return;
    node.weight = log;
    nodes_.push_back(std::move(node));
  }

  SpreadPosterior weighed() {
    EXPECT(!nodes_.empty());
    SpreadPosterior all;
    double top = -1e300, sum = 0, still = 0, scatters = 0, drops_scatter = 0;
    for (const SpreadNode& node : nodes_) top = std::max(top, node.weight);
    for (SpreadNode& node : nodes_) {
      node.weight = std::exp(node.weight - top);
      sum += node.weight;
      if (node.scatter == 0)
        still += node.weight;
      else
        scatters += node.weight;
      if (node.drop_scatter > 0) drops_scatter += node.weight;
    }
    all.log_evidence = top + std::log(sum);
    all.log_evidence_still = top + std::log(std::max(still, 1e-300));
    all.scatter_odds = scatters / sum;
    all.drop_scatter_odds = drops_scatter / sum;
    for (SpreadNode& node : nodes_) {
      node.weight /= sum;
      if (node.weight > negligible) all.nodes.push_back(std::move(node));
    }
    return all;
  }

  const Linearised& at_;
  const std::vector<LawParameter>& parameters_;
  TimingKnown timing_;
  RowCovariance covariance_;
  double usual_;
  Eigen::MatrixXd columns_;
  Eigen::VectorXd precision_, away_;
  double prior_ = 0;
  std::vector<SpreadNode> nodes_;
};

/// Returns the value below which a growing function of it is `target`.
template <class Function>
double where(Function below_value, double target, double low, double high) {
  for (int i = 0; i < 45; ++i) {
    const double middle = (low + high) / 2;
    (below_value(middle) < target ? low : high) = middle;
  }
  return (low + high) / 2;
}

constexpr double tail = 0.025;

}  // namespace

SpreadPosterior spread_posterior(const Linearised& at, const std::vector<LawParameter>& parameters,
                                 const TimingKnown& timing, double usual_variance) {
  return Grid(at, parameters, timing, usual_variance).sum();
}

Eigen::VectorXd SpreadPosterior::mean() const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(nodes[0].mean.size());
  double weight = 0;
  for (const SpreadNode& node : nodes) sum += node.weight * node.mean, weight += node.weight;
  return sum / weight;
}

Eigen::MatrixXd SpreadPosterior::covariance() const {
  const Eigen::VectorXd middle = mean();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(middle.size(), middle.size());
  double weight = 0;
  for (const SpreadNode& node : nodes) {
    const Eigen::VectorXd off = node.mean - middle;
    sum += node.weight * (node.covariance + off * off.transpose());
    weight += node.weight;
  }
  return sum / weight;
}

void SpreadPosterior::add_to(std::vector<NormalPart>& parts, const LinearValue& value, double weight) const {
  for (const SpreadNode& node : nodes)
    parts.push_back({weight * node.weight, value.value + value.slope.dot(node.mean - value.at),
                     std::sqrt(std::max(1e-30, value.slope.dot(node.covariance * value.slope))), value.low,
                     value.high});
}

Estimate SpreadPosterior::estimate(const LinearValue& value) const {
  std::vector<NormalPart> parts;
  add_to(parts, value, 1);
  return estimate_of(parts);
}

Estimate estimate_of(const std::vector<NormalPart>& parts) {
  double from = 1e300, to = -1e300, all = 0;
  for (const NormalPart& part : parts) {
    from = std::min(from, std::max(part.low, part.mean - 9 * part.deviation));
    to = std::max(to, std::min(part.high, part.mean + 9 * part.deviation));
    all += part.weight;
  }
  const auto below_value = [&](double x) {
    double sum = 0;
    for (const NormalPart& part : parts) {
      const double least = normal_below((part.low - part.mean) / part.deviation);
      const double share = within(part.mean, part.deviation, part.low, part.high);
      sum += part.weight *
             std::clamp((normal_below((x - part.mean) / part.deviation) - least) / share, 0.0, 1.0);
    }
    return sum / all;
  };
  const double rounding = 1e-12 * (std::abs(to) + 1);  // where the law leaves no freedom
  return {where(below_value, 0.5, from, to), where(below_value, tail, from, to) - rounding,
          where(below_value, 1 - tail, from, to) + rounding};
}

Estimate SpreadPosterior::spread(double SpreadNode::*deviation) const {
  std::vector<std::pair<double, double>> weighed;
  double all = 0;
  for (const SpreadNode& node : nodes)
    if (node.*deviation > 0) weighed.push_back({node.*deviation, node.weight}), all += node.weight;
  if (weighed.empty()) return {not_said};
  std::sort(weighed.begin(), weighed.end());
  // Nodes are steps of a grid: between their middles the distribution is a straight line.
  const auto at = [&](double target) {
    double sum = 0, last = weighed.front().first, last_sum = 0;
    for (const auto& [value, weight] : weighed) {
      const double middle = (sum + weight / 2) / all;
      if (middle >= target) {
        const double part = middle > last_sum ? (target - last_sum) / (middle - last_sum) : 1;
        return last + std::clamp(part, 0.0, 1.0) * (value - last);
      }
      sum += weight, last = value, last_sum = middle;
    }
    return weighed.back().first;
  };
  return {at(0.5), at(tail), at(1 - tail)};
}

WhitenedColumns whitened(const Linearised& at, const Eigen::MatrixXd& columns, const SpreadNode& node) {
  const RowCovariance covariance(at.rows);
  const RowVariances variances{node.timing * node.timing, node.scatter * node.scatter};
  const double of_drop = node.drop_scatter * node.drop_scatter;
  const auto& drops = covariance.drops();
  WhitenedColumns found;
  const auto solved = [&](const Eigen::MatrixXd& right) -> Eigen::MatrixXd {
    return covariance.divided_back(variances, covariance.divided(variances, right).columns);
  };
  const Eigen::VectorXd drop = solved(covariance.of_drop());
  found.solved = solved(columns);
  for (std::size_t d = 0; of_drop > 0 && d + 1 < drops.size(); ++d) {
    const Eigen::Index first = drops[d], rows = drops[d + 1] - first;
    const Eigen::VectorXd own = covariance.of_drop().segment(first, rows), back = drop.segment(first, rows);
    const Eigen::RowVectorXd crossed = back.transpose() * columns.middleRows(first, rows);
    found.solved.middleRows(first, rows) -= of_drop / (1 + of_drop * own.dot(back)) * back * crossed;
  }
  found.products = columns.transpose() * found.solved;
  return found;
}

}  // namespace shakedown
