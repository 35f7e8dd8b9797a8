// SPDX-License-Identifier: MIT
#include "ideal_signal.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "features.hpp"
#include "hideable.hpp"
#include "in_order.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int samples_a_bin = 10;

/// Returns the width of a bin of a planned setup, s.
double bin_of(const Setup& planned) { return samples_a_bin / planned.run.sample_rate; }

/// Returns means over bins of the box, then of the grains' centre, m; as many of every run of a setup,
/// whichever sample is its last.
Vector features_of(const Trajectory& motion, const Setup& setup) {
  const bool grains = setup.grains.count > 0;
  const auto bins = static_cast<Eigen::Index>(std::floor(setup.run.duration / bin_of(setup) + 1e-9));
  Vector features = Vector::Zero(grains ? 2 * bins : bins);
  for (Eigen::Index b = 0; b < bins; ++b)
    for (int i = 0; i < samples_a_bin; ++i) {
      const std::size_t sample =
          std::min(motion.time.size() - 1, static_cast<std::size_t>(b * samples_a_bin + i));
      features(b) += motion.x_box[sample] / samples_a_bin;
      if (grains) features(bins + b) += motion.x_com[sample] / samples_a_bin;
    }
  return features;
}

/// Holds the simulations of one planned run, a column each.
struct Runs {
  Matrix all;
  Vector mean() const { return all.rowwise().mean(); }
  Matrix residuals() const { return all.colwise() - mean(); }
};

class Simulations {
 public:
  /// `frequency`: of the spring as it is believed to be, Hz, for one width of all bins.
  Simulations(const IdealSettings& settings, const TrialTools& tools, double frequency)
      : settings_(settings), tools_(tools), sample_rate_(samples_a_bin * frequency / bin_of_a_period) {}

  Runs simulated(const Setup& setup, int first, int count) const {
    std::vector<Vector> columns;
    work_in_parallel_deliver_in_order(
        count, threads_or_all(tools_.execution.threads), [&](int i) -> std::function<void()> {
          RunOptions options;
          options.run = first + i;
          options.stop = tools_.execution.stop;
          const Trajectory motion = tools_.model->run(setup, options);
          if (motion.interrupted) throw Interrupted("no signal was measured");
          return [&columns, features = features_of(motion, setup)] { columns.push_back(features); };
        });
    Runs runs{Matrix(columns.front().size(), count)};
    for (int i = 0; i < count; ++i) runs.all.col(i) = columns[static_cast<std::size_t>(i)];
    return runs;
  }

  KnownEffects known() const { return tools_.known; }

  Setup planned(const Setup& setup, const PlannedRun& run) const {
    Setup planned = changed(setup, run.overrides, tools_.known);
    planned.run.seed = settings_.seed;
    planned.run.sample_rate = sample_rate_;
    return planned;
  }

 private:
  const IdealSettings& settings_;
  const TrialTools& tools_;
  double sample_rate_;  // 1/s
};

/// Returns the variance of the camera's white noise in each bin, m^2.
Vector noise_of(const RecordingSettings& camera, Eigen::Index features, bool grains, double bin) {
  const double frames = std::max(1.0, camera.frame_rate * bin * (1 - camera.missing));
  Vector noise = Vector::Constant(features, camera.box_noise * camera.box_noise / frames);
  if (grains) noise.tail(features / 2).setConstant(camera.centre_noise * camera.centre_noise / frames);
  return noise;
}

/// Returns the ln likelihood of data with this sample covariance, for each of them, up to a constant.
double log_likelihood(const Matrix& covariance, const Matrix& sample) {
  const Eigen::LLT<Matrix> root(covariance);
  return -0.5 * root.solve(sample).trace() - root.matrixLLT().diagonal().array().log().sum();
}

Matrix sample_covariance(const Matrix& residuals, Eigen::Index means) {
  return residuals * residuals.transpose() / static_cast<double>(residuals.cols() - means);
}

/// Returns this half's spread, drawn towards its diagonal as far as the other half finds most likely.
Matrix likely_covariance(const Matrix& sample, const Matrix& other, const Vector& noise) {
  constexpr std::array<double, 6> towards_diagonal{0.05, 0.1, 0.2, 0.4, 0.6, 0.9};
  Matrix best, noisy = other;
  noisy.diagonal() += noise;
  double most = -std::numeric_limits<double>::infinity();
  for (const double share : towards_diagonal) {
    Matrix covariance = (1 - share) * sample;
    covariance.diagonal() += share * sample.diagonal() + noise;
    const double likelihood = log_likelihood(covariance, noisy);
    if (likelihood > most) most = likelihood, best = std::move(covariance);
  }
  return best;
}

