// SPDX-License-Identifier: MIT
// Whether a law holds, and what does not belong to it.
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "distributions.hpp"
#include "fisher_tail.hpp"
#include "law_choice.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr int most_bends = 4;
constexpr std::size_t most_nodes = 200;       // of the grid that an outlier is weighed with
constexpr double median_of_squares = 0.4549;  // of standard normal deviates
constexpr double widened = 0.7;               // below this share of a deviation no chance brings half of them

/// Returns the most probable point of the grid.
const SpreadNode& likeliest(const SpreadPosterior& posterior) {
  return *std::max_element(posterior.nodes.begin(), posterior.nodes.end(),
                           [](const SpreadNode& a, const SpreadNode& b) { return a.weight < b.weight; });
}

/// The columns of candidates: a jump of e at each impact, then an error of each instant between two flights.
struct Candidates {
  Eigen::MatrixXd columns;
  std::vector<std::size_t> row;
  std::vector<OutlierKind> kind;
};

Candidates candidates_of(const Linearised& at) {
  Candidates all;
  const std::size_t count = at.rows.size();
  const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  all.columns = Eigen::MatrixXd::Zero(index(count), index(2 * count));
  for (std::size_t i = 0; i < count; ++i) {
    all.columns(index(i), index(i)) = at.rows[i].per_restitution;
    all.row.push_back(i), all.kind.push_back(OutlierKind::impact);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto put = [&](std::size_t j, std::size_t place) {
      if (j < count && at.rows[j].flights == at.rows[i].flights)
        all.columns(index(j), index(count + i)) = at.rows[j].instants[place];
    };
    put(i, 1);
    put(i + 1, 0);
    if (i > 0) put(i - 1, 2);
    all.row.push_back(i), all.kind.push_back(OutlierKind::instant);
  }
  return all;
}

std::string sentence(const ImpactRow& row, OutlierKind kind, double size, double expected) {
  if (kind == OutlierKind::instant)
    return fmt::format("its instant is {:.2f} ms too {}", std::abs(size) * 1e3, size > 0 ? "late" : "early");
  const double share = 100 * size / expected;
  return fmt::format(
      "left with {:.1f} % {} speed than its like at {:.2f} m/s: {}", std::abs(share),
      size < 0 ? "less" : "more", row.speed,
      size < 0 ? "an edge was hit, or it went into spin" : "it came with spin, or off an edge");
}

/// Returns Legendre's polynomials of the logarithm of the speed, from -1 at the slowest to 1 at the fastest,
/// times the change of each row by e.
Eigen::MatrixXd columns_of_bends(const Linearised& at, int first, int count) {
  double low = 1e300, high = 0;
  for (const ImpactRow& row : at.rows) low = std::min(low, row.speed), high = std::max(high, row.speed);
  Eigen::MatrixXd columns(at.residual.size(), count);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const ImpactRow& row = at.rows[static_cast<std::size_t>(i)];
    const double x =
        high > low ? std::clamp(2 * std::log(row.speed / low) / std::log(high / low) - 1, -1.0, 1.0) : 0;
    for (int k = 0; k < count; ++k)
      columns(i, k) = row.per_restitution * std::legendre(static_cast<unsigned>(first + k), x);
  }
  return columns;
}

/// Returns the fall of r^T C^-1 r by these columns, from the products of [r, columns].
double gain_of(const Eigen::MatrixXd& products) {
  const Eigen::Index n = products.cols() - 1;
  Eigen::MatrixXd a = products.bottomRightCorner(n, n);
  const Eigen::VectorXd scale = a.diagonal().cwiseSqrt().cwiseMax(1e-150).cwiseInverse();
  a = scale.asDiagonal() * a * scale.asDiagonal();
  a.diagonal().array() += 1e-10;
  const Eigen::VectorXd b = scale.asDiagonal() * products.bottomLeftCorner(n, 1);
  return b.dot(a.ldlt().solve(b));
}

/// The size of each column as the only thing that the law lacks, and that over its error.
struct Jumps {
  Eigen::VectorXd size, sigmas;
};

Jumps jumps_of(const Linearised& at, const Eigen::MatrixXd& candidates, const SpreadNode& node) {
  const Eigen::Index own = at.slope.cols(), all = candidates.cols();
  Eigen::MatrixXd columns(at.residual.size(), 1 + own + all);
  columns << at.residual, at.slope, candidates;
  const Eigen::MatrixXd products = whitened(at, columns, node).products;
  Eigen::MatrixXd curvature = products.block(1, 1, own, own);
  curvature.diagonal() *= 1 + 1e-9;
  const Eigen::LDLT<Eigen::MatrixXd> fitted(curvature);
  const Eigen::VectorXd pulls = products.col(0).segment(1, own), pulled = fitted.solve(pulls);
  Jumps jumps{Eigen::VectorXd::Zero(all), Eigen::VectorXd::Zero(all)};
  for (Eigen::Index k = 0; k < all; ++k) {
    const Eigen::VectorXd beside = products.col(1 + own + k).segment(1, own);
    const double alone = products(1 + own + k, 1 + own + k), left = alone - beside.dot(fitted.solve(beside));
    if (left < 1e-6 * alone) continue;
    jumps.size[k] = (products(0, 1 + own + k) - beside.dot(pulled)) / left;
    jumps.sigmas[k] = jumps.size[k] * std::sqrt(left);
  }
  return jumps;
}

}  // namespace

