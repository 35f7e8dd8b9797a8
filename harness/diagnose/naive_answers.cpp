// SPDX-License-Identifier: MIT
#include "naive_answers.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "audit.hpp"
#include "experiment_file.hpp"
#include "linear_screen.hpp"
#include "parameter_knobs.hpp"
#include "refit.hpp"

namespace shakedown {

namespace {

/// Measured less modelled, and what each knob does, features x knobs, all runs stacked.
struct Residual {
  Eigen::VectorXd values;
  Eigen::MatrixXd columns;
};

/// `one_seed`: each column from the difference of two single simulations, as if the mean of many were not known.
Residual residual_of(const std::vector<MeasuredFeatures>& measured, const std::vector<Emulator>& emulators, Eigen::Index knobs, bool one_seed) {
  Eigen::Index total = 0, at = 0;
  for (const MeasuredFeatures& m : measured) total += m.values.size();
  Residual residual{Eigen::VectorXd(total), Eigen::MatrixXd(total, knobs)};
  for (std::size_t r = 0; r < measured.size(); ++r) {
    const Emulator& e = emulators[r];
    const Eigen::Index n = measured[r].values.size();
    const Eigen::RowVectorXd chaos = (one_seed ? 1.0 : 0.0) * e.residuals.row(0);
    residual.values.segment(at, n) = measured[r].values - (e.coefficients.row(0) + chaos).transpose();
    for (Eigen::Index k = 0; k < knobs; ++k) {
      Eigen::RowVectorXd column = e.coefficients.row(1 + k);
      if (one_seed) column += e.residuals.row(1 + k % (e.residuals.rows() - 1)) - chaos;
      residual.columns.col(k).segment(at, n) = column.transpose();
    }
    at += n;
  }
  return residual;
}

/// What a feature counts: of the box alone, or by the camera's noise.
Eigen::VectorXd weights_of(const std::vector<MeasuredFeatures>& measured, bool by_noise) {
  std::vector<double> weights;
  for (const MeasuredFeatures& m : measured)
    for (const Feature& feature : m.plan.features) weights.push_back(by_noise ? 1 / feature.noise : feature.observable == Observable::box ? 1.0 : 0.0);
  return Eigen::Map<Eigen::VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size()));
}

/// Weighted square that the columns leave.
double left_by(const Residual& residual, const Eigen::MatrixXd& columns, const Eigen::VectorXd& weights) {
  const Eigen::VectorXd values = weights.asDiagonal() * residual.values;
  if (columns.cols() == 0) return values.squaredNorm();
  const Eigen::MatrixXd weighted = weights.asDiagonal() * columns;
  return (values - weighted * weighted.colPivHouseholderQr().solve(values)).squaredNorm();
}

struct Best {
  std::string effect;
  double left = std::numeric_limits<double>::infinity();
  void offer(const std::string& other, double other_left) {
    if (other_left < left) effect = other, left = other_left;
  }
};

class Naive {
 public:
  Naive(const std::vector<MeasuredFeatures>& measured, std::vector<Knob> theta, const Workshop& workshop)
      : measured_(measured), theta_(std::move(theta)), workshop_(workshop), box_(weights_of(measured, false)), noise_(weights_of(measured, true)) {}

  NaiveAnswers answers() {
    const std::vector<Candidate> candidates = candidates_for(measured_.front().setup, {}, workshop_.known);
    for (const Candidate& candidate : candidates)
      if (candidate.knobs.empty()) offer_switch(candidate);
    offer_strengths(candidates);
    return {least_error_.effect, akaike_.effect, one_seed_.effect};
  }

 private:
  static constexpr int few = 48, many = 224;

  std::vector<Emulator> emulators_of(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs, int count) {
    return emulate(measured, knobs, count, 100000 * ++batch_, workshop_);
  }

  void offer(const std::string& effect, const Residual& mean, const Residual& single, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& single_columns) {
    least_error_.offer(effect, left_by(mean, columns, box_));
    akaike_.offer(effect, left_by(mean, columns, noise_) + 2 * static_cast<double>(columns.cols()));
    one_seed_.offer(effect, left_by(single, single_columns, box_));
  }

  void offer_switch(const Candidate& candidate) {
    std::vector<MeasuredFeatures> with = measured_;
    for (MeasuredFeatures& m : with) m.setup = prepared(m.setup, candidate, workshop_.known);
    const std::vector<Emulator> emulators = emulators_of(with, theta_, few);
    const auto n = static_cast<Eigen::Index>(theta_.size());
    const Residual mean = residual_of(with, emulators, n, false), single = residual_of(with, emulators, n, true);
    offer(candidate.effect, mean, single, mean.columns, single.columns);
  }

  /// All strengths scattered at once; each is then fitted beside the parameters with the others absent.
  void offer_strengths(const std::vector<Candidate>& candidates) {
    std::vector<Knob> knobs = theta_;
    std::vector<std::string> effects;
    std::vector<MeasuredFeatures> with = measured_;
    for (const Candidate& candidate : candidates) {
      for (Knob knob : candidate.knobs) {
        knob.curved = false;
        knobs.push_back(knob);
        effects.push_back(candidate.effect);
      }
      if (!candidate.knobs.empty())
        for (MeasuredFeatures& m : with) m.setup = prepared(m.setup, candidate, workshop_.known);
    }
    const auto n_theta = static_cast<Eigen::Index>(theta_.size()), n = static_cast<Eigen::Index>(knobs.size());
    const std::vector<Emulator> emulators = emulators_of(with, knobs, many);
    Residual mean = residual_of(with, emulators, n, false), single = residual_of(with, emulators, n, true);
    for (Residual* residual : {&mean, &single})
      for (Eigen::Index k = n_theta; k < n; ++k) {
        const Knob& knob = knobs[static_cast<std::size_t>(k)];
        residual->values -= residual->columns.col(k) * knob.z_of(when_absent(knob));
      }
    const Eigen::MatrixXd theta = mean.columns.leftCols(n_theta), single_theta = single.columns.leftCols(n_theta);
    akaike_.offer("", left_by(mean, theta, noise_) + 2 * static_cast<double>(n_theta));
    for (std::size_t k = 0; k < effects.size(); ++k) {
      const Eigen::Index column = n_theta + static_cast<Eigen::Index>(k);
      Eigen::MatrixXd columns(theta.rows(), n_theta + 1), single_columns(theta.rows(), n_theta + 1);
      columns << theta, mean.columns.col(column);
      single_columns << single_theta, single.columns.col(column);
      offer(effects[k], mean, single, columns, single_columns);
    }
  }

  const std::vector<MeasuredFeatures>& measured_;
  std::vector<Knob> theta_;
  const Workshop& workshop_;
  Eigen::VectorXd box_, noise_;
  Best least_error_, akaike_, one_seed_;
  int batch_ = 0;
};

}  // namespace

NaiveAnswers naive_answers(const Setup& setup, const Experiment& experiment, const Workshop& workshop) {
  const std::vector<MeasuredFeatures> measured = features_of(experiment, audit(experiment), setups_of_runs(setup, experiment, workshop.known));
  std::vector<Knob> theta = free_parameters(setup);
  RefitOptions options;
  options.count = 96;
  const Refit fit = refit(measured, theta, workshop, options);
  for (std::size_t k = 0; k < theta.size(); ++k) {
    theta[k].centre = fit.values[k].value;
    theta[k].width *= 0.5;
    theta[k].curved = false;
  }
  return Naive(measured, theta, workshop).answers();
}

}  // namespace shakedown