/// Holds one planned run, in two halves.
struct Block {
  std::array<Matrix, 2> signatures;        ///< a column each change
  std::array<Matrix, 2> covariance;        ///< to find directions with
  std::array<Matrix, 2> plain_covariance;  ///< to weigh them with
  Matrix unknown_to_all, unknown_of_run;   ///< columns, each times its standard deviation
  Matrix wander;                           ///< covariance of a wandering track
};

/// Returns the velocity in each bin of box and grains, m/s.
Vector velocities(const Vector& mean, Eigen::Index bins, double bin) {
  Vector velocity(mean.size());
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    const Eigen::Index first = i < bins ? 0 : bins, low = std::max(first, i - 1),
                       high = std::min(first + bins - 1, i + 1);
    velocity(i) = (mean(high) - mean(low)) / (bin * static_cast<double>(high - low));
  }
  return velocity;
}

/// Returns what the camera's errors in all runs do to each bin, m: lens, rows that are read one after the
/// other, grains nearer than the marker. Columns of nothing where the camera has no such error.
Matrix columns_of_camera(const Vector& mean, Eigen::Index bins, const RecordingSettings& camera, double bin) {
  Matrix columns = Matrix::Zero(mean.size(), 3);
  columns.col(0) = camera.lens * mean.array() * (mean.array() / camera_lens_reach).square();
  columns.col(1) = camera.shutter * velocities(mean, bins, bin).array() * (mean.array() / camera_track + 0.5);
  if (mean.size() > bins) columns.col(2).tail(bins) = camera.near * mean.tail(bins);
  return columns;
}

/// Returns the covariance of a track that wanders, m^2: of means over bins, box and grains apart.
Matrix wander_of(Eigen::Index features, Eigen::Index bins, const RecordingSettings& camera, double bin) {
  Matrix covariance = Matrix::Zero(features, features);
  if (camera.wander <= 0) return covariance;
  for (Eigen::Index i = 0; i < features; ++i)
    for (Eigen::Index j = 0; j < features; ++j)
      if ((i < bins) == (j < bins))
        covariance(i, j) = camera.wander * camera.wander *
                           std::exp(-bin * static_cast<double>(std::abs(i - j)) / camera.wander_time);
  return covariance;
}

Block block_of(const Setup& without, const std::vector<Setup>& with, const IdealSettings& settings,
               const Simulations& simulations) {
  const int n = settings.count, changes = static_cast<int>(with.size());
  const bool grains = without.grains.count > 0;
  const RecordingSettings& camera = settings.recording;
  const double bin = bin_of(without);
  Block block;
  std::array<Matrix, 2> spread;
  Vector mean;
  for (const int half : {0, 1}) {
    const Runs plain = simulations.simulated(without, half * n, n);
    mean = plain.mean();
    Matrix residuals(mean.size(), (1 + changes) * n), signatures(mean.size(), changes);
    residuals.leftCols(n) = plain.residuals();
    for (int k = 0; k < changes; ++k) {
      const Runs altered = simulations.simulated(with[static_cast<std::size_t>(k)], (2 + half) * n, n);
      signatures.col(k) = altered.mean() - mean;
      residuals.middleCols((1 + k) * n, n) = altered.residuals();
    }
    block.signatures[static_cast<std::size_t>(half)] = signatures;
    spread[static_cast<std::size_t>(half)] = sample_covariance(residuals, 1 + changes);
  }
  const Eigen::Index bins = grains ? mean.size() / 2 : mean.size();
  const Vector noise = noise_of(camera, mean.size(), grains, bin);
  block.wander = wander_of(mean.size(), bins, camera, bin);
  for (const std::size_t half : {std::size_t{0}, std::size_t{1}}) {
    block.covariance[half] = likely_covariance(spread[half], spread[1 - half], noise);
    block.plain_covariance[half] = spread[half];
    block.plain_covariance[half].diagonal() += noise;
  }
  // A law may not reach as far on one side.
  const auto mean_at = [&](const char* key, double value) -> std::optional<Vector> {
    try {
      Setup moved = without;
      set_number(moved, key, value, simulations.known());
      return simulations.simulated(moved, 4 * n, n).mean();
    } catch (const InputError&) {
      return {};
    }
  };
  const auto slope = [&](const char* key, double step) -> Vector {
    const double here = get_number(without, key);
    const std::optional<Vector> less = mean_at(key, here - step), more = mean_at(key, here + step);
    if (less && more) return (*more - *less) / (2 * step);
    if (less) return (mean - *less) / step;
    if (more) return (*more - mean) / step;
    return Vector::Zero(mean.size());
  };
  const IdealIgnorance& unknown = settings.ignorance;
  const double frequency = without.spring.frequency;
  block.unknown_of_run = Matrix::Constant(mean.size(), 3, unknown.origin);
  block.unknown_of_run.col(0) = unknown.clock * velocities(mean, bins, bin);
  block.unknown_of_run.col(2) =
      camera.release > 0
          ? Vector(camera.release * slope("release.displacement", 0.01 * without.release.displacement))
          : Vector::Zero(mean.size());
  block.unknown_to_all.resize(mean.size(), 7);
  block.unknown_to_all.rightCols(3) = columns_of_camera(mean, bins, camera, bin);
  block.unknown_to_all.col(0) = unknown.scale * mean;
  block.unknown_to_all.col(1) = unknown.frequency * frequency * slope("spring.frequency", 1e-3 * frequency);
  block.unknown_to_all.col(2) = unknown.restitution * slope("restitution.grain_grain", 0.05);
  block.unknown_to_all.col(3) = unknown.restitution * slope("restitution.grain_wall", 0.05);
  return block;
}

