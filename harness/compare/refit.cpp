// SPDX-License-Identifier: MIT
#include "refit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <nlopt.hpp>

#include "random.hpp"

namespace shakedown {

namespace {

/// Correlations of bins are estimated from about a hundred simulations: shrunk towards none by this much.
constexpr double shrinkage = 0.2;
constexpr int pseudo_experiments = 400;

/// Chaos from run to run as seen in simulations `from` ... `to`, plus the camera's noise.
Eigen::MatrixXd covariance_of(const Emulator& emulator, const FeaturePlan& plan, Eigen::Index from, Eigen::Index to, double prediction_error,
                              double model_error) {
  const Eigen::MatrixXd rows = emulator.residuals.middleRows(from, to - from);
  Eigen::MatrixXd covariance = rows.transpose() * rows / static_cast<double>(rows.rows());
  const Eigen::VectorXd variance = covariance.diagonal();
  covariance *= (1 - shrinkage) * (1 + prediction_error);
  for (Eigen::Index f = 0; f < variance.size(); ++f) {
    const double noise = plan.features[static_cast<std::size_t>(f)].noise;
    // A floor under the spread: two codes of the same physics agree no better than this.
    covariance(f, f) += shrinkage * (1 + prediction_error) * variance[f] + noise * noise + model_error * model_error;
  }
  return covariance;
}

/// One measured run, whitened.
struct Whitened {
  Eigen::LLT<Eigen::MatrixXd> root;
  Eigen::MatrixXd model;  ///< L^-1 times the emulator's coefficients, features x terms
  Eigen::VectorXd spread;
};

/// |w - G phi(z)|^2 summed over the runs, as a quadratic form in the regression's terms.
struct Objective {
  const std::vector<Knob>* knobs;
  Eigen::MatrixXd square;
  Eigen::VectorXd cross;
  double constant = 0;

  double operator()(const Eigen::VectorXd& z) const {
    const Eigen::VectorXd phi = regression_terms(*knobs, z);
    return phi.dot(square * phi) - 2 * cross.dot(phi) + constant;
  }
};

struct Minimum {
  Eigen::VectorXd z;
  double value;
};

double evaluate(const std::vector<double>& z, std::vector<double>& gradient, void* data) {
  const auto& objective = *static_cast<const Objective*>(data);
  const Eigen::Map<const Eigen::VectorXd> at(z.data(), static_cast<Eigen::Index>(z.size()));
  if (!gradient.empty())
    for (Eigen::Index k = 0; k < at.size(); ++k) {  // exact for a polynomial of degree four up to (1e-4)^2
      Eigen::VectorXd up = at, down = at;
      up[k] += 1e-4;
      down[k] -= 1e-4;
      gradient[static_cast<std::size_t>(k)] = (objective(up) - objective(down)) / 2e-4;
    }
  return objective(at);
}

/// The lowest point within `reach` of the scattered box and within the knobs' bounds, from several starts.
Minimum minimum_of(const Objective& objective, double reach, int starts) {
  const std::vector<Knob>& knobs = *objective.knobs;
  if (knobs.empty()) return {Eigen::VectorXd(0), objective(Eigen::VectorXd(0))};
  std::vector<double> low, high;
  for (const Knob& knob : knobs) {
    low.push_back(std::max(-reach, knob.z_of(knob.low)));
    high.push_back(std::min(reach, knob.z_of(knob.high)));
  }
  Minimum best{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(knobs.size())), 0};
  for (int start = 0; start < starts; ++start) {
    Random random(17, static_cast<std::uint64_t>(start), Stream::other);
    std::vector<double> z;
    for (std::size_t k = 0; k < knobs.size(); ++k)
      z.push_back(std::clamp(start == 0 ? 0.0 : 1.6 * random.uniform() - 0.8, low[k], high[k]));
    nlopt::opt search(nlopt::LD_SLSQP, static_cast<unsigned>(knobs.size()));
    search.set_lower_bounds(low);
    search.set_upper_bounds(high);
    search.set_min_objective(evaluate, const_cast<Objective*>(&objective));
    search.set_xtol_abs(1e-6);
    search.set_maxeval(200);
    double value = 0;
    try {
      search.optimize(z, value);
    } catch (const std::runtime_error&) {  // stopped by rounding at the minimum: z is good
      std::vector<double> none;
      value = evaluate(z, none, const_cast<Objective*>(&objective));
    }
    if (start == 0 || value < best.value) best = {Eigen::Map<Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size())), value};
  }
  return best;
}

