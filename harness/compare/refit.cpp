// SPDX-License-Identifier: MIT
#include "refit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <nlopt.hpp>

#include "feature_covariance.hpp"
#include "random.hpp"

namespace shakedown {

namespace {

constexpr int pseudo_experiments = 400;
/// How far out of the scattered box (1) a solution may lie before the box follows.
constexpr double reach = 1.5;

/// One measured run, whitened.
struct Whitened {
  Eigen::LLT<Eigen::MatrixXd> root;
  Eigen::MatrixXd model;  ///< L^-1 times the emulator's coefficients, features x terms
  Eigen::VectorXd spread;
  double chaos = 0;     ///< mean square of a simulation's whitened chaos, from simulations that the covariance has not seen
  double expected = 0;  ///< of the whitened sum: chaos and camera noise
};

/// -2 ln likelihood: |w - G phi(z)|^2 summed over the runs, a quadratic form in the regression's terms, with the emulator's own error in
/// the variance (without it, noise in G makes every knob seem to matter and the middle of the box a minimum), and what is known of the
/// knobs beforehand.
struct Objective {
  const std::vector<Knob>* knobs;
  Eigen::MatrixXd square;
  Eigen::VectorXd cross;
  double constant = 0;
  double degrees = 1;           ///< expected sum without emulator error
  Eigen::MatrixXd error = {};   ///< phi' error phi is what the emulator's error adds to the expectation; empty: none

  double sum(const Eigen::VectorXd& phi) const { return phi.dot(square * phi) - 2 * cross.dot(phi) + constant; }
  /// Variance with the emulator's error over the variance without.
  double inflation(const Eigen::VectorXd& phi) const { return error.size() == 0 ? 1.0 : 1 + phi.dot(error * phi) / degrees; }
  /// The sum with the emulator's share taken off: comparable between boxes and with pseudo-experiments.
  double chi2(const Eigen::VectorXd& z) const {
    const Eigen::VectorXd phi = regression_terms(*knobs, z);
    return sum(phi) / inflation(phi) + disbelief(z);
  }
  /// What the knobs' values cost by what is known of them beforehand.
  double disbelief(const Eigen::VectorXd& z) const {
    double sum = 0;
    for (std::size_t k = 0; k < knobs->size(); ++k) {
      const Knob& knob = (*knobs)[k];
      if (knob.believed_error > 0) sum += std::pow((knob.at(z[static_cast<Eigen::Index>(k)]) - knob.believed) / knob.believed_error, 2);
    }
    return sum;
  }

