// SPDX-License-Identifier: MIT
#include "waveform.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/NonLinearOptimization>

#include "camera.hpp"
#include "experiment_file.hpp"
#include "setup_file.hpp"
#include "swing_motion.hpp"

namespace shakedown {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr std::size_t least_frames = 16;
/// A mean over a fiftieth of a period has lost 7e-4 of the swing, alike everywhere.
constexpr double frames_a_period = 48;

double as_parameter(const MomentumTerm& term, double strength) {
  const double whole = term.present + strength;
  if (!term.inverse) return whole;
  return whole > 0 ? std::max(term.least, 1 / std::sqrt(whole)) : term.most;
}

Eigen::Index count_of(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws) {
  Eigen::Index count = 3 * std::ssize(runs) + 1;
  for (const WaveformLaw& law : laws) count += law.width();
  return count;
}

/// A number of an effect that the setup has, whatever its bounds: a search may pass through what cannot be.
void put(const std::string& key, double value, Setup& setup) {
  const std::size_t dot = key.find('.');
  const std::string_view effect = std::string_view(key).substr(0, dot);
  const std::string_view parameter = std::string_view(key).substr(dot + 1);
  const std::size_t component = parameter.find('.');
  for (EffectChoice& choice : setup.effects) {
    if (choice.record->name != effect) continue;
    ParameterValue& place = choice.values.find(parameter.substr(0, component))->second;
    if (component == std::string_view::npos)
      place = value;
    else
      std::get<Vec3>(place)[parameter.back() - 'x'] = value;
    return;
  }
}

/// The setup with every law in it, at a strength that is within its bounds.
Setup prepared(Setup setup, const std::vector<WaveformLaw>& laws,
               std::span<const EffectRecord* const> known) {
  for (const WaveformLaw& law : laws)
    setup = with_strength(std::move(setup), law.term, law.term.typical, known);
  return setup;
}

/// Sets the keys of one law, which the setup has, from its values.
void put(const WaveformLaw& law, const double* value, Setup& setup) {
  if (!law.is_mode) return put(law.term.key(), as_parameter(law.term, value[0]), setup);
  put(law.term.key(), std::hypot(value[0], value[1]), setup);
  put(law.phase_key, std::atan2(value[1], value[0]), setup);
  put(law.frequency_key, value[2], setup);
  if (!law.rate_key.empty()) put(law.rate_key, value[3], setup);
}

void put(Eigen::Index runs, const std::vector<WaveformLaw>& laws, const Eigen::VectorXd& value,
         Setup& setup) {
  setup.spring.frequency = value[3 * runs];
  Eigen::Index next = 3 * runs + 1;
  for (const WaveformLaw& law : laws) {
    put(law, value.data() + next, setup);
    next += law.width();
  }
}

/// Measured less modelled, in standard deviations, of all runs; laid out for MINPACK's algorithm.
class Residuals {
 public:
  using Scalar = double;
  Residuals(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
            const WaveformOptions& options)
      : runs_(runs), laws_(laws), options_(options) {
    for (const WaveformRun& run : runs) {
      const double end = run.time.front() + options.until;
      used_.push_back(std::upper_bound(run.time.begin(), run.time.end(), end) - run.time.begin());
      frames_ += used_.back();
    }
    inputs_ = count_of(runs, laws);
    for (const WaveformRun& run : runs) setups_.push_back(prepared(run.setup, laws, options.known));
  }
  int inputs() const { return static_cast<int>(inputs_); }
  int values() const { return static_cast<int>(frames_); }

  int operator()(const Eigen::VectorXd& scaled, Eigen::VectorXd& out) const {
    return at(value_of(scaled), out), 0;
  }
  int df(const Eigen::VectorXd& scaled, Eigen::MatrixXd& slope) const {
    constexpr double step = 1e-4;
    Eigen::VectorXd here(frames_), there(frames_);
    at(value_of(scaled), here);
    for (Eigen::Index k = 0; k < inputs_; ++k) {
      if (scale_[k] == 0) {
        slope.col(k).setZero();
        continue;
      }
      Eigen::VectorXd moved = scaled;
      moved[k] += step;
      const Eigen::Index run = k < 3 * std::ssize(runs_) ? k / 3 : -1;
      there = here;
      at(value_of(moved), there, run);
      slope.col(k) = (there - here) / step;
    }
    return 0;
  }
  Eigen::VectorXd value_of(const Eigen::VectorXd& scaled) const {
    return start_.array() + scaled.array() * scale_.array();
  }

  /// Only of one run where `only` is given.
  bool at(const Eigen::VectorXd& value, Eigen::VectorXd& out, Eigen::Index only = -1) const {
    Eigen::Index row = 0;
    bool possible = true;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const Eigen::Index n = used_[r];
      if (only < 0 || only == static_cast<Eigen::Index>(r)) possible &= of_run(r, value, out.segment(row, n));
      row += n;
    }
    return possible;
  }