class Round {
 public:
  Round(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs, std::vector<Emulator> emulators, const RefitOptions& options)
      : measured_(measured), knobs_(knobs), emulators_(std::move(emulators)) {
    half_ = options.count / 2;
    const double terms = static_cast<double>(emulators_.front().coefficients.rows());
    for (std::size_t r = 0; r < measured.size(); ++r) {
      const Eigen::MatrixXd covariance =
          covariance_of(emulators_[r], measured[r].plan, 0, half_, terms / options.count, options.model_error * measured[r].setup.release.displacement);
      Whitened w{Eigen::LLT<Eigen::MatrixXd>(covariance), {}, covariance.diagonal().cwiseSqrt()};
      w.model = w.root.matrixL().solve(emulators_[r].coefficients.transpose());
      whitened_.push_back(std::move(w));
    }
    objective_ = objective_of(measured_values());
  }

  const Objective& objective() const { return objective_; }
  Eigen::VectorXd model(std::size_t r, const Eigen::VectorXd& z) const {
    return emulators_[r].coefficients.transpose() * regression_terms(knobs_, z);
  }

  /// Spread of the fitted values and of the smallest sum over pseudo-experiments: the model at z, a simulation that the covariance has
  /// not seen for each run, and camera noise.
  void calibrate(const Eigen::VectorXd& z, double observed, Refit& result, Eigen::VectorXd& deviation) const {
    std::vector<double> sums;
    Eigen::MatrixXd solutions(pseudo_experiments, z.size());
    int worse = 0;
    for (int e = 0; e < pseudo_experiments; ++e) {
      Random random(23, static_cast<std::uint64_t>(e), Stream::bootstrap);
      std::vector<Eigen::VectorXd> values;
      for (std::size_t r = 0; r < measured_.size(); ++r) {
        const Eigen::Index rows = emulators_[r].residuals.rows() - half_;
        const Eigen::Index row = half_ + static_cast<Eigen::Index>(random.uniform() * static_cast<double>(rows));
        Eigen::VectorXd value = model(r, z) + emulators_[r].residuals.row(row).transpose();
        for (Eigen::Index f = 0; f < value.size(); ++f) value[f] += measured_[r].plan.features[static_cast<std::size_t>(f)].noise * random.normal();
        values.push_back(std::move(value));
      }
      const Objective pseudo = objective_of(values);
      const Minimum minimum = minimum_of(pseudo, 2.5, 1);
      sums.push_back(minimum.value);
      worse += minimum.value >= observed;
      solutions.row(e) = minimum.z.transpose();
    }
    std::sort(sums.begin(), sums.end());
    result.p_value = (1.0 + worse) / (1.0 + pseudo_experiments);
    result.degrees = sums[sums.size() / 2];
    result.scatter = observed / result.degrees;
    const Eigen::RowVectorXd mean = solutions.colwise().mean();
    deviation = ((solutions.rowwise() - mean).colwise().squaredNorm() / (pseudo_experiments - 1)).cwiseSqrt().transpose();
  }

  /// Predicts each box length from the others, with the same simulations.
  void hold_out(Refit& result) const {
    std::vector<double> lengths;
    for (const MeasuredFeatures& m : measured_)
      if (std::find(lengths.begin(), lengths.end(), m.setup.box.length) == lengths.end()) lengths.push_back(m.setup.box.length);
    result.held_out_error_box = result.held_out_error_centre = result.held_out_chi2 = std::nan("");
    if (lengths.size() < 2) return;
    double box = 0, centre = 0, chi2 = 0;
    for (const double length : lengths) {
      std::vector<char> used;
      for (const MeasuredFeatures& m : measured_) used.push_back(m.setup.box.length != length);
      const Minimum minimum = minimum_of(objective_of(measured_values(), used), 1.5, 2);
      for (std::size_t r = 0; r < measured_.size(); ++r) {
        if (used[r]) continue;
        const RunComparison left_out = comparison(r, minimum.z);
        box += left_out.error_box * left_out.error_box;
        centre += left_out.error_centre * left_out.error_centre;
        chi2 += left_out.chi2;
      }
    }
    const double count = static_cast<double>(measured_.size());
    result.held_out_error_box = std::sqrt(box / count);
    result.held_out_error_centre = std::sqrt(centre / count);
    result.held_out_chi2 = chi2;
  }

  RunComparison comparison(std::size_t r, const Eigen::VectorXd& z) const {
    RunComparison c{measured_[r].run, 0, 0, 0, 0, 0, measured_[r].values - model(r, z), whitened_[r].spread};
    c.chi2 = whitened_[r].root.matrixL().solve(c.residual).squaredNorm();
    std::array<double, 2> squares{}, floor{}, count{};
    for (Eigen::Index f = 0; f < c.residual.size(); ++f) {
      const auto o = static_cast<std::size_t>(measured_[r].plan.features[static_cast<std::size_t>(f)].observable);
      squares[o] += c.residual[f] * c.residual[f];
      floor[o] += c.spread[f] * c.spread[f];
      ++count[o];
    }
    const auto root = [&](double sum, std::size_t o) { return count[o] > 0 ? std::sqrt(sum / count[o]) : 0.0; };
    c.error_box = root(squares[0], 0), c.error_centre = root(squares[1], 1);
    c.floor_box = root(floor[0], 0), c.floor_centre = root(floor[1], 1);
    return c;
  }

