// SPDX-License-Identifier: MIT
#include "fit_round.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "feature_covariance.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr int pseudo_experiments = 400;

}  // namespace

FitRound::FitRound(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
                   std::vector<Emulator> emulators, const RefitOptions& options)
    : measured_(measured), knobs_(knobs), emulators_(std::move(emulators)) {
  for (std::size_t r = 0; r < measured.size(); ++r) {
    const Eigen::MatrixXd& residuals = emulators_[r].residuals;
    const Eigen::MatrixXd covariance =
        with_own(feature_covariance(residuals.topRows(residuals.rows() / 2), measured[r].plan,
                                    options.model_error * measured[r].setup.release.displacement),
                 measured[r]);
    Whitened w{Eigen::LLT<Eigen::MatrixXd>(covariance), {}, covariance.diagonal().cwiseSqrt()};
    w.model = w.root.matrixL().solve(emulators_[r].coefficients.transpose());
    if (measured[r].own.cols() > 0) w.own = w.root.solve(measured[r].own);
    w.codes = std::pow(options.model_error * measured[r].setup.release.displacement, 2);
    w.chaos =
        w.root.matrixL().solve(unseen(r).transpose()).squaredNorm() / static_cast<double>(unseen(r).rows());
    w.expected = expected_sum(r, w.root);
    whitened_.push_back(std::move(w));
  }
  objective_ = objective_of(measured_values(), true);
}

double FitRound::expected_sum(std::size_t r, const Eigen::LLT<Eigen::MatrixXd>& root) const {
  const std::vector<Feature>& features = measured_[r].plan.features;
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(std::ssize(features), std::ssize(features));
  for (Eigen::Index f = 0; f < noise.rows(); ++f) noise(f, f) = features[static_cast<std::size_t>(f)].noise;
  double sum =
      root.matrixL().solve(unseen(r).transpose()).squaredNorm() / static_cast<double>(unseen(r).rows()) +
      root.matrixL().solve(noise).squaredNorm();
  if (measured_[r].own.cols() > 0) sum += root.matrixL().solve(measured_[r].own).squaredNorm();
  return sum;
}

std::vector<Emulator> FitRound::recentred(const Eigen::VectorXd& z, std::vector<Emulator> there) const {
  const Eigen::Index n = z.size();
  const Eigen::MatrixXd slopes = slopes_at(z);
  for (std::size_t r = 0; r < there.size(); ++r) {
    Emulator& e = there[r];
    const Eigen::RowVectorXd mean = e.coefficients.row(0);
    e.coefficients.resize(1 + n, mean.size());
    e.coefficients.row(0) = mean;
    e.coefficients.bottomRows(n) = slopes.transpose() * emulators_[r].coefficients;
    const double of_mean = e.inverse_normal(0, 0);
    e.inverse_normal.setZero(1 + n, 1 + n);
    e.inverse_normal(0, 0) = of_mean;
    e.inverse_normal.bottomRightCorner(n, n) = slopes.transpose() * emulators_[r].inverse_normal * slopes;
    e.terms = Eigen::MatrixXd::Zero(e.residuals.rows(), 1 + n);
    e.terms.col(0).setOnes();
  }
  return there;
}

std::vector<Emulator> FitRound::moved_to(const Eigen::VectorXd& z) const {
  std::vector<Emulator> moved = emulators_;
  for (std::size_t r = 0; r < moved.size(); ++r) moved[r].coefficients.row(0) = model(r, z).transpose();
  return moved;
}

Eigen::VectorXd FitRound::model(std::size_t r, const Eigen::VectorXd& z) const {
  return emulators_[r].coefficients.transpose() * regression_terms(knobs_, z);
}

Eigen::VectorXd FitRound::drawn(std::size_t r, const Eigen::VectorXd& z, Random& random) const {
  const auto row = static_cast<Eigen::Index>(random.uniform() * static_cast<double>(unseen(r).rows()));
  Eigen::VectorXd value = model(r, z) + unseen(r).row(row).transpose();
  for (Eigen::Index f = 0; f < value.size(); ++f)
    value[f] += measured_[r].plan.features[static_cast<std::size_t>(f)].noise * random.normal();
  for (Eigen::Index own = 0; own < measured_[r].own.cols(); ++own)
    value += measured_[r].own.col(own) * random.normal();
  return value;
}

