// SPDX-License-Identifier: MIT
#include "momentum_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "least_squares.hpp"

namespace shakedown {

BandFactor::BandFactor(const Eigen::MatrixXd& covariance) {
  const Eigen::Index n = covariance.rows();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i - band_; ++j)
      if (covariance(i, j) != 0) {
        band_ = i - j;
        break;
      }
  rows_ = Eigen::MatrixXd::Zero(band_ + 1,
                                n);  // column i of rows_ is row i of the factor: close together in memory
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - band_); j <= i; ++j) {
      double sum = covariance(i, j);
      for (Eigen::Index k = std::max<Eigen::Index>(0, i - band_); k < j; ++k)
        if (k >= j - band_) sum -= rows_(k - i + band_, i) * rows_(k - j + band_, j);
      rows_(j - i + band_, i) =
          j == i ? std::sqrt(std::max(sum, 1e-30 * covariance(i, i))) : sum / rows_(band_, j);
    }
}

Eigen::MatrixXd BandFactor::whiten(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd out = values;
  for (Eigen::Index column = 0; column < out.cols(); ++column)
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
      const Eigen::Index reach = std::min(i, band_);
      const double sum =
          rows_.col(i).segment(band_ - reach, reach).dot(out.col(column).segment(i - reach, reach));
      out(i, column) = (out(i, column) - sum) / rows_(band_, i);
    }
  return out;
}

double BandFactor::log_determinant() const { return 2 * rows_.row(band_).array().log().sum(); }

Eigen::VectorXd BandFactor::deviations() const { return rows_.colwise().norm().transpose(); }

MomentumProblem::MomentumProblem(const std::vector<MomentumRun>& runs, double window, double hop) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].time.size() == 0) continue;
    WeakForm form(runs[i], window, hop);
    constexpr int fewest_windows = 4;  // an assumption
    if (form.windows() < fewest_windows) continue;
    forms_.push_back(std::move(form));
    source_.push_back(i);
  }
  set_covariance({});
}

void MomentumProblem::keep_moving(double excursion) {
  for (WeakForm& form : forms_) {
    std::vector<char> flags;
    for (Eigen::Index w = 0; w < form.windows(); ++w) flags.push_back(form.excursion(w) > excursion);
    form.keep(flags);
  }
  set_covariance({});
}

void MomentumProblem::set_covariance(const std::vector<ForceSamples>& fitted) {
  factor_.clear();
  for (std::size_t run = 0; run < forms_.size(); ++run) {
    Eigen::MatrixXd covariance =
        forms_[run].covariance(fitted.empty() ? ForceSamples{} : fitted[source_[run]], wander_);
    // Windows that overlap by three quarters are nearly dependent; a part in 1e9 keeps the factor defined.
    if (covariance.rows() > 0) covariance.diagonal() *= 1 + 1e-9;
    factor_.emplace_back(covariance);
  }
  if (!started_) log_determinant_at_start_ = noise_penalty();
  started_ = true;
  restack();
}

double MomentumProblem::noise_penalty() const {
  double sum = -log_determinant_at_start_;
  for (const BandFactor& factor : factor_) sum += factor.log_determinant();
  return sum;
}

Eigen::Index MomentumProblem::windows() const {
  Eigen::Index total = 0;
  for (const WeakForm& form : forms_) total += form.windows();
  return total;
}

double MomentumProblem::longest() const {
  double longest = 0;
  for (const WeakForm& form : forms_)
    if (form.has_windows()) longest = std::max(longest, form.centre(form.windows() - 1) - form.centre(0));
  return longest;
}

void MomentumProblem::set_plateau(const PlateauSlope& plateau, double gain) {
  plateau_error_ = std::isfinite(plateau.slope) && plateau.error > 0 ? plateau.error : 0;
  plateau_ = plateau_error_ > 0 ? plateau.slope - gain / 2 : 0;
  restack();
}

void MomentumProblem::set_spring(double change, double error) {
  spring_ = change, spring_error_ = error;
  restack();
}

void MomentumProblem::set_nuisances(std::vector<BalanceNuisance> nuisances) {
  nuisances_ = std::move(nuisances);
  restack();
}