bool same_run(const PlannedRun& a, const PlannedRun& b) {
  return std::equal(
      a.overrides.begin(), a.overrides.end(), b.overrides.begin(), b.overrides.end(),
      [](const Override& x, const Override& y) { return x.key == y.key && x.value == y.value; });
}

/// Returns the products of the signatures of one half with those of the other, whose noises are independent,
/// so that noise adds nothing. C is of one half; the other half's spread along each direction sets its scale.
Matrix seen(const std::vector<Block>& blocks, std::size_t finds, std::size_t sees) {
  const Eigen::Index changes = blocks.front().signatures[0].cols();
  Eigen::Index size = 0;
  for (const Block& block : blocks) size += block.signatures[0].rows();
  Matrix covariance = Matrix::Zero(size, size), weighing = covariance, shared(size, 7);
  Matrix found(size, changes), other(size, changes);
  Eigen::Index at = 0;
  for (const Block& block : blocks) {
    const Eigen::Index here = block.signatures[0].rows();
    const Matrix own = block.unknown_of_run * block.unknown_of_run.transpose() + block.wander;
    covariance.block(at, at, here, here) = block.covariance[finds] + own;
    weighing.block(at, at, here, here) = block.plain_covariance[sees] + own;
    shared.middleRows(at, here) = block.unknown_to_all;
    found.middleRows(at, here) = block.signatures[finds];
    other.middleRows(at, here) = block.signatures[sees];
    at += here;
  }
  covariance += shared * shared.transpose();
  weighing += shared * shared.transpose();
  const Matrix directions = covariance.llt().solve(found);
  Matrix products = directions.transpose() * other;
  for (Eigen::Index k = 0; k < changes; ++k) {
    const auto direction = directions.col(k);
    const double variance = direction.dot(weighing * direction);
    products.row(k) *= variance > 0 ? direction.dot(covariance * direction) / variance : 0;
  }
  return products;
}

}  // namespace

std::vector<std::vector<double>> ideal_products(const Setup& without, const std::vector<Setup>& with,
                                                const IdealSettings& settings, const TrialTools& tools) {
  const Simulations simulations(settings, tools, without.spring.frequency);
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < settings.runs.size(); ++i) {
    // Repeats of a run have the same signatures and spread.
    std::size_t same = 0;
    while (same < i && !same_run(settings.runs[same], settings.runs[i])) ++same;
    if (same < i) {
      blocks.push_back(blocks[same]);
      continue;
    }
    std::vector<Setup> changed_runs;
    for (const Setup& setup : with) changed_runs.push_back(simulations.planned(setup, settings.runs[i]));
    blocks.push_back(
        block_of(simulations.planned(without, settings.runs[i]), changed_runs, settings, simulations));
  }
  const Matrix half = 0.5 * (seen(blocks, 0, 1) + seen(blocks, 1, 0)),
               products = 0.5 * (half + half.transpose());
  std::vector<std::vector<double>> rows;
  for (Eigen::Index i = 0; i < products.rows(); ++i) {
    rows.emplace_back();
    for (Eigen::Index j = 0; j < products.cols(); ++j) rows.back().push_back(products(i, j));
  }
  return rows;
}

double ideal_signal(const Setup& without, const Setup& with, const IdealSettings& settings,
                    const TrialTools& tools) {
  const double squared = ideal_products(without, {with}, settings, tools)[0][0];
  return std::copysign(std::sqrt(std::abs(squared)), squared);
}

}  // namespace shakedown