PseudoExperiments FitRound::made_by_the_model(const Eigen::VectorXd& z,
                                              const std::vector<Cell>& cells) const {
  PseudoExperiments made{{},
                         Eigen::MatrixXd(pseudo_experiments, std::ssize(cells)),
                         std::vector(measured_.size(), Eigen::ArrayX2d(pseudo_experiments, 2))};
  std::vector<Eigen::VectorXd> values(measured_.size()), residuals(measured_.size());
  for (int e = 0; e < pseudo_experiments; ++e) {
    Random random(23, static_cast<std::uint64_t>(e), Stream::bootstrap);
    for (std::size_t r = 0; r < measured_.size(); ++r) values[r] = drawn(r, z, random);
    const Objective pseudo = objective_of(values, false);
    const Eigen::VectorXd refitted = minimum_of(pseudo, 2.5, 1, z).z;
    made.sums.push_back(pseudo.chi2(refitted));
    for (std::size_t r = 0; r < measured_.size(); ++r) {
      residuals[r] = values[r] - model(r, refitted);
      made.squares[r].row(e) = mean_squares(measured_[r].plan, without_own(r, residuals[r]));
    }
    made.cell_rows.row(e) = cell_sums(cells, residuals, spreads()).transpose();
  }
  return made;
}

std::vector<Eigen::VectorXd> FitRound::spreads() const {
  std::vector<Eigen::VectorXd> list;
  for (const Whitened& w : whitened_) list.push_back(w.spread);
  return list;
}

void FitRound::calibrate(const Eigen::VectorXd& z, double observed, Refit& result) const {
  const std::vector<Cell> cells = cells_of(measured_);
  PseudoExperiments made = made_by_the_model(z, cells);
  std::vector<double>& sums = made.sums;
  // Where a sum is no number no p-value is made of it.
  const bool finite = std::isfinite(observed) &&
                      std::all_of(sums.begin(), sums.end(), [](double sum) { return std::isfinite(sum); });
  if (finite) std::sort(sums.begin(), sums.end());
  const auto worse = std::count_if(sums.begin(), sums.end(), [&](double sum) { return sum >= observed; });
  result.p_value = finite ? (1.0 + static_cast<double>(worse)) / (1.0 + pseudo_experiments) : std::nan("");
  result.degrees = sums[sums.size() / 2];
  result.scatter = observed / result.degrees;
  const Eigen::Map<const Eigen::ArrayXd> all(sums.data(), std::ssize(sums));
  const double mean = all.mean(), effective = 2 * mean * mean / (all - mean).square().mean();
  result.far_p_value = std::min(result.p_value, chi_squared_tail(observed * effective / mean, effective));
  std::vector<Eigen::VectorXd> residuals;
  for (std::size_t r = 0; r < measured_.size(); ++r) residuals.push_back(measured_[r].values - model(r, z));
  result.cells = judge_cells(cells, residuals, spreads(), made.cell_rows);
  for (std::size_t r = 0; r < result.runs.size(); ++r) set_floors(r, z, made.squares[r], result.runs[r]);
}

void FitRound::set_floors(std::size_t r, const Eigen::VectorXd& z, const Eigen::ArrayX2d& squares,
                          RunComparison& run) const {
  // Widen by the error of the model's mean; add what two codes of one physics differ by.
  const Eigen::VectorXd phi = regression_terms(knobs_, z);
  const double wider = 1 + phi.dot(emulators_[r].inverse_normal * phi);
  const Eigen::ArrayX2d errors = (wider * squares + whitened_[r].codes).sqrt();
  const auto chance = [&](Eigen::Index observable, double error) {
    return static_cast<double>((errors.col(observable) >= error).count()) / pseudo_experiments;
  };
  const auto floor = [&](Eigen::Index observable) {
    return std::sqrt(errors.col(observable).square().mean());
  };
  run.floor_box = floor(0), run.chance_box = chance(0, run.error_box);
  if (run.floor_centre > 0) run.floor_centre = floor(1), run.chance_centre = chance(1, run.error_centre);
}