  /// Steps by which the motion changes by about its amplitude, so that all numbers are alike.
  void start_from(const Eigen::VectorXd& start) {
    start_ = start;
    scale_ = Eigen::VectorXd::Zero(inputs_);
    const Eigen::Index shared = 3 * std::ssize(runs_);
    double longest = 0, amplitude = 0;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const double a = runs_[r].amplitude;
      scale_.segment(3 * static_cast<Eigen::Index>(r), 3) << a, a * two_pi * start[shared], a;
      const auto last = static_cast<std::size_t>(std::max<Eigen::Index>(1, used_[r])) - 1;
      longest = std::max(longest, runs_[r].time[last] - runs_[r].time.front());
      amplitude = std::max(amplitude, a);
    }
    if (options_.free_frequency) scale_[shared] = 1 / (two_pi * std::max(longest, 1 / start[shared]));
    Eigen::VectorXd here(frames_), there(frames_);
    at(start, here);
    const double whole = root_of_sum_of_squares();
    Eigen::Index next = shared + 1;
    for (const WaveformLaw& law : laws_)
      for (Eigen::Index i = 0; i < law.width(); ++i, ++next) {
        double step = 1e-3 * law.term.typical;
        if (law.is_mode && i >= 2) step = i == 2 ? 1e-3 / longest : 1e-3 / longest;
        Eigen::VectorXd moved = start;
        moved[next] += step;
        at(moved, there);
        const double change = (there - here).norm();
        scale_[next] = change > 0 ? std::min(step * whole / change, 1e6 * step) : 0;
      }
  }

 private:
  double root_of_sum_of_squares() const {
    double sum = 0;
    for (std::size_t r = 0; r < runs_.size(); ++r)
      sum += static_cast<double>(used_[r]) * std::pow(runs_[r].amplitude / runs_[r].noise, 2) / 4;
    return std::sqrt(sum);
  }

  bool of_run(std::size_t r, const Eigen::VectorXd& value, Eigen::Ref<Eigen::VectorXd> out) const {
    const WaveformRun& run = runs_[r];
    const Eigen::Index first = 3 * static_cast<Eigen::Index>(r);
    std::vector<double> time{run.start_time()};
    time.insert(time.end(), run.time.begin(), run.time.begin() + used_[r]);
    constexpr double too_far = 10;  // amplitudes: the box has run away
    const double frequency = value[3 * std::ssize(runs_)];
    std::vector<double> x;
    Physics physics;
    if (frequency > 0) {
      Setup setup = setups_[r];
      put(std::ssize(runs_), laws_, value, setup);
      physics = physics_of(setup);
      x = swing_of(physics, {value[first], value[first + 1]}, time, too_far * run.amplitude);
    }
    if (x.empty()) {
      out.setConstant(too_far * run.amplitude / run.noise);
      return false;
    }
    if (!(physics.camera == Camera{})) x = seen_through(physics.camera, {time, std::move(x), {}}).x_box;
    for (Eigen::Index i = 0; i < used_[r]; ++i)
      out[i] = (run.x[static_cast<std::size_t>(i)] - value[first + 2] - x[static_cast<std::size_t>(i) + 1]) /
               run.noise;
    return out.allFinite();
  }

  const std::vector<WaveformRun>& runs_;
  const std::vector<WaveformLaw>& laws_;
  const WaveformOptions& options_;
  std::vector<Setup> setups_;  ///< of each run, with all laws
  std::vector<Eigen::Index> used_;
  Eigen::Index frames_ = 0, inputs_ = 0;
  Eigen::VectorXd start_, scale_;

 public:
  const std::vector<Eigen::Index>& used() const { return used_; }
  const Eigen::VectorXd& scale() const { return scale_; }
};

WaveformRun waveform_run(const Measurement::Run& run, bool every_frame) {
  WaveformRun made{run.recorded.name, run.setup, {}, {}, run.audit.box.standard_deviation, 0, 0};
  std::vector<double> time, x;
  for (std::size_t i = 0; i < run.recorded.time.size(); ++i)
    if (std::isfinite(run.audit.x_box[i]) &&
        (starts_anywhere(run.recorded, run.setup) || run.recorded.time[i] >= 0))
      time.push_back(run.recorded.time[i]), x.push_back(run.audit.x_box[i]);
  if (time.size() < least_frames) return made;
  made.begin = time.front();
  const double interval = (time.back() - time.front()) / static_cast<double>(time.size() - 1),
               period = 1 / run.setup.spring.frequency;
  const auto group =
      every_frame ? std::size_t{1}
                  : static_cast<std::size_t>(std::max(1.0, std::floor(period / interval / frames_a_period)));
  for (std::size_t i = 0; i + group <= time.size(); i += group) {
    double t = 0, sum = 0;
    for (std::size_t k = i; k < i + group; ++k) t += time[k], sum += x[k];
    made.time.push_back(t / static_cast<double>(group)), made.x.push_back(sum / static_cast<double>(group));
  }
  const auto [low, high] = std::minmax_element(made.x.begin(), made.x.end());
  made.amplitude = (*high - *low) / 2;
  made.white /= std::sqrt(static_cast<double>(group));
  // A recording without any noise is known to its rounding.
  made.noise = std::max(made.white, 1e-6 * made.amplitude);
  return made;
}

}  // namespace

