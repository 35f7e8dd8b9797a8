// SPDX-License-Identifier: MIT
#include "force_map.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace shakedown {

namespace {

/// Returns the antiderivative of g on an even grid, zero at its first node (trapezoidal rule; a grid step is
/// far below every width searched).
Eigen::VectorXd antiderivative(const Eigen::VectorXd& g, double step) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(g.size());
  for (Eigen::Index i = 1; i < g.size(); ++i) sum[i] = sum[i - 1] + step * (g[i] + g[i - 1]) / 2;
  return sum;
}

std::size_t index_of(ShapeOf of) { return static_cast<std::size_t>(of); }

/// Returns 1 for each frame where the smoothed motion rests on measured frames alone, else 0: over a gap it
/// makes speeds that nothing has.
Eigen::ArrayXd known_motion(const MomentumRun& run) {
  const Eigen::Index n = run.time.size(), half = smoothing_half_width(run.interval);
  Eigen::ArrayXd known = Eigen::ArrayXd::Ones(n);
  for (Eigen::Index i = 0; i < n; ++i)
    if (!run.usable[static_cast<std::size_t>(i)]) {
      const Eigen::Index first = std::max<Eigen::Index>(0, i - half), last = std::min(n - 1, i + half);
      known.segment(first, last - first + 1) = 0;
    }
  return known;
}

/// Holds the argument of the shape and what multiplies it, frame by frame.
struct Arguments {
  Eigen::ArrayXd argument, factor;
  bool is_potential = false;
};
Arguments arguments_of(ShapeOf of, const MomentumRun& run) {
  const Eigen::ArrayXd ones = Eigen::ArrayXd::Ones(run.time.size());
  switch (of) {
    case ShapeOf::position: return {run.x_box, ones};
    case ShapeOf::damping_at_x: return {run.x_box, ones, true};
    case ShapeOf::velocity: return {run.v_smooth, ones};
    case ShapeOf::damping_at_t: return {run.time, -run.v_smooth};
    case ShapeOf::stiffness_at_t: return {run.time, -run.x_box};
    case ShapeOf::time: return {run.time, ones};
    case ShapeOf::friction_at_x: return {run.x_box, -known_sign(run).sign};
  }
  return {};
}

}  // namespace

ForceMap::ForceMap(const MomentumProblem& problem, const std::vector<MomentumRun>& runs) {
  double earliest = 0;
  for (const MomentumRun& run : runs) {
    if (run.time.size() == 0) continue;
    const Eigen::ArrayXd known = known_motion(run);
    scales_.position = std::max(scales_.position, (known * run.x_smooth).abs().maxCoeff());
    scales_.velocity = std::max(scales_.velocity, (known * run.v_smooth).abs().maxCoeff());
    scales_.velocity_noise = std::max(scales_.velocity_noise, run.v_noise);
    scales_.duration = std::max(scales_.duration, run.time.maxCoeff());
    earliest = std::min(earliest, run.time.minCoeff());
  }
  const double x = 1.05 * scales_.position, v = 1.05 * scales_.velocity;
  const auto grid = [](double low, double high, Eigen::Index nodes) {
    return Grid{low, (high - low) / static_cast<double>(nodes - 1), nodes};
  };
  grid_ = {grid(-x, x, 221),
           grid(-x, x, 221),
           grid(-v, v, 201),
           grid(earliest, scales_.duration, 61),
           grid(earliest, scales_.duration, 61),
           grid(earliest, scales_.duration, 121),
           grid(-x, x, 221)};
  for (std::size_t kind = 0; kind < shape_kinds; ++kind) {
    columns_[kind] = Eigen::MatrixXd::Zero(problem.size(), grid_[kind].nodes);
    for (std::size_t run = 0; run < problem.runs(); ++run) {
      const Arguments a = arguments_of(static_cast<ShapeOf>(kind), problem.form(run).run());
      const Eigen::ArrayXd place = ((a.argument - grid_[kind].low) / grid_[kind].step)
                                       .max(0.0)
                                       .min(static_cast<double>(grid_[kind].nodes - 1) - 1e-9);
      columns_[kind].middleRows(problem.begin(run), problem.rows(run)) = problem.whiten(
          run, problem.form(run).node_columns(place, a.factor, grid_[kind].nodes, a.is_potential));
    }
  }
}

void ForceMap::project_out(const Eigen::VectorXd& residual, const Eigen::MatrixXd& orthonormal) {
  for (std::size_t kind = 0; kind < shape_kinds; ++kind) {
    const Eigen::MatrixXd fresh = columns_[kind] - orthonormal * (orthonormal.transpose() * columns_[kind]);
    gram_[kind] = fresh.transpose() * fresh;
    overlap_[kind] = fresh.transpose() * residual;
  }
}

Eigen::VectorXd ForceMap::node_values(const ForceShape& shape, const ShapeValues& values) const {
  const Grid& grid = grid_[index_of(shape.of)];
  Eigen::VectorXd g(grid.nodes);
  for (Eigen::Index i = 0; i < grid.nodes; ++i) g[i] = shape.value(grid.at(i), values);
  return shape.of == ShapeOf::damping_at_x ? antiderivative(g, grid.step) : g;
}

