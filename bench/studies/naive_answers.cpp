// SPDX-License-Identifier: MIT
#include "naive_answers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "camera_features.hpp"
#include "least_squares.hpp"
#include "linear_model.hpp"
#include "parameter_knobs.hpp"
#include "refit.hpp"

namespace shakedown {

namespace {

/// Returns the emulators that single simulations would give: each coefficient has the chaos of one, as if the
/// mean of many were not known.
std::vector<Emulator> of_one_seed(std::vector<Emulator> emulators, std::size_t knobs) {
  for (Emulator& e : emulators) {
    const Eigen::RowVectorXd chaos = e.residuals.row(0);
    e.coefficients.row(0) += chaos;
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(knobs); ++k)
      e.coefficients.row(1 + k) += e.residuals.row(1 + k % (e.residuals.rows() - 1)) - chaos;
  }
  return emulators;
}

/// Returns what each feature counts: by the camera's noise, or one for the box and nothing for the centre.
Eigen::VectorXd weights_of(const std::vector<MeasuredFeatures>& measured, bool by_noise) {
  std::vector<double> weights;
  for (const MeasuredFeatures& m : measured)
    for (const Feature& feature : m.plan.features)
      weights.push_back(by_noise ? 1 / feature.noise : feature.observable == Observable::box ? 1.0 : 0.0);
  return Eigen::Map<Eigen::VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size()));
}

/// Returns the weighted square of the residual that the columns leave.
double left_by(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns,
               const Eigen::VectorXd& weights) {
  const Eigen::VectorXd values = weights.asDiagonal() * residual;
  if (columns.cols() == 0) return values.squaredNorm();
  const Eigen::MatrixXd weighted = weights.asDiagonal() * columns;
  return (values - weighted * least_squares_coefficients(weighted, values)).squaredNorm();
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
      : measured_(measured),
        theta_(std::move(theta)),
        workshop_(workshop),
        box_(weights_of(measured, false)),
        noise_(weights_of(measured, true)) {}

  NaiveAnswers answers() {
    const std::vector<Candidate> candidates =
        candidates_for(measured_.front().setup, {}, workshop_.known, *workshop_.engine);
    for (const Candidate& candidate : candidates)
      if (candidate.knobs.empty()) offer_switch(candidate);
    const ScatterGroups groups = scatter_groups(candidates);
    offer_strengths(measured_, candidates, groups.cheap, many);
    const std::vector<MeasuredFeatures> rough = kicked_rarely(measured_);
    for (const std::vector<std::size_t>& members : groups.slow)
      offer_strengths(rough, candidates, members, few);
    for (const std::vector<std::size_t>& members : groups.dear)
      offer_strengths(measured_, candidates, members, few);
    return {least_error_.effect, akaike_.effect, one_seed_.effect};
  }

 private:
  static constexpr int few = 48, many = 224;

  std::vector<Emulator> emulators_of(const std::vector<MeasuredFeatures>& measured,
                                     const std::vector<Knob>& knobs, int count) {
    return emulate(measured, knobs, count, 100000 * ++batch_, workshop_);
  }

  void offer(const std::string& effect, const LinearModel& mean, const LinearModel& single) {
    least_error_.offer(effect, left_by(mean.residual, mean.columns, box_));
    akaike_.offer(
        effect, left_by(mean.residual, mean.columns, noise_) + 2 * static_cast<double>(mean.columns.cols()));
    one_seed_.offer(effect, left_by(single.residual, single.columns, box_));
  }

  void offer_switch(const Candidate& candidate) {
    std::vector<MeasuredFeatures> with = measured_;
    for (MeasuredFeatures& m : with) m.setup = prepared(m.setup, candidate, workshop_.known);
    const std::vector<Emulator> emulators = emulators_of(with, straight(theta_, 0.5), few);
    offer(candidate.effect, linear_model(with, emulators, theta_.size()),
          linear_model(with, of_one_seed(emulators, theta_.size()), theta_.size()));
  }

  /// Scatters the members' strengths at once; each is then fitted beside the parameters with the others
  /// absent.
  void offer_strengths(const std::vector<MeasuredFeatures>& measured,
                       const std::vector<Candidate>& candidates, const std::vector<std::size_t>& members,
                       int count) {
    if (members.empty()) return;
    const auto [knobs, candidate_of, with] =
        beside_fitted(measured, theta_, candidates, members, workshop_.known);
    const std::vector<Emulator> emulators = emulators_of(with, knobs, count);
    const std::size_t n = theta_.size();
    LinearModel mean = linear_model(with, emulators, knobs.size()),
                single = linear_model(with, of_one_seed(emulators, knobs.size()), knobs.size());
    for (LinearModel* model : {&mean, &single}) model->residual = residual_without(*model, knobs, n);
    const auto beside_theta = [&](const LinearModel& model, std::size_t k) {
      const auto fitted = static_cast<Eigen::Index>(n);
      LinearModel one{Eigen::MatrixXd(model.columns.rows(), fitted + 1), model.residual};
      one.columns << model.columns.leftCols(fitted), model.columns.col(fitted + static_cast<Eigen::Index>(k));
      return one;
    };
    akaike_.offer("", left_by(mean.residual, mean.columns.leftCols(static_cast<Eigen::Index>(n)), noise_) +
                          2 * static_cast<double>(n));
    for (std::size_t k = 0; k < candidate_of.size(); ++k)
      offer(candidates[candidate_of[k]].effect, beside_theta(mean, k), beside_theta(single, k));
  }

  const std::vector<MeasuredFeatures>& measured_;
  std::vector<Knob> theta_;
  const Workshop& workshop_;
  Eigen::VectorXd box_, noise_;
  Best least_error_, akaike_, one_seed_;
  int batch_ = 0;
};

}  // namespace

NaiveAnswers naive_answers(const Setup& setup, const Measurement& measurement, const Workshop& workshop) {
  const std::vector<MeasuredFeatures> measured = features_with_camera(measurement, workshop.known);
  std::vector<Knob> theta = free_parameters(setup);
  RefitOptions options;
  options.count = 96;
  const Refit fit = refit(measured, theta, workshop, options);
  for (std::size_t k = 0; k < theta.size(); ++k) theta[k].centre = fit.values[k].value;
  return Naive(measured, theta, workshop).answers();
}

}  // namespace shakedown
