// SPDX-License-Identifier: MIT
#include "ring_down_signal.hpp"

#include <cmath>

#include "film.hpp"
#include "least_squares.hpp"
#include "physics.hpp"

namespace shakedown {

namespace {

/// Returns the positions of the box, m, as the camera of the setup has them but for noise, from `start` (s)
/// on.
Eigen::VectorXd seen(const Setup& setup, const RecordingSettings& recording, double start,
                     const Engine& engine) {
  Setup finely = setup;
  finely.run.sample_rate = recording.frame_rate * std::max(1.0, std::ceil(1000 / recording.frame_rate));
  const Recording film =
      filmed(physics_of(setup).camera, even_frames(recording.frame_rate, start, setup.run.duration),
             engine.run(finely));
  return Eigen::Map<const Eigen::VectorXd>(film.x_box.data(), static_cast<Eigen::Index>(film.x_box.size()));
}

/// Divides out the noise: what is left of white noise of variance `white` a frame and a wander has variance
/// one and no memory.
class Whitener {
 public:
  Whitener(const RecordingSettings& recording, const Eigen::ArrayXd& speed)
      : kept_(std::exp(-1 / (recording.frame_rate * recording.wander_time))),
        gain_(speed.size()),
        deviation_(speed.size()) {
    const double wander = recording.wander * recording.wander,
                 still = std::pow(recording.box_noise, 2) + std::pow(recording.rounding, 2) / 12;
    double expected = wander;
    for (Eigen::Index i = 0; i < speed.size(); ++i) {
      const double jitter = recording.stamped ? 0 : recording.jitter * speed[i];
      const double variance = expected + still + jitter * jitter;
      deviation_[i] = std::sqrt(variance);
      gain_[i] = expected / variance;
      expected = kept_ * kept_ * expected * (1 - gain_[i]) + (1 - kept_ * kept_) * wander;
    }
  }

  Eigen::VectorXd operator()(const Eigen::VectorXd& series) const {
    Eigen::VectorXd white(series.size());
    double expected = 0;
    for (Eigen::Index i = 0; i < series.size(); ++i) {
      const double news = series[i] - expected;
      white[i] = news / deviation_[i];
      expected = kept_ * (expected + gain_[i] * news);
    }
    return white;
  }

 private:
  double kept_;
  Eigen::ArrayXd gain_, deviation_;
};

/// Returns the change of what is seen per relative change of one key.
Eigen::VectorXd relative_slope(const Setup& truth, const std::string& key, double step,
                               const RecordingSettings& recording, const Engine& engine, KnownEffects known) {
  const double value = get_number(truth, key, known);
  const auto with = [&](double factor) {
    Setup changed = truth;
    set_number(changed, key, factor * value, known);
    return seen(changed, recording, recording.start, engine);
  };
  return (with(1 + step) - with(1 - step)) / (2 * step);
}

}  // namespace

std::vector<double> signals_of(const Setup& truth, const std::vector<std::string>& keys,
                               const RecordingSettings& recording, const Engine& engine, KnownEffects known) {
  constexpr double a_little = 0.02, of_frequency = 1e-4;  // the latter adds up over all periods
  const double moment = 1e-3 / truth.spring.frequency;
  const Eigen::VectorXd late = seen(truth, recording, recording.start + moment, engine),
                        early = seen(truth, recording, recording.start - moment, engine);
  const Eigen::Index n = std::min(late.size(), early.size());
  const Eigen::VectorXd speed = (late.head(n) - early.head(n)) / (2 * moment);
  const Whitener whitened(recording, speed.array());
  Eigen::MatrixXd columns(n, static_cast<Eigen::Index>(keys.size()) + 4);
  Eigen::Index next = 0;
  const auto add = [&](const Eigen::VectorXd& series) { columns.col(next++) = whitened(series.head(n)); };
  for (const std::string& key : keys) add(relative_slope(truth, key, a_little, recording, engine, known));
  add(relative_slope(truth, "release.displacement", a_little, recording, engine, known));
  add(relative_slope(truth, "spring.frequency", of_frequency, recording, engine, known));
  add(speed);
  add(Eigen::VectorXd::Ones(n));
  std::vector<double> signals;
  for (Eigen::Index e = 0; e < static_cast<Eigen::Index>(keys.size()); ++e) {
    Eigen::MatrixXd others(n, columns.cols() - 1);
    others << columns.leftCols(e), columns.rightCols(columns.cols() - 1 - e);
    signals.push_back((columns.col(e) - others * least_squares_coefficients(others, columns.col(e))).norm());
  }
  return signals;
}

}  // namespace shakedown