  double operator()(const Eigen::VectorXd& z) const {
    const Eigen::VectorXd phi = regression_terms(*knobs, z);
    const double wider = inflation(phi);
    return sum(phi) / wider + degrees * std::log(wider) + disbelief(z);
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
Minimum minimum_of(const Objective& objective, double farthest, int starts, const Eigen::VectorXd& first = {}) {
  const std::vector<Knob>& knobs = *objective.knobs;
  if (knobs.empty()) return {Eigen::VectorXd(0), objective(Eigen::VectorXd(0))};
  std::vector<double> low, high;
  for (const Knob& knob : knobs) {
    low.push_back(std::max(-farthest, knob.z_of(knob.low)));
    high.push_back(std::min(farthest, knob.z_of(knob.high)));
  }
  Minimum best{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(knobs.size())), 0};
  for (int start = 0; start < starts; ++start) {
    Random random(17, static_cast<std::uint64_t>(start), Stream::other);
    std::vector<double> z;
    for (std::size_t k = 0; k < knobs.size(); ++k)
      z.push_back(std::clamp(start > 0 ? 1.6 * random.uniform() - 0.8 : first.size() > 0 ? first[static_cast<Eigen::Index>(k)] : 0.0, low[k], high[k]));
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

/// By which covariance a run's residual is judged.
struct Rule {
  Eigen::LLT<Eigen::MatrixXd> root;
  double expected = 0;  ///< of the whitened sum
};

class Round {
 public:
  Round(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs, std::vector<Emulator> emulators, const RefitOptions& options,
        int count)
      : measured_(measured), knobs_(knobs), emulators_(std::move(emulators)), half_(count / 2) {
    for (std::size_t r = 0; r < measured.size(); ++r) {
      const Eigen::MatrixXd covariance =
          feature_covariance(emulators_[r].residuals.topRows(half_), measured[r].plan, options.model_error * measured[r].setup.release.displacement);
      Whitened w{Eigen::LLT<Eigen::MatrixXd>(covariance), {}, covariance.diagonal().cwiseSqrt()};
      w.model = w.root.matrixL().solve(emulators_[r].coefficients.transpose());
      const Eigen::Index unseen = emulators_[r].residuals.rows() - half_;
      w.chaos = w.root.matrixL().solve(emulators_[r].residuals.bottomRows(unseen).transpose()).squaredNorm() / static_cast<double>(unseen);
      Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(covariance.rows(), covariance.cols());
      for (Eigen::Index f = 0; f < noise.rows(); ++f) noise(f, f) = measured[r].plan.features[static_cast<std::size_t>(f)].noise;
      w.expected = w.chaos + w.root.matrixL().solve(noise).squaredNorm();
      whitened_.push_back(std::move(w));
    }
    objective_ = objective_of(measured_values(), true);
  }

  const Objective& objective() const { return objective_; }
  Eigen::VectorXd model(std::size_t r, const Eigen::VectorXd& z) const {
    return emulators_[r].coefficients.transpose() * regression_terms(knobs_, z);
  }

  /// The smallest sum over pseudo-experiments: the model at z, a simulation that the covariance has not seen for each run, and camera
  /// noise.
  void calibrate(const Eigen::VectorXd& z, double observed, Refit& result) const {
    std::vector<double> sums;
    const std::vector<Cell> cells = cells_of(measured_);
    Eigen::MatrixXd cell_rows(pseudo_experiments, static_cast<Eigen::Index>(cells.size()));
    std::vector<Eigen::VectorXd> spreads, residuals(measured_.size());
    for (const Whitened& w : whitened_) spreads.push_back(w.spread);
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
      const Objective pseudo = objective_of(values, false);
      const Eigen::VectorXd refitted = minimum_of(pseudo, 2.5, 1, z).z;
      const double least = pseudo.chi2(refitted);
      for (std::size_t r = 0; r < measured_.size(); ++r) residuals[r] = values[r] - model(r, refitted);
      cell_rows.row(e) = cell_sums(cells, residuals, spreads).transpose();
      sums.push_back(least);
      worse += least >= observed;
    }
    std::sort(sums.begin(), sums.end());
    result.p_value = (1.0 + worse) / (1.0 + pseudo_experiments);
    result.degrees = sums[sums.size() / 2];
    result.scatter = observed / result.degrees;
    for (std::size_t r = 0; r < measured_.size(); ++r) residuals[r] = measured_[r].values - model(r, z);
    result.cells = judge_cells(cells, residuals, spreads, cell_rows);
  }

  /// Predicts each box length from the others, with the same simulations.
  void hold_out(Refit& result, const std::vector<Rule>& rules) const {
    std::vector<double> lengths;
    for (const MeasuredFeatures& m : measured_)
      if (std::find(lengths.begin(), lengths.end(), m.setup.box.length) == lengths.end()) lengths.push_back(m.setup.box.length);
    result.held_out_error_box = result.held_out_error_centre = result.held_out_chi2 = result.judged_held_out_chi2 = std::nan("");
    if (lengths.size() < 2) return;
    double box = 0, centre = 0, chi2 = 0, judged = 0;
    for (const double length : lengths) {
      std::vector<char> used;
      for (const MeasuredFeatures& m : measured_) used.push_back(m.setup.box.length != length);
      const Minimum minimum = minimum_of(objective_of(measured_values(), true, used), reach, 2);
      for (std::size_t r = 0; r < measured_.size(); ++r) {
        if (used[r]) continue;
        const RunComparison left_out = comparison(r, minimum.z);
        box += left_out.error_box * left_out.error_box;
        centre += left_out.error_centre * left_out.error_centre;
        chi2 += left_out.chi2;
        judged += judged_chi2(r, minimum.z, rules[r]);
      }
    }
    const double count = static_cast<double>(measured_.size());
    result.held_out_error_box = std::sqrt(box / count);
    result.held_out_error_centre = std::sqrt(centre / count);
    result.held_out_chi2 = chi2;
    result.judged_held_out_chi2 = judged;
  }

  /// Covariance of the fitted z, the sandwich A^-1 B A^-1. A: the sensitivities' square less what the emulator's error adds to it (second
  /// derivatives times residuals are mostly noise of the emulator). B: what chaos that the weights have not seen, camera noise and the
  /// emulator's error make of the gradient; weights that are far from the best make B larger than A. A direction that the data leave
  /// open gets the size of the searched box.
  Eigen::MatrixXd covariance_at(const Eigen::VectorXd& z, double open) const {
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
      const Eigen::Index unseen = emulators_[r].residuals.rows() - half_;
      const Eigen::MatrixXd chaos = emulators_[r].residuals.bottomRows(unseen) * weights;
      gradient += inflation * chaos.transpose() * chaos / static_cast<double>(unseen);
      for (Eigen::Index f = 0; f < weights.rows(); ++f)
        gradient += std::pow(measured_[r].plan.features[static_cast<std::size_t>(f)].noise, 2) * weights.row(f).transpose() * weights.row(f);
    }
    for (Eigen::Index a = 0; a < n; ++a) {
      const Knob& knob = knobs_[static_cast<std::size_t>(a)];
      if (knob.believed_error == 0) continue;
      information(a, a) += std::pow(knob.width / knob.believed_error, 2);
      gradient(a, a) += std::pow(knob.width / knob.believed_error, 2);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(information);
    const Eigen::VectorXd inverse = axes.eigenvalues().array().max(1 / (open * open)).inverse().matrix();
    Eigen::MatrixXd covariance = inverse.asDiagonal() * (axes.eigenvectors().transpose() * gradient * axes.eigenvectors()) * inverse.asDiagonal();
    const Eigen::VectorXd within = (open / covariance.diagonal().array().sqrt()).min(1.0).matrix();
    covariance = within.asDiagonal() * covariance * within.asDiagonal();
    return axes.eigenvectors() * covariance * axes.eigenvectors().transpose();
  }

  /// A run's chi2 by another fit's rule, the emulator's own error taken off.
  double judged_chi2(std::size_t r, const Eigen::VectorXd& z, const Rule& rule) const {
    const Eigen::VectorXd phi = regression_terms(knobs_, z);
    const double error = phi.dot(emulators_[r].inverse_normal * phi) / static_cast<double>(emulators_[r].residuals.rows());
    const double wrong = rule.root.matrixL().solve(emulators_[r].residuals.transpose()).squaredNorm() * error;
    return rule.root.matrixL().solve(measured_[r].values - model(r, z)).squaredNorm() * rule.expected / (rule.expected + wrong);
  }

  /// The rules of `other`, or of this round where there is none.
  std::vector<Rule> rules_of(const Refit* other) const {
    std::vector<Rule> rules;
    for (std::size_t r = 0; r < measured_.size(); ++r) {
      Rule rule{whitened_[r].root, whitened_[r].expected};
      if (other != nullptr) rule.root = Eigen::LLT<Eigen::MatrixXd>(other->covariances[r]);
      rules.push_back(std::move(rule));
    }
    return rules;
  }

  std::vector<Eigen::MatrixXd> covariances() const {
    std::vector<Eigen::MatrixXd> list;
    for (const Whitened& w : whitened_) list.push_back(w.root.reconstructedMatrix());
    return list;
  }

  RunComparison comparison(std::size_t r, const Eigen::VectorXd& z) const {
    RunComparison c{measured_[r].run, 0, 0, 0, 0, 0, measured_[r].values - model(r, z), whitened_[r].spread};
    const Eigen::VectorXd phi = regression_terms(knobs_, z);
    c.chi2 = whitened_[r].root.matrixL().solve(c.residual).squaredNorm() /
             (1 + whitened_[r].chaos / whitened_[r].expected * phi.dot(emulators_[r].inverse_normal * phi));
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

  /// `measured`: allows for the emulator's own error, which values that it has made itself do not have.
  Objective objective_of(const std::vector<Eigen::VectorXd>& values, bool measured, const std::vector<char>& used = {}) const {
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

  /// Derivatives of the regression's terms, terms x knobs.
  Eigen::MatrixXd slopes_at(const Eigen::VectorXd& z) const {
    constexpr double step = 0.05;
    Eigen::MatrixXd slopes(objective_.square.rows(), z.size());
    for (Eigen::Index a = 0; a < z.size(); ++a) {
      const Eigen::VectorXd moved = step * Eigen::VectorXd::Unit(z.size(), a);
      slopes.col(a) = (regression_terms(knobs_, z + moved) - regression_terms(knobs_, z - moved)) / (2 * step);
    }
    return slopes;
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

Refit result_at(const Round& round, const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs, const Minimum& minimum,
                const Refit* judged_by) {
  Refit result;
  result.knobs = knobs;
  result.chi2 = round.objective().chi2(minimum.z);
  round.calibrate(minimum.z, result.chi2, result);
  const Eigen::MatrixXd covariance = round.covariance_at(minimum.z, reach) * std::max(1.0, result.scatter);
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    FittedValue value{knobs[k].key, knobs[k].at(minimum.z[i]), 0, 0, std::sqrt(covariance(i, i)) * knobs[k].width, false};
    value.low = std::max(knobs[k].low, value.value - 1.96 * value.error);
    value.high = std::min(knobs[k].high, value.value + 1.96 * value.error);
    value.at_bound = value.value <= knobs[k].low || value.value >= knobs[k].high;
    result.values.push_back(value);
  }
  for (std::size_t r = 0; r < measured.size(); ++r) result.runs.push_back(round.comparison(r, minimum.z));
  const std::vector<Rule> rules = round.rules_of(judged_by);
  for (std::size_t r = 0; r < measured.size(); ++r) result.judged_chi2 += round.judged_chi2(r, minimum.z, rules[r]);
  round.hold_out(result, rules);
  result.covariances = round.covariances();
  return result;
}

/// The box for the next round: about the solution, as wide as what is still open, so that a long valley is seen whole.
/// Never much wider than the first one allowed: a regression over more than it can follow takes its own misfit for chaos.
std::vector<Knob> next_box(std::vector<Knob> knobs, const Minimum& minimum, const Eigen::MatrixXd& covariance, const std::vector<Knob>& first) {
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double z = minimum.z[i], open = 2 * std::sqrt(covariance(i, i));
    knobs[k].centre = knobs[k].at(z);
    knobs[k].width = std::min(knobs[k].width * std::clamp(open, std::abs(z) < 0.8 ? 0.25 : 1.0, 1.5), 0.6 * first[k].width);
  }
  return knobs;
}

}  // namespace

double Refit::error_box() const { return root_mean_square(runs, &RunComparison::error_box); }
double Refit::error_centre() const { return root_mean_square(runs, &RunComparison::error_centre); }
double Refit::floor_box() const { return root_mean_square(runs, &RunComparison::floor_box); }
double Refit::floor_centre() const { return root_mean_square(runs, &RunComparison::floor_centre); }

Refit refit(const std::vector<MeasuredFeatures>& measured, std::vector<Knob> knobs, const Workshop& workshop, const RefitOptions& options) {
  const std::vector<Knob> first = knobs;
  for (int number = 1;; ++number) {
    const std::vector<Knob> here = knobs;
    // Rounds that only find the way need fewer simulations than the one that judges.
    const int count = knobs.empty() || number >= options.rounds ? options.count : std::max(64, options.count / 2);
    const Round round(measured, here, emulate(measured, here, count, options.first_run + 10000 * number, workshop), options, count);
    const Minimum minimum = minimum_of(round.objective(), reach, knobs.empty() ? 1 : 6);
    bool left_the_box = false;
    for (std::size_t k = 0; k < knobs.size(); ++k) {
      const double z = minimum.z[static_cast<Eigen::Index>(k)];
      const bool inner = here[k].at(z) > here[k].low && here[k].at(z) < here[k].high;
      left_the_box = left_the_box || (std::abs(z) > 1.05 && inner);
    }
    const bool last = knobs.empty() || number >= options.most_rounds || (number >= options.rounds && !left_the_box);
    if (last) return result_at(round, measured, here, minimum, options.judged_by);
    knobs = next_box(here, minimum, round.covariance_at(minimum.z, reach), first);
  }
}

Refit compare_at(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs, const Workshop& workshop, const RefitOptions& options) {
  std::vector<MeasuredFeatures> fixed = measured;
  for (MeasuredFeatures& m : fixed) m.setup = setup_at(m.setup, knobs, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(knobs.size())), workshop.known);
  return refit(fixed, {}, workshop, options);
}

}  // namespace shakedown
