// SPDX-License-Identifier: MIT
#include "linear_screen.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace shakedown {

namespace {

/// Columns (features x knobs) and residual of one experiment, whitened and stacked over the runs.
struct Linear {
  Eigen::MatrixXd columns;
  Eigen::VectorXd residual;
};

Linear whitened(const std::vector<MeasuredFeatures>& measured, const std::vector<Emulator>& emulators, Eigen::Index knobs) {
  Eigen::Index total = 0, at = 0;
  for (const MeasuredFeatures& m : measured) total += m.values.size();
  Linear linear{Eigen::MatrixXd(total, knobs), Eigen::VectorXd(total)};
  for (std::size_t r = 0; r < measured.size(); ++r) {
    const Emulator& e = emulators[r];
    Eigen::MatrixXd covariance = e.residuals.transpose() * e.residuals / static_cast<double>(e.residuals.rows());
    const Eigen::VectorXd variance = covariance.diagonal();
    covariance *= 0.8;
    for (Eigen::Index f = 0; f < variance.size(); ++f) {
      const double noise = measured[r].plan.features[static_cast<std::size_t>(f)].noise;
      covariance(f, f) += 0.2 * variance[f] + noise * noise;
    }
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    const Eigen::Index n = variance.size();
    linear.columns.middleRows(at, n) = root.matrixL().solve(e.coefficients.middleRows(1, knobs).transpose());
    linear.residual.segment(at, n) = root.matrixL().solve(measured[r].values - e.coefficients.row(0).transpose());
    at += n;
  }
  return linear;
}

}  // namespace

std::vector<ScreenedEffect> screen(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
                                   const std::vector<Candidate>& candidates, const Workshop& workshop, int count, int first_run) {
  std::vector<Knob> knobs = fitted;
  std::vector<std::size_t> candidate_of;
  for (Knob& knob : knobs) {
    knob.width /= 2;
    knob.curved = false;
  }
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (Knob knob : candidates[c].knobs) {
      knob.curved = false;
      knobs.push_back(knob);
      candidate_of.push_back(c);
    }
  const auto n_knobs = static_cast<Eigen::Index>(knobs.size()), n_fitted = static_cast<Eigen::Index>(fitted.size());
  const Linear linear = whitened(measured, emulate(measured, knobs, count, first_run, workshop), n_knobs);
  // What the fitted parameters cannot take up.
  const Eigen::MatrixXd free = linear.columns.leftCols(n_fitted);
  const Eigen::LDLT<Eigen::MatrixXd> normal(free.transpose() * free + 1e-9 * Eigen::MatrixXd::Identity(n_fitted, n_fitted));
  const auto outside = [&](const Eigen::VectorXd& column) -> Eigen::VectorXd { return column - free * normal.solve(free.transpose() * column); };
  const Eigen::VectorXd residual = outside(linear.residual);
  std::vector<ScreenedEffect> list;
  std::vector<Eigen::VectorXd> signatures;
  for (Eigen::Index k = n_fitted; k < n_knobs; ++k) {
    const Knob& knob = knobs[static_cast<std::size_t>(k)];
    const Eigen::VectorXd signature = outside(linear.columns.col(k));
    const double square = signature.squaredNorm(), z = square > 0 ? signature.dot(residual) / square : 0;
    const bool allowed = knob.at(z) != knob.at(0) || z == 0;  // a drag cannot push
    const std::size_t c = candidate_of[static_cast<std::size_t>(k - n_fitted)];
    list.push_back({c, candidates[c].effect, allowed ? z * z * square : 0, knob.at(z), {}});
    signatures.push_back(signature);
  }
  for (std::size_t a = 0; a < list.size(); ++a)
    for (std::size_t b = 0; b < list.size(); ++b) {
      const double cosine = signatures[a].dot(signatures[b]) / std::max(1e-300, signatures[a].norm() * signatures[b].norm());
      if (a != b && std::abs(cosine) > 0.9 && list[a].effect != list[b].effect) list[a].look_alikes.push_back(list[b].effect);
    }
  // On or off: the model with it, beside the model without.
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!candidates[c].knobs.empty()) continue;
    std::vector<MeasuredFeatures> with = measured;
    for (MeasuredFeatures& m : with) m.setup = prepared(m.setup, candidates[c], workshop.known);
    const Linear changed = whitened(with, emulate(with, fitted, std::max(60, count / 4), first_run + 50000, workshop), n_fitted);
    const Eigen::MatrixXd columns = changed.columns;
    const Eigen::VectorXd rest = changed.residual - columns * (columns.transpose() * columns).ldlt().solve(columns.transpose() * changed.residual);
    list.push_back({c, candidates[c].effect, residual.squaredNorm() - rest.squaredNorm(), 0, {}});
  }
  std::stable_sort(list.begin(), list.end(), [](const ScreenedEffect& a, const ScreenedEffect& b) { return a.gain > b.gain; });
  return list;
}

}  // namespace shakedown
