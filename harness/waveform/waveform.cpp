// SPDX-License-Identifier: MIT
#include "waveform.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>

#include "in_order.hpp"
#include "least_squares.hpp"
#include "waveform_residuals.hpp"

namespace shakedown {

bool WaveformLaw::operator==(const WaveformLaw& other) const {
  return term.key() == other.term.key() && term.besides == other.term.besides && is_mode == other.is_mode;
}

Eigen::Index WaveformFit::first_of(std::size_t law) const {
  Eigen::Index first = 3 * std::ssize(residual) + 1;
  for (std::size_t i = 0; i < law; ++i) first += laws[i].width();
  return first;
}

double WaveformFit::rms() const {
  double sum = 0;
  for (const Eigen::VectorXd& one : residual) sum += one.squaredNorm();
  return std::sqrt(sum / static_cast<double>(std::max<Eigen::Index>(1, frames)));
}

Eigen::VectorXd starting_values(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                                double frequency) {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(count_of(runs, laws));
  for (std::size_t r = 0; r < runs.size(); ++r) {
    // Fit a sine about a constant through the first one and a half periods.
    const WaveformRun& run = runs[r];
    std::vector<Eigen::Vector3d> rows;
    std::vector<double> right;
    for (std::size_t i = 0; i < run.time.size() && run.time[i] <= run.start_time() + 1.5 / frequency; ++i) {
      const double phase = two_pi * frequency * (run.time[i] - run.start_time());
      rows.push_back({std::cos(phase), std::sin(phase), 1});
      right.push_back(run.x[i]);
    }
    Eigen::MatrixXd columns(std::ssize(rows), 3);
    for (std::size_t i = 0; i < rows.size(); ++i) columns.row(static_cast<Eigen::Index>(i)) = rows[i];
    const Eigen::Vector3d found =
        least_squares_coefficients(columns, Eigen::Map<Eigen::VectorXd>(right.data(), std::ssize(right)));
    value.segment(3 * static_cast<Eigen::Index>(r), 3) << found[0], found[1] * two_pi * frequency, found[2];
  }
  value[3 * std::ssize(runs)] = frequency;
  return value;
}

WaveformFit fit_waveform(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                         const Eigen::VectorXd& start, const WaveformOptions& options) {
  Residuals residuals(runs, laws, options);
  WaveformFit fit;
  fit.laws = laws;
  fit.value = start;
  fit.frames = residuals.frames();
  residuals.start_from(start);
  Eigen::VectorXd scaled = Eigen::VectorXd::Zero(residuals.inputs()), left(residuals.values());
  if (fit.frames > residuals.inputs()) {
    Eigen::LevenbergMarquardt<Residuals> search(residuals);
    search.parameters.maxfev = options.evaluations;
    // chi2 is some thousands, and ln odds are wanted to a tenth.
    search.parameters.ftol = search.parameters.xtol = 1e-5;
    // This is MINPACK's first region of trust, in the units of the residuals where the start is the origin.
    residuals.at(start, left);
    search.parameters.factor = std::max(1.0, left.norm());
    search.minimize(scaled);
  }
  fit.value = residuals.value_of(scaled);
  fit.possible = residuals.at(fit.value, left);
  fit.chi2 = left.squaredNorm();
  Eigen::MatrixXd slope(residuals.values(), residuals.inputs());
  residuals.df(scaled, slope);
  Eigen::MatrixXd normal = slope.transpose() * slope;
  // What is fixed or leaves no trace stays where it is.
  for (Eigen::Index k = 0; k < normal.rows(); ++k)
    if (!(normal(k, k) > 0)) normal(k, k) = 1e300;
  const Eigen::VectorXd root = normal.diagonal().cwiseSqrt();
  const Eigen::MatrixXd correlation =
      root.cwiseInverse().asDiagonal() * normal * root.cwiseInverse().asDiagonal();
  const Eigen::VectorXd outer = residuals.scale().cwiseQuotient(root);
  fit.covariance = outer.asDiagonal() * pseudo_inverse(correlation) * outer.asDiagonal();
  Eigen::Index row = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    fit.residual.push_back(left.segment(row, residuals.used()[r]) * runs[r].noise);
    row += residuals.used()[r];
  }
  return fit;
}

WaveformFit fit_growing(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                        const Eigen::VectorXd& start, const WaveformOptions& options) {
  double longest = 0;
  for (const WaveformRun& run : runs) longest = std::max(longest, run.time.back() - run.time.front());
  WaveformOptions part = options;
  constexpr double first_periods = 2, growth = 1.4;
  constexpr int a_few = 15;
  Eigen::VectorXd value = start;
  for (double until = first_periods / start[3 * std::ssize(runs)]; until < longest; until *= growth) {
    part.until = until;
    part.evaluations = a_few;
    const WaveformFit fit = fit_waveform(runs, laws, value, part);
    if (fit.possible) value = fit.value;
  }
  return fit_waveform(runs, laws, value, options);
}

