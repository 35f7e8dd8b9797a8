// SPDX-License-Identifier: MIT
#include "linear_screen.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "feature_covariance.hpp"
#include "linear_model.hpp"

namespace shakedown {

namespace {

using Roots = std::vector<Eigen::LLT<Eigen::MatrixXd>>;

/// Of each run's chaos and camera noise.
Roots roots_of(const std::vector<MeasuredFeatures>& measured, const std::vector<Emulator>& emulators) {
  Roots roots;
  for (std::size_t r = 0; r < measured.size(); ++r) {
    Eigen::MatrixXd covariance = feature_covariance(emulators[r].residuals, measured[r].plan, 0);
    if (measured[r].own.cols() > 0) covariance += measured[r].own * measured[r].own.transpose();
    roots.emplace_back(covariance);
  }
  return roots;
}

/// Below the features a row for each of the first `fitted` knobs: what is known of it beforehand.
LinearModel whitened(const std::vector<MeasuredFeatures>& measured, const std::vector<Emulator>& emulators,
                     const std::vector<Knob>& knobs, std::size_t fitted, const Roots& roots) {
  LinearModel model =
      linear_model(measured, emulators, knobs.size(),
                   [&](std::size_t r, Eigen::MatrixXd& block) { roots[r].matrixL().solveInPlace(block); });
  const Eigen::Index features = model.residual.size(), count = static_cast<Eigen::Index>(fitted);
  model.columns.conservativeResize(features + count, Eigen::NoChange);
  model.residual.conservativeResize(features + count);
  model.columns.bottomRows(count).setZero();
  model.residual.tail(count).setZero();
  for (Eigen::Index k = 0; k < count; ++k) {
    const Knob& knob = knobs[static_cast<std::size_t>(k)];
    if (!(knob.believed_error > 0)) continue;
    model.columns(features + k, k) = knob.width / knob.believed_error;
    model.residual[features + k] = (knob.believed - knob.centre) / knob.believed_error;
  }
  return model;
}

/// What the regression's own error adds to a whitened square: a term's share of each feature.
double own_error(const std::vector<Emulator>& emulators) {
  double sum = 0;
  for (const Emulator& e : emulators)
    sum += static_cast<double>(e.coefficients.size()) / static_cast<double>(e.residuals.rows());
  return sum;
}

/// What the fitted parameters cannot take up of a column.
class Outside {
 public:
  explicit Outside(const Eigen::MatrixXd& free)
      : free_(free),
        normal_(free.transpose() * free + 1e-9 * Eigen::MatrixXd::Identity(free.cols(), free.cols())) {}
  Eigen::VectorXd operator()(const Eigen::VectorXd& column) const {
    return column - free_ * normal_.solve(free_.transpose() * column);
  }

 private:
  Eigen::MatrixXd free_;
  Eigen::LDLT<Eigen::MatrixXd> normal_;
};

struct Screening {
  std::vector<ScreenedEffect> list;
  Roots roots;                              ///< one metric for all, of the first and largest regression
  std::vector<Eigen::VectorXd> signatures;  ///< of each in the list, whitened, with the fitted parameters
                                            ///< projected out; empty: on or off
};

/// What the fitted parameters alone leave.
struct Left {
  Outside outside;
  Eigen::VectorXd residual;
};

/// Candidates with knobs, scattered together beside the fitted parameters.
struct Scattered {
  std::vector<Knob> knobs;  ///< the fitted parameters first
  std::vector<std::size_t> candidate_of;
  LinearModel linear;
  Eigen::Index fitted = 0;