 private:
  std::vector<Eigen::VectorXd> measured_values() const {
    std::vector<Eigen::VectorXd> values;
    for (const MeasuredFeatures& m : measured_) values.push_back(m.values);
    return values;
  }

  Objective objective_of(const std::vector<Eigen::VectorXd>& values, const std::vector<char>& used = {}) const {
    const Eigen::Index terms = emulators_.front().coefficients.rows();
    Objective objective{&knobs_, Eigen::MatrixXd::Zero(terms, terms), Eigen::VectorXd::Zero(terms), 0};
    for (std::size_t r = 0; r < measured_.size(); ++r) {
      if (!used.empty() && !used[r]) continue;
      const Eigen::VectorXd white = whitened_[r].root.matrixL().solve(values[r]);
      objective.square += whitened_[r].model.transpose() * whitened_[r].model;
      objective.cross += whitened_[r].model.transpose() * white;
      objective.constant += white.squaredNorm();
    }
    return objective;
  }

  const std::vector<MeasuredFeatures>& measured_;
  const std::vector<Knob>& knobs_;
  std::vector<Emulator> emulators_;
  std::vector<Whitened> whitened_;
  Eigen::Index half_;
  Objective objective_;
};

double root_mean_square(const std::vector<RunComparison>& runs, double RunComparison::*what) {
  double squares = 0;
  for (const RunComparison& run : runs) squares += run.*what * (run.*what);
  return runs.empty() ? 0 : std::sqrt(squares / static_cast<double>(runs.size()));
}

Refit result_at(const Round& round, const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs, const Eigen::VectorXd& z,
                double sum) {
  Refit result;
  result.knobs = knobs;
  result.chi2 = sum;
  Eigen::VectorXd deviation;
  round.calibrate(z, sum, result, deviation);
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    FittedValue value{knobs[k].key, knobs[k].at(z[i]), 0, 0, deviation[i] * knobs[k].width * std::sqrt(std::max(1.0, result.scatter)), false};
    value.low = std::max(knobs[k].low, value.value - 1.96 * value.error);
    value.high = std::min(knobs[k].high, value.value + 1.96 * value.error);
    value.at_bound = value.value <= knobs[k].low || value.value >= knobs[k].high;
    result.values.push_back(value);
  }
  for (std::size_t r = 0; r < measured.size(); ++r) result.runs.push_back(round.comparison(r, z));
  round.hold_out(result);
  return result;
}

}  // namespace

double Refit::error_box() const { return root_mean_square(runs, &RunComparison::error_box); }
double Refit::error_centre() const { return root_mean_square(runs, &RunComparison::error_centre); }
double Refit::floor_box() const { return root_mean_square(runs, &RunComparison::floor_box); }
double Refit::floor_centre() const { return root_mean_square(runs, &RunComparison::floor_centre); }

Refit refit(const std::vector<MeasuredFeatures>& measured, std::vector<Knob> knobs, const Workshop& workshop, const RefitOptions& options) {
  for (int number = 1;; ++number) {
    const std::vector<Knob> here = knobs;
    const Round round(measured, here, emulate(measured, here, options.count, options.first_run + 10000 * number, workshop), options);
    const Minimum minimum = minimum_of(round.objective(), 1.5, knobs.empty() ? 1 : 6);
    bool left_the_box = false;
    for (std::size_t k = 0; k < knobs.size(); ++k) {
      const double z = minimum.z[static_cast<Eigen::Index>(k)];
      const bool inner = here[k].at(z) > here[k].low && here[k].at(z) < here[k].high;
      left_the_box = left_the_box || (std::abs(z) > 1.05 && inner);
    }
    const bool last = knobs.empty() || number >= options.most_rounds || (number >= options.rounds && !left_the_box);
    if (last) return result_at(round, measured, here, minimum.z, minimum.value);
    for (std::size_t k = 0; k < knobs.size(); ++k) {
      const double z = minimum.z[static_cast<Eigen::Index>(k)];
      knobs[k].centre = here[k].at(z);
      if (std::abs(z) < 0.8) knobs[k].width *= options.shrink;
    }
  }
}

Refit compare_at(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs, const Workshop& workshop, const RefitOptions& options) {
  std::vector<MeasuredFeatures> fixed = measured;
  for (MeasuredFeatures& m : fixed) m.setup = setup_at(m.setup, knobs, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(knobs.size())), workshop.known);
  return refit(fixed, {}, workshop, options);
}

}  // namespace shakedown