bool WaveformLaw::operator==(const WaveformLaw& other) const {
  return term.key() == other.term.key() && term.besides == other.term.besides && is_mode == other.is_mode;
}

std::vector<WaveformRun> waveform_runs(const Measurement& measurement, bool every_frame) {
  std::vector<WaveformRun> runs;
  for (const Measurement::Run& run : measurement.runs)
    if (run.setup.spring.frequency > 0)
      if (WaveformRun made = waveform_run(run, every_frame);
          made.time.size() >= least_frames && made.amplitude > 0)
        runs.push_back(std::move(made));
  return runs;
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
    // A sine about a constant through the first period.
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
        columns.colPivHouseholderQr().solve(Eigen::Map<Eigen::VectorXd>(right.data(), std::ssize(right)));
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
  fit.frames = residuals.values();
  residuals.start_from(start);
  Eigen::VectorXd scaled = Eigen::VectorXd::Zero(residuals.inputs()), left(fit.frames);
  if (fit.frames > residuals.inputs()) {
    Eigen::LevenbergMarquardt<Residuals> search(residuals);
    search.parameters.maxfev = options.evaluations;
    // chi2 is some thousands, and ln odds are wanted to a tenth.
    search.parameters.ftol = search.parameters.xtol = 1e-5;
    // MINPACK's first region of trust, in the units of the residuals where the start is the origin.
    residuals.at(start, left);
    search.parameters.factor = std::max(1.0, left.norm());
    search.minimize(scaled);
  }
  fit.value = residuals.value_of(scaled);
  fit.possible = residuals.at(fit.value, left);
  fit.chi2 = left.squaredNorm();
  Eigen::MatrixXd slope(fit.frames, residuals.inputs());
  residuals.df(scaled, slope);
  Eigen::MatrixXd normal = slope.transpose() * slope;
  // What is fixed or leaves no trace stays where it is.
  for (Eigen::Index k = 0; k < normal.rows(); ++k)
    if (!(normal(k, k) > 0)) normal(k, k) = 1e300;
  const Eigen::VectorXd root = normal.diagonal().cwiseSqrt();
  const Eigen::MatrixXd correlation =
      root.cwiseInverse().asDiagonal() * normal * root.cwiseInverse().asDiagonal();
  const Eigen::VectorXd outer = residuals.scale().cwiseQuotient(root);
  fit.covariance =
      outer.asDiagonal() * correlation.completeOrthogonalDecomposition().pseudoInverse() * outer.asDiagonal();
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

/// The residuals of a fit with one more law, and how they change with its first numbers.
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

LawScore score_of(const std::vector<WaveformRun>& runs, const WaveformFit& fit, const WaveformLaw& law,
                  const WaveformOptions& options) {
  const Eigen::VectorXd near_none =
      Eigen::VectorXd::Constant(1, law.term.inverse ? 1e-4 * law.term.typical : 0);
  const OneMore more = one_more(runs, fit, law, 1, near_none, options);
  const Eigen::VectorXd column = more.columns.col(0);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(more.free);
  const Eigen::VectorXd outside = column - more.free * qr.solve(column);
  const double squares = outside.squaredNorm();
  if (!(column.squaredNorm() > 0) || !(squares > 0)) return {};
  return {std::pow(outside.dot(more.left), 2) / squares, squares / column.squaredNorm()};
}

Eigen::Vector2d linear_mode(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                            const WaveformLaw& law, double frequency, const WaveformOptions& options) {
  Eigen::VectorXd start(4);
  start << 0, 0, frequency, 0;
  const OneMore more = one_more(runs, fit, law, 2, start, options);
  Eigen::MatrixXd all(more.left.size(), more.free.cols() + 2);
  all << more.free, more.columns;
  const Eigen::VectorXd step = -all.colPivHouseholderQr().solve(more.left);
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

Setup with_laws(Setup setup, const WaveformFit& fit, std::span<const EffectRecord* const> known) {
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