  Left left() const {
    const Outside outside(linear.columns.leftCols(fitted));
    return {outside, outside(residual_without(linear, knobs, static_cast<std::size_t>(fitted)))};
  }
};

/// In `count` runs of each setup. Sets the metric, if none is there.
Scattered scattered(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
                    const std::vector<Candidate>& candidates, const std::vector<std::size_t>& members,
                    const Workshop& workshop, int count, int first_run, Roots& roots) {
  auto [knobs, candidate_of, with] = beside_fitted(measured, fitted, candidates, members, workshop.known);
  const std::vector<Emulator> emulators = emulate(with, knobs, count, first_run, workshop);
  if (roots.empty()) roots = roots_of(with, emulators);
  LinearModel linear = whitened(with, emulators, knobs, fitted.size(), roots);
  return {std::move(knobs), std::move(candidate_of), std::move(linear),
          static_cast<Eigen::Index>(fitted.size())};
}

/// Each scattered candidate by what the fitted parameters leave without them: in the same runs, or, where
/// they are few and what is scattered is far from linear, in others.
void judge_scattered(const Scattered& s, const std::vector<Candidate>& candidates, const Left& without,
                     Screening& screening) {
  const auto& [outside, residual] = without;
  for (std::size_t k = 0; k < s.candidate_of.size(); ++k) {
    const Eigen::Index column = s.fitted + static_cast<Eigen::Index>(k);
    const Knob& knob = s.knobs[static_cast<std::size_t>(column)];
    const Eigen::VectorXd signature = outside(s.linear.columns.col(column));
    const double square = signature.squaredNorm(), by = square > 0 ? signature.dot(residual) / square : 0;
    const double z = knob.z_of(when_absent(knob)) + by;
    const bool allowed = by == 0 || knob.at(z) != when_absent(knob);  // a drag cannot push
    const Candidate& candidate = candidates[s.candidate_of[k]];
    StrengthSeen seen = candidate.prior;
    seen.gain = allowed ? by * by * square : 0;
    seen.value = knob.at(z) - when_absent(knob);
    if (seen.one_sided) seen.value = std::abs(seen.value);
    seen.error = square > 0 ? knob.width / std::sqrt(square) : 0;
    screening.list.push_back({s.candidate_of[k], candidate.effect, seen.gain, knob.at(z), seen, {}});
    screening.signatures.push_back(signature);
  }
}

/// On or off: the model with it, beside the model without. The difference is its signature at the strength
/// that it is prepared with; what is fixed of it is a length, and its strength goes with the curvature.
void screen_switch(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
                   const std::vector<Candidate>& candidates, std::size_t c, const Workshop& workshop,
                   int count, int first_run, const Left& without, Screening& screening) {
  std::vector<MeasuredFeatures> with = measured;
  for (MeasuredFeatures& m : with) m.setup = prepared(m.setup, candidates[c], workshop.known);
  const std::vector<Knob> beside = straight(fitted, 0.5);
  const std::vector<Emulator> emulators = emulate(with, beside, count, first_run, workshop);
  const Eigen::VectorXd signature =
      without.residual -
      without.outside(whitened(with, emulators, beside, fitted.size(), screening.roots).residual);
  const double square = std::max(0.0, signature.squaredNorm() - own_error(emulators)),
               along = signature.dot(without.residual);
  const bool is_seen = square > 0 && along > 0;
  const double length = candidates[c].fixed.back().second * (is_seen ? std::sqrt(square / along) : 1);
  StrengthSeen seen = candidates[c].prior;
  seen.gain = is_seen ? along * along / signature.squaredNorm() : 0;
  seen.value = 1 / (length * length);
  seen.error = seen.gain > 0 ? seen.value / std::sqrt(seen.gain) : 0;
  screening.list.push_back({c, candidates[c].effect, seen.gain, length, seen, {}});
  screening.signatures.push_back(signature);
}

}  // namespace

std::vector<ScreenedEffect> screen(const std::vector<MeasuredFeatures>& measured,
                                   const std::vector<Knob>& fitted, const std::vector<Candidate>& candidates,
                                   const Workshop& workshop, int count, int first_run) {
  Screening screening;
  const ScatterGroups groups = scatter_groups(candidates);
  int batch = 0;
  const auto together = [&](const std::vector<MeasuredFeatures>& of, const std::vector<std::size_t>& members,
                            int simulations) {
    return scattered(of, fitted, candidates, members, workshop, simulations, first_run + 5000 * batch++,
                     screening.roots);
  };
  const Scattered all = together(measured, groups.cheap, count);
  const Left without = all.left();
  judge_scattered(all, candidates, without, screening);
  const int few = std::max(40, count / 8), fewest = std::max(24, few / 2);
  const std::vector<MeasuredFeatures> rough = kicked_rarely(measured);
  for (const std::vector<std::size_t>& members : groups.slow)
    judge_scattered(together(rough, members, std::max(few, count / 6 * static_cast<int>(members.size()))),
                    candidates, without, screening);
  for (const std::vector<std::size_t>& members : groups.dear) {
    const Candidate& candidate = candidates[members.front()];
    if (candidate.always) {
      screening.list.push_back(
          {members.front(), candidate.effect, 0, candidate.knobs.front().centre, candidate.prior, {}});
      screening.signatures.emplace_back();
    } else {  // what is dear has a strong signature
      judge_scattered(together(measured, members, fewest), candidates, without, screening);
    }
  }
  for (std::size_t c = 0; c < candidates.size(); ++c)
    if (candidates[c].knobs.empty())
      screen_switch(measured, fitted, candidates, c, workshop, few, first_run + 5000 * batch++, without,
                    screening);
  std::vector<ScreenedEffect>& list = screening.list;
  const std::vector<Eigen::VectorXd>& signatures = screening.signatures;
  for (std::size_t a = 0; a < list.size(); ++a)
    for (std::size_t b = 0; b < list.size(); ++b) {
      if (a == b || list[a].effect == list[b].effect || signatures[a].size() == 0 ||
          signatures[b].size() == 0)
        continue;
      const double cosine =
          signatures[a].dot(signatures[b]) / std::max(1e-300, signatures[a].norm() * signatures[b].norm());
      if (std::abs(cosine) > 0.9) list[a].look_alikes.push_back(list[b].effect);
    }
  std::stable_sort(list.begin(), list.end(),
                   [](const ScreenedEffect& a, const ScreenedEffect& b) { return a.gain > b.gain; });
  return list;
}

}  // namespace shakedown
