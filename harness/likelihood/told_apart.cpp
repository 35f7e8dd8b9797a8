// SPDX-License-Identifier: MIT
#include "told_apart.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "feature_covariance.hpp"

namespace shakedown {

namespace {

/// Returns the slopes of the features at the solution, m per unit of a knob, a column a knob: terms 1 ... of
/// the regression, which count in widths.
Eigen::MatrixXd slopes_of(const std::vector<Knob>& knobs, const Emulator& emulator) {
  Eigen::MatrixXd slopes =
      emulator.coefficients.middleRows(1, static_cast<Eigen::Index>(knobs.size())).transpose();
  for (Eigen::Index k = 0; k < slopes.cols(); ++k) slopes.col(k) /= knobs[static_cast<std::size_t>(k)].width;
  return slopes;
}

}  // namespace

ToldApart told_apart(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
                     const std::vector<Emulator>& emulators, double model_error) {
  const auto count = static_cast<Eigen::Index>(knobs.size());
  Eigen::VectorXd width(count), possible(count);
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    width[static_cast<Eigen::Index>(k)] = knobs[k].width;
    possible[static_cast<Eigen::Index>(k)] = knobs[k].high - knobs[k].low;
  }
  // Information and scatter are in widths of the knobs.
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count), scatter = information;
  for (std::size_t r = 0; r < measured.size(); ++r) {
    const Emulator& emulator = emulators[r];
    const Eigen::Index half = emulator.residuals.rows() / 2;
    const Eigen::MatrixXd slopes = slopes_of(knobs, emulator) * width.asDiagonal();
    const Eigen::LLT<Eigen::MatrixXd> weight(with_own(
        covariance_for_means(emulator.residuals.topRows(half), measured[r].plan, model_error), measured[r]));
    const Eigen::MatrixXd weighted = weight.solve(slopes);
    information += slopes.transpose() * weighted;
    scatter += weighted.transpose() *
               with_own(covariance_for_means(emulator.residuals.bottomRows(emulator.residuals.rows() - half),
                                             measured[r].plan, model_error),
                        measured[r]) *
               weighted;
    // Slopes are known from chaotic runs: even those of a parameter that does nothing are not zero, and their
    // squares would count as information.
    const Eigen::MatrixXd chaos =
        emulator.residuals.transpose() * emulator.residuals / static_cast<double>(emulator.residuals.rows());
    information -= emulator.inverse_normal.block(1, 1, count, count) * weight.solve(chaos).trace();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(information);
  information =
      axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).asDiagonal() * axes.eigenvectors().transpose();
  // Add what is known anyway: the bounds, and what is believed.
  Eigen::VectorXd known = (width.array() / possible.array()).square();
  for (Eigen::Index k = 0; k < count; ++k)
    if (const double error = knobs[static_cast<std::size_t>(k)].believed_error; error > 0)
      known[k] += std::pow(width[k] / error, 2);
  information += known.asDiagonal();
  scatter += known.asDiagonal();
  const Eigen::MatrixXd inverse = information.ldlt().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::MatrixXd spread = width.asDiagonal() * (inverse * scatter * inverse) * width.asDiagonal();
  ToldApart told{spread,
                 spread.diagonal().cwiseMax(0).cwiseSqrt(),
                 {},
                 width.cwiseQuotient(information.diagonal().cwiseSqrt())};
  const Eigen::VectorXd scale = told.error.cwiseInverse();
  told.correlation = scale.asDiagonal() * spread * scale.asDiagonal();
  return told;
}

RunComparison foretold(const MeasuredFeatures& measured, const std::vector<Knob>& knobs,
                       const Emulator& emulator, const Eigen::MatrixXd& parameters, double model_error) {
  const Eigen::MatrixXd slopes = slopes_of(knobs, emulator);
  const Eigen::MatrixXd whole =
      with_own(covariance_for_means(emulator.residuals, measured.plan, model_error), measured) +
      slopes * parameters * slopes.transpose();
  RunComparison run;
  run.run = measured.run;
  run.residual = measured.values - emulator.coefficients.row(0).transpose();
  run.spread = whole.diagonal().cwiseSqrt();
  run.chi2 = run.residual.dot(whole.ldlt().solve(run.residual));
  set_errors(run, measured.plan, run.residual);
  return run;
}

}  // namespace shakedown