void FitRound::hold_out(Refit& result, const std::vector<JudgingRule>& rules) const {
  std::vector<double> lengths;
  for (const MeasuredFeatures& m : measured_)
    if (std::find(lengths.begin(), lengths.end(), m.setup.box.length) == lengths.end())
      lengths.push_back(m.setup.box.length);
  result.held_out_error_box = result.judged_held_out_chi2 = std::nan("");
  if (lengths.size() < 2) return;
  double box = 0, judged = 0;
  for (const double length : lengths) {
    std::vector<char> used;
    for (const MeasuredFeatures& m : measured_) used.push_back(m.setup.box.length != length);
    const Minimum minimum = minimum_of(objective_of(measured_values(), true, used), reach, 2);
    for (std::size_t r = 0; r < measured_.size(); ++r) {
      if (used[r]) continue;
      box += std::pow(comparison(r, minimum.z).error_box, 2);
      judged += judged_chi2(r, minimum.z, rules[r]);
    }
  }
  const double count = static_cast<double>(measured_.size());
  result.held_out_error_box = std::sqrt(box / count);
  result.judged_held_out_chi2 = judged;
}

Eigen::MatrixXd FitRound::covariance_at(const Eigen::VectorXd& z, double open) const {
  const Eigen::Index n = z.size();
  if (n == 0) return Eigen::MatrixXd(0, 0);
  const Eigen::VectorXd phi = regression_terms(knobs_, z);
  const Eigen::MatrixXd slopes = slopes_at(z);
  const double inflation = objective_.inflation(phi);
  Eigen::MatrixXd information = slopes.transpose() * (objective_.square - objective_.error) * slopes;
  Eigen::MatrixXd gradient = slopes.transpose() * objective_.error * slopes;
  for (std::size_t r = 0; r < measured_.size(); ++r) {
    // Columns: C^-1 J of this run, features x knobs.
    const Eigen::MatrixXd weights = whitened_[r].root.matrixU().solve(whitened_[r].model * slopes);
    const Eigen::MatrixXd chaos = unseen(r) * weights;
    gradient += inflation * chaos.transpose() * chaos / static_cast<double>(chaos.rows());
    if (measured_[r].own.cols() > 0) {
      const Eigen::MatrixXd own = measured_[r].own.transpose() * weights;
      gradient += own.transpose() * own;
    }
    for (Eigen::Index f = 0; f < weights.rows(); ++f)
      gradient += std::pow(measured_[r].plan.features[static_cast<std::size_t>(f)].noise, 2) *
                  weights.row(f).transpose() * weights.row(f);
  }
  for (Eigen::Index a = 0; a < n; ++a) {
    const Knob& knob = knobs_[static_cast<std::size_t>(a)];
    if (knob.believed_error == 0) continue;
    information(a, a) += std::pow(knob.width / knob.believed_error, 2);
    gradient(a, a) += std::pow(knob.width / knob.believed_error, 2);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(information);
  const Eigen::VectorXd inverse = axes.eigenvalues().array().max(1 / (open * open)).inverse().matrix();
  Eigen::MatrixXd covariance = inverse.asDiagonal() *
                               (axes.eigenvectors().transpose() * gradient * axes.eigenvectors()) *
                               inverse.asDiagonal();
  const Eigen::VectorXd within = (open / covariance.diagonal().array().sqrt()).min(1.0).matrix();
  covariance = within.asDiagonal() * covariance * within.asDiagonal();
  return axes.eigenvectors() * covariance * axes.eigenvectors().transpose();
}

Eigen::MatrixXd FitRound::emulator_scatter(const Eigen::VectorXd& z) const {
  constexpr Eigen::Index blocks = 10;
  Eigen::MatrixXd solutions(blocks, z.size());
  for (Eigen::Index block = 0; block < blocks; ++block) {
    Objective objective = objective_;
    objective.square.setZero();
    objective.cross.setZero();
    for (std::size_t r = 0; r < measured_.size(); ++r) {
      const Eigen::MatrixXd model =
          whitened_[r].root.matrixL().solve(emulators_[r].coefficients_without(block, blocks).transpose());
      objective.square += model.transpose() * model;
      objective.cross += model.transpose() * whitened_[r].root.matrixL().solve(measured_[r].values);
    }
    solutions.row(block) = minimum_of(objective, reach, 1, z).z.transpose();
  }
  const Eigen::MatrixXd apart = solutions.rowwise() - solutions.colwise().mean();
  return apart.transpose() * apart * static_cast<double>(blocks - 1) / static_cast<double>(blocks);
}

double FitRound::judged_chi2(std::size_t r, const Eigen::VectorXd& z, const JudgingRule& rule) const {
  const Eigen::VectorXd phi = regression_terms(knobs_, z);
  const double error =
      phi.dot(emulators_[r].inverse_normal * phi) / static_cast<double>(emulators_[r].residuals.rows());
  const double wrong = rule.root.matrixL().solve(emulators_[r].residuals.transpose()).squaredNorm() * error;
  const double sum = rule.root.matrixL().solve(measured_[r].values - model(r, z)).squaredNorm(),
               expected = rule.expected + wrong;
  // As Objective::true_sum(): the emulator's error adds to what a wrong model leaves.
  return sum > expected ? sum - wrong : sum * rule.expected / expected;
}

std::vector<JudgingRule> FitRound::rules_of(const Refit* other) const {
  std::vector<JudgingRule> rules;
  for (std::size_t r = 0; r < measured_.size(); ++r) {
    JudgingRule rule{whitened_[r].root, whitened_[r].expected};
    if (other != nullptr) {
      rule.root = Eigen::LLT<Eigen::MatrixXd>(other->covariances[r]);
      rule.expected = expected_sum(r, rule.root);
    }
    rules.push_back(std::move(rule));
  }
  return rules;
}

std::vector<Eigen::MatrixXd> FitRound::covariances() const {
  std::vector<Eigen::MatrixXd> list;
  for (const Whitened& w : whitened_) list.push_back(w.root.reconstructedMatrix());
  return list;
}

std::vector<Eigen::MatrixXd> FitRound::for_means(double model_error) const {
  std::vector<Eigen::MatrixXd> list;
  for (std::size_t r = 0; r < measured_.size(); ++r)
    list.push_back(with_own(covariance_for_means(emulators_[r].residuals, measured_[r].plan,
                                                 model_error * measured_[r].setup.release.displacement),
                            measured_[r]));
  return list;
}

RunComparison FitRound::comparison(std::size_t r, const Eigen::VectorXd& z) const {
  RunComparison c;
  c.run = measured_[r].run;
  c.residual = measured_[r].values - model(r, z);
  c.spread = whitened_[r].spread;
  const Eigen::VectorXd phi = regression_terms(knobs_, z);
  c.chi2 = whitened_[r].root.matrixL().solve(c.residual).squaredNorm() /
           (1 + whitened_[r].chaos / whitened_[r].expected * phi.dot(emulators_[r].inverse_normal * phi));
  set_errors(c, measured_[r].plan, without_own(r, c.residual));
  return c;
}

Eigen::VectorXd FitRound::without_own(std::size_t r, const Eigen::VectorXd& residual) const {
  const Eigen::MatrixXd& own = measured_[r].own;
  if (own.cols() == 0) return residual;
  return residual - own * (whitened_[r].own.transpose() * residual);
}

Eigen::Array2d FitRound::mean_squares(const FeaturePlan& plan, const Eigen::VectorXd& left) {
  Eigen::Array2d sum = Eigen::Array2d::Zero(), count = Eigen::Array2d::Zero();
  for (Eigen::Index f = 0; f < left.size(); ++f) {
    const auto observable = static_cast<Eigen::Index>(plan.features[static_cast<std::size_t>(f)].observable);
    sum[observable] += left[f] * left[f];
    ++count[observable];
  }
  return sum / count.max(1);
}

std::vector<Validation> FitRound::validation(const RunComparison& run, std::size_t r,
                                             const Eigen::VectorXd& z,
                                             const Eigen::MatrixXd& covariance) const {
  const Eigen::MatrixXd slopes = emulators_[r].coefficients.transpose() * slopes_at(z);
  const std::vector<Feature>& features = measured_[r].plan.features;
  const Eigen::VectorXd left = without_own(r, run.residual);
  Eigen::VectorXd of_own = Eigen::VectorXd::Zero(left.size());
  const Eigen::MatrixXd& own = measured_[r].own;
  if (own.cols() > 0) {
    const Eigen::MatrixXd still_open =
        Eigen::MatrixXd::Identity(own.cols(), own.cols()) - own.transpose() * whitened_[r].own;
    of_own = (own * still_open).cwiseProduct(own).rowwise().sum().cwiseMax(0);
  }
  std::vector<Validation> rows;
  for (const Observable observable : {Observable::box, Observable::centre}) {
    double error = 0, numerical = 0, input = 0, data = 0, count = 0;
    for (Eigen::Index f = 0; f < left.size(); ++f) {
      const Feature& feature = features[static_cast<std::size_t>(f)];
      if (feature.observable != observable) continue;
      const double noise = feature.noise * feature.noise,
                   of_run = own.cols() > 0 ? own.row(f).squaredNorm() : 0;
      error += left[f] * left[f];
      numerical += std::max(0.0, run.spread[f] * run.spread[f] - noise - of_run);
      input += of_own[f] + slopes.row(f).dot(slopes.row(f) * covariance);
      data += noise;
      ++count;
    }
    if (count > 0)
      rows.push_back({run.run, observable == Observable::box ? "box" : "centre", std::sqrt(error / count),
                      std::sqrt(numerical / count), std::sqrt(input / count), std::sqrt(data / count)});
  }
  return rows;
}

std::vector<Eigen::VectorXd> FitRound::measured_values() const {
  std::vector<Eigen::VectorXd> values;
  for (const MeasuredFeatures& m : measured_) values.push_back(m.values);
  return values;
}

Objective FitRound::objective_of(const std::vector<Eigen::VectorXd>& values, bool measured,
                                 const std::vector<char>& used) const {
  const Eigen::Index terms = emulators_.front().coefficients.rows();
  Objective objective{&knobs_, Eigen::MatrixXd::Zero(terms, terms), Eigen::VectorXd::Zero(terms), 0, 0};
  if (measured) objective.error = Eigen::MatrixXd::Zero(terms, terms);
  for (std::size_t r = 0; r < measured_.size(); ++r) {
    if (!used.empty() && !used[r]) continue;
    const Eigen::VectorXd white = whitened_[r].root.matrixL().solve(values[r]);
    objective.square += whitened_[r].model.transpose() * whitened_[r].model;
    objective.degrees += whitened_[r].expected;
    if (measured) objective.error += whitened_[r].chaos * emulators_[r].inverse_normal;
    objective.cross += whitened_[r].model.transpose() * white;
    objective.constant += white.squaredNorm();
  }
  return objective;
}

Eigen::MatrixXd FitRound::slopes_at(const Eigen::VectorXd& z) const {
  constexpr double step = 0.05;
  Eigen::MatrixXd slopes(objective_.square.rows(), z.size());
  for (Eigen::Index a = 0; a < z.size(); ++a) {
    const Eigen::VectorXd moved = step * Eigen::VectorXd::Unit(z.size(), a);
    slopes.col(a) = (regression_terms(knobs_, z + moved) - regression_terms(knobs_, z - moved)) / (2 * step);
  }
  return slopes;
}

}  // namespace shakedown