namespace {

/// Returns the residuals of a fit with one more law that hardly acts, and how they change with its strength.
std::pair<Eigen::VectorXd, Eigen::VectorXd> last_column(const std::vector<WaveformRun>& runs,
                                                        const WaveformFit& fit, const WaveformLaw& law,
                                                        const WaveformOptions& options) {
  std::vector<WaveformLaw> laws = fit.laws;
  laws.push_back(law);
  Eigen::VectorXd start(fit.value.size() + 1);
  start << fit.value, law.term.inverse ? 1e-4 * law.term.typical : 0;
  Residuals residuals(runs, laws, options);
  Eigen::VectorXd left(residuals.values());
  residuals.at(start, left);
  return {left, residuals.slope_of_last_law(start, left)};
}

/// Holds the residuals of a fit with one more law, and how they change with its first numbers.
struct OneMore {
  Eigen::VectorXd left;
  Eigen::MatrixXd free, columns;  ///< of the fit's own numbers, of the law's
  Eigen::VectorXd scale;          ///< of the columns
};
OneMore one_more(const std::vector<WaveformRun>& runs, const WaveformFit& fit, const WaveformLaw& law,
                 Eigen::Index width, const Eigen::VectorXd& start_of_law, const WaveformOptions& options) {
  std::vector<WaveformLaw> laws = fit.laws;
  laws.push_back(law);
  Eigen::VectorXd start(fit.value.size() + law.width());
  start << fit.value, start_of_law;
  Residuals residuals(runs, laws, options);
  residuals.start_from(start);
  OneMore made;
  made.left.resize(residuals.values());
  residuals.at(start, made.left);
  Eigen::MatrixXd slope(residuals.values(), residuals.inputs());
  residuals.df(Eigen::VectorXd::Zero(residuals.inputs()), slope);
  made.free = slope.leftCols(fit.value.size());
  made.columns = slope.middleCols(fit.value.size(), width);
  made.scale = residuals.scale().segment(fit.value.size(), width);
  return made;
}

}  // namespace

std::vector<LawScore> scores_of(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                                const std::vector<WaveformLaw>& laws, const WaveformOptions& options) {
  Residuals alone(runs, fit.laws, options);
  alone.start_from(fit.value);
  Eigen::MatrixXd slope(alone.values(), alone.inputs());
  alone.df(Eigen::VectorXd::Zero(alone.inputs()), slope);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> free(slope);
  std::vector<LawScore> scores(laws.size());
  work_in_parallel_deliver_in_order(
      static_cast<int>(laws.size()), options.threads, [&](int k) -> std::function<void()> {
        const auto [left, column] = last_column(runs, fit, laws[static_cast<std::size_t>(k)], options);
        const Eigen::VectorXd outside = column - slope * free.solve(column);
        const double squares = outside.squaredNorm();
        LawScore score;
        if (column.squaredNorm() > 0 && squares > 0)
          score = {std::pow(outside.dot(left), 2) / squares, squares / column.squaredNorm()};
        return [&scores, k, score] { scores[static_cast<std::size_t>(k)] = score; };
      });
  return scores;
}

Eigen::Vector2d linear_mode(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                            const WaveformLaw& law, double frequency, const WaveformOptions& options) {
  Eigen::VectorXd start(4);
  start << 0, 0, frequency, 0;
  const OneMore more = one_more(runs, fit, law, 2, start, options);
  Eigen::MatrixXd all(more.left.size(), more.free.cols() + 2);
  all << more.free, more.columns;
  const Eigen::VectorXd step = -least_squares_coefficients(all, more.left);
  return step.tail(2).cwiseProduct(more.scale);
}

std::vector<Eigen::VectorXd> residuals_of(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                                          const WaveformOptions& options) {
  Residuals residuals(runs, fit.laws, options);
  Eigen::VectorXd left(residuals.values());
  residuals.at(fit.value, left);
  std::vector<Eigen::VectorXd> list;
  Eigen::Index row = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    list.push_back(left.segment(row, residuals.used()[r]) * runs[r].noise);
    row += residuals.used()[r];
  }
  return list;
}

Setup with_laws(Setup setup, const WaveformFit& fit, KnownEffects known) {
  setup = prepared(std::move(setup), fit.laws, known);
  put(std::ssize(fit.residual), fit.laws, fit.value, setup);
  return setup;
}

double noise_in_band(const WaveformRun& run, const Eigen::VectorXd& residual, double frequency) {
  const double length = run.time.back() - run.time.front();
  const Eigen::Index n = residual.size();
  const double step = std::max(0.5 / length, 3 * frequency / 400);
  double sum = 0, count = 0;
  const double highest = std::min(3.5 * frequency, 0.4 * static_cast<double>(n) / length);
  for (double f = 0.5 * frequency; f <= highest; f += step, ++count) {
    double sine = 0, cosine = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double phase = two_pi * f * run.time[static_cast<std::size_t>(i)];
      sine += std::sin(phase) * residual[i], cosine += std::cos(phase) * residual[i];
    }
    sum += (sine * sine + cosine * cosine) / static_cast<double>(n);
  }
  return count > 0 ? sum / count : residual.squaredNorm() / static_cast<double>(n);
}

}  // namespace shakedown