double ForceMap::gain(const ForceShape& shape, const ShapeValues& values) const {
  const Eigen::VectorXd nodes = node_values(shape, values);
  const std::size_t kind = index_of(shape.of);
  const double norm2 = nodes.dot(gram_[kind] * nodes), overlap = nodes.dot(overlap_[kind]);
  const double own2 = nodes.squaredNorm() * gram_[kind].diagonal().maxCoeff();
  constexpr double a_trace = 1e-9;  // rounding
  return std::isfinite(norm2) && norm2 > a_trace * own2 ? overlap * overlap / norm2 : 0;
}

ForceCurve ForceMap::curve(ShapeOf of) const {
  // A coarse grid of hats, so that every value rests on many frames.
  constexpr Eigen::Index points = 24;
  const std::size_t kind = index_of(of);
  const Grid& grid = grid_[kind];
  Eigen::MatrixXd hats(grid.nodes, points);
  const double wide = static_cast<double>(grid.nodes - 1) / static_cast<double>(points - 1);
  for (Eigen::Index p = 0; p < points; ++p) {
    Eigen::VectorXd hat(grid.nodes);
    for (Eigen::Index i = 0; i < grid.nodes; ++i)
      hat[i] = std::max(0.0, 1 - std::abs(static_cast<double>(i) / wide - static_cast<double>(p)));
    hats.col(p) = of == ShapeOf::damping_at_x ? antiderivative(hat, grid.step) : hat;
  }
  Eigen::MatrixXd normal = hats.transpose() * gram_[kind] * hats;
  const Eigen::VectorXd right = hats.transpose() * overlap_[kind];
  const Eigen::MatrixXd unridged = normal;
  normal.diagonal().array() += 1e-6 * normal.diagonal().maxCoeff();
  const Eigen::LDLT<Eigen::MatrixXd> factor(normal);
  const Eigen::VectorXd value = factor.solve(right);
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(points, points));
  const Eigen::MatrixXd covariance = inverse * unridged * inverse;
  ForceCurve curve;
  curve.of = of;
  curve.gain = 2 * value.dot(right) - value.dot(unridged * value);
  curve.parameters = (inverse * unridged).trace();
  for (Eigen::Index p = 0; p < points; ++p) {
    curve.argument.push_back(grid.low + grid.step * wide * static_cast<double>(p));
    curve.value.push_back(value[p]);
    curve.error.push_back(std::sqrt(std::max(0.0, covariance(p, p))));
  }
  return curve;
}

ForceSamples shape_samples(const ForceShape& shape, const ShapeValues& values, const MomentumRun& run) {
  const Arguments a = arguments_of(shape.of, run);
  const double small = 1e-4 * std::max(1e-9, a.argument.maxCoeff() - a.argument.minCoeff());
  const Eigen::ArrayXd step =
      shape.of == ShapeOf::velocity ? velocity_blur(run) : Eigen::ArrayXd::Constant(a.argument.size(), small);
  const Eigen::ArrayXd g = a.argument.unaryExpr([&](double at) { return shape.value(at, values); });
  const Eigen::ArrayXd slope = a.argument.binaryExpr(step, [&](double at, double by) {
    return (shape.value(at + by, values) - shape.value(at - by, values)) / (2 * by);
  });
  ForceSamples samples;
  switch (shape.of) {
    case ShapeOf::position:
      samples.force = g;
      samples.force_dx = slope;
      break;
    case ShapeOf::damping_at_x: {
      constexpr Eigen::Index nodes = 4001;
      const double low = a.argument.minCoeff(),
                   width = (a.argument.maxCoeff() - low) / static_cast<double>(nodes - 1);
      Eigen::VectorXd on_grid(nodes);
      for (Eigen::Index i = 0; i < nodes; ++i)
        on_grid[i] = shape.value(low + width * static_cast<double>(i), values);
      const Eigen::VectorXd whole = antiderivative(on_grid, width);
      samples.potential = a.argument.unaryExpr([&](double at) {
        const double place = std::clamp((at - low) / width, 0.0, static_cast<double>(nodes - 1) - 1e-6);
        const auto node = static_cast<Eigen::Index>(place);
        return whole[node] + (place - static_cast<double>(node)) * (whole[node + 1] - whole[node]);
      });
      samples.potential_dx = g;
      break;
    }
    case ShapeOf::velocity:
      samples.force = g;
      samples.force_dv = slope;
      break;
    case ShapeOf::damping_at_t:
      samples.force = -run.v_smooth * g;
      samples.force_dv = -g;
      break;
    case ShapeOf::stiffness_at_t:
      samples.force = -run.x_box * g;
      samples.force_dx = -g;
      break;
    case ShapeOf::time: samples.force = g; break;
    case ShapeOf::friction_at_x: {
      const KnownSign direction = known_sign(run);
      samples.force = -direction.sign * g;
      samples.force_dx = -direction.sign * slope;
      samples.force_dv = -direction.slope * g;
      break;
    }
  }
  return samples;
}

}  // namespace shakedown