void MomentumProblem::restack() {
  begin_.clear();
  for (Eigen::Index total = 0; const WeakForm& form : forms_)
    begin_.push_back(total), total += form.windows();
  const Eigen::Index rows_of_runs = windows(), of_spring = spring_error_ > 0 ? 1 : 0,
                     rows_known = 1 + of_spring + std::ssize(nuisances_);
  impulse_ = Eigen::VectorXd::Zero(rows_of_runs + rows_known);
  for (std::size_t run = 0; run < forms_.size(); ++run)
    impulse_.segment(begin_[run], rows(run)) = whiten(run, forms_[run].impulse());
  if (plateau_error_ > 0) impulse_[rows_of_runs] = plateau_ / plateau_error_;
  if (of_spring > 0) impulse_[rows_of_runs + 1] = spring_ / spring_error_;
  nuisance_columns_ = Eigen::MatrixXd(impulse_.size(), std::ssize(nuisances_));
  for (Eigen::Index k = 0; k < nuisance_columns_.cols(); ++k) {
    const BalanceNuisance& nuisance = nuisances_[static_cast<std::size_t>(k)];
    nuisance_columns_.col(k) = nuisance.deviation * column(nuisance.samples);
    nuisance_columns_(rows_of_runs + 1 + of_spring + k, k) = 1;
    impulse_[rows_of_runs + 1 + of_spring + k] = -nuisance.already / nuisance.deviation;
  }
}

Eigen::VectorXd MomentumProblem::column(const std::vector<ForceSamples>& samples) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(size());
  for (std::size_t run = 0; run < forms_.size(); ++run) {
    const ForceSamples& of_run = samples[source_[run]];
    out.segment(begin_[run], rows(run)) = whiten(run, forms_[run].column(of_run));
    if (plateau_error_ > 0 && of_run.plateau != 0) out[windows()] = of_run.plateau / plateau_error_;
    if (spring_error_ > 0 && of_run.stiffness != 0) out[windows() + 1] = of_run.stiffness / spring_error_;
  }
  return out;
}

Eigen::MatrixXd MomentumProblem::harmonic(double frequency) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size(), 2);
  for (std::size_t run = 0; run < forms_.size(); ++run) {
    const MomentumRun& r = forms_[run].run();
    const Eigen::MatrixXd pair = forms_[run].harmonic(frequency) * (r.box_mass + r.grain_mass);
    out.middleRows(begin_[run], rows(run)) = whiten(run, pair);
  }
  return out;
}

Eigen::MatrixXd MomentumProblem::raw_columns(std::size_t run, const std::vector<ForceSamples>* samples,
                                             double frequency) const {
  if (samples) return forms_[run].column((*samples)[source_[run]]);
  const MomentumRun& r = forms_[run].run();
  return forms_[run].harmonic(frequency) * (r.box_mass + r.grain_mass);
}

Eigen::VectorXd MomentumProblem::raw_deviation(std::size_t run) const { return factor_[run].deviations(); }

Regression regress(const Eigen::VectorXd& impulse, const Eigen::MatrixXd& columns) {
  Regression fit;
  fit.degrees = static_cast<double>(impulse.size() - columns.cols());
  fit.residual = impulse;
  fit.chi2 = impulse.squaredNorm();
  if (columns.cols() == 0) return fit;
  // Columns differ by many orders of magnitude (N s/m beside N s^2/m^2): scale them to length 1 before the
  // normal equations.
  const Eigen::VectorXd length = columns.colwise().norm().cwiseMax(1e-300).transpose();
  const Eigen::MatrixXd scaled = columns * length.cwiseInverse().asDiagonal();
  fit.strength = shortest_coefficients(scaled, impulse);
  fit.residual = impulse - scaled * fit.strength;
  const Eigen::MatrixXd inverse = pseudo_inverse(scaled.transpose() * scaled);
  fit.strength = fit.strength.cwiseQuotient(length);
  fit.covariance = length.cwiseInverse().asDiagonal() * inverse * length.cwiseInverse().asDiagonal();
  fit.error = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  fit.chi2 = fit.residual.squaredNorm();
  return fit;
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return columns;
  return columns.householderQr().householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

Gain gain_of(const Eigen::VectorXd& residual, const Eigen::MatrixXd& orthonormal,
             const Eigen::VectorXd& candidate, bool never_negative) {
  Eigen::VectorXd fresh = candidate;
  for (int twice = 0; twice < 2; ++twice) fresh -= orthonormal * (orthonormal.transpose() * fresh);
  const double norm2 = fresh.squaredNorm();
  constexpr double rounding = 1e-12;
  if (!(norm2 > rounding * candidate.squaredNorm())) return {};
  Gain gain;
  gain.strength = fresh.dot(residual) / norm2;
  gain.error = 1 / std::sqrt(norm2);
  if (never_negative && gain.strength < 0) return gain;
  gain.gain = gain.strength * gain.strength * norm2;
  return gain;
}

}  // namespace shakedown