std::vector<Outlier> odd_ones(const LawFit& fit, double by_chance) {
  const Candidates candidates = candidates_of(fit.at);
  const Jumps jumps = jumps_of(fit.at, candidates.columns, likeliest(fit.posterior));
  const Eigen::Index count = fit.at.residual.size();
  // Several outliers widen the spread that they are measured by: then the middle of the others is taken.
  std::vector<double> squares;
  for (Eigen::Index k = 0; k < count; ++k) squares.push_back(jumps.sigmas[k] * jumps.sigmas[k]);
  const double usual = std::sqrt(median(squares) / median_of_squares);
  const double scale = usual < widened ? std::max(usual, 0.5) : 1;
  const double degrees = std::max(1.0, static_cast<double>(count - fit.at.slope.cols() - 1));
  std::vector<Outlier> found;
  for (Eigen::Index k = 0; k < jumps.sigmas.size(); ++k) {
    const double sigmas = jumps.sigmas[k] / scale, size = jumps.size[k];
    if (student_two_sided_tail(std::abs(sigmas), degrees) * static_cast<double>(2 * count) > by_chance)
      continue;
    const std::size_t at = static_cast<std::size_t>(k);
    const ImpactRow& row = fit.at.rows[candidates.row[at]];
    const bool instant = candidates.kind[at] == OutlierKind::instant;
    const double expected = instant ? 0 : row.restitution - size;
    found.push_back({row.drop, row.impact, candidates.kind[at], instant ? size : row.restitution, expected,
                     sigmas, sentence(row, candidates.kind[at], size, expected)});
  }
  std::stable_sort(found.begin(), found.end(), [](const Outlier& a, const Outlier& b) {
    return std::abs(a.sigmas) > std::abs(b.sigmas);
  });
  return found;
}

double chance_of(const Outlier& odd, const LawFit& fit, const LawFit& without) {
  const Candidates all = candidates_of(fit.at);
  Eigen::Index column = -1;
  for (std::size_t k = 0; k < all.row.size(); ++k)
    if (const ImpactRow& row = fit.at.rows[all.row[k]];
        row.drop == odd.drop && row.impact == odd.impact && all.kind[k] == odd.kind)
      column = static_cast<Eigen::Index>(k);
  if (column < 0) return 1;
  std::vector<const SpreadNode*> nodes;
  for (const SpreadNode& node : without.posterior.nodes) nodes.push_back(&node);
  std::sort(nodes.begin(), nodes.end(),
            [](const SpreadNode* a, const SpreadNode* b) { return a->weight > b->weight; });
  nodes.resize(std::min(nodes.size(), most_nodes));
  double sum = 0, weight = 0;
  for (const SpreadNode* node : nodes) {
    const Jumps jump = jumps_of(fit.at, all.columns.col(column), *node);
    sum += node->weight * std::erfc(std::abs(jump.sigmas[0]) / std::numbers::sqrt2);
    weight += node->weight;
  }
  return sum / weight * static_cast<double>(all.row.size());
}

LawTest test_of(const LawFit& fit, const TimingKnown& timing) {
  LawTest test;
  const Eigen::Index own = fit.at.slope.cols(), count = fit.at.residual.size();
  const int bends = std::min<int>(most_bends, static_cast<int>(count - own - 1) / 2);
  const int first = static_cast<int>(law_of(fit.model.law).parameters.size());
  Eigen::MatrixXd columns(count, 1 + own + std::max(bends, 0));
  columns << fit.at.residual, fit.at.slope, columns_of_bends(fit.at, first, std::max(bends, 0));
  const auto chi2_of = [&](const SpreadNode& node, Eigen::Index used) {
    const Eigen::MatrixXd products = whitened(fit.at, columns, node).products;
    return products(0, 0) - gain_of(products.topLeftCorner(1 + used, 1 + used));
  };
  const SpreadNode& node = likeliest(fit.posterior);
  test.chi2 = chi2_of(node, own);
  test.degrees = static_cast<double>(count - own);
  if (std::isfinite(timing.deviation)) {
    SpreadNode alone = node;
    alone.timing = timing.deviation, alone.scatter = alone.drop_scatter = 0;
    test.chi2_by_timing = chi2_of(alone, own) / std::max(1.0, test.degrees);
  }
  if (bends < 1) return test;
  const double left = chi2_of(node, own + bends);
  test.bends = bends;
  test.gain = std::max(0.0, test.chi2 - left);
  const double rest = test.degrees - bends;
  test.p_value = fisher_tail(test.gain / bends / std::max(left / rest, 1e-12), bends, rest);
  return test;
}

}  // namespace shakedown
