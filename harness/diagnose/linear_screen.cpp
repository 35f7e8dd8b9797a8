// SPDX-License-Identifier: MIT
#include "linear_screen.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "feature_covariance.hpp"

namespace shakedown {

namespace {

/// Columns (features x knobs) and residual of one experiment, whitened and stacked over the runs.
struct Linear {
  Eigen::MatrixXd columns;
  Eigen::VectorXd residual;
};

Linear whitened(const std::vector<MeasuredFeatures>& measured, const std::vector<Emulator>& emulators, Eigen::Index knobs) {
  Eigen::Index total = 0, at = 0;
  for (const MeasuredFeatures& m : measured) total += m.values.size();
  Linear linear{Eigen::MatrixXd(total, knobs), Eigen::VectorXd(total)};
  for (std::size_t r = 0; r < measured.size(); ++r) {
    const Emulator& e = emulators[r];
    const Eigen::LLT<Eigen::MatrixXd> root(feature_covariance(e.residuals, measured[r].plan, 0));
    const Eigen::Index n = measured[r].values.size();
    linear.columns.middleRows(at, n) = root.matrixL().solve(e.coefficients.middleRows(1, knobs).transpose());
    linear.residual.segment(at, n) = root.matrixL().solve(measured[r].values - e.coefficients.row(0).transpose());
    at += n;
  }
  return linear;
}

/// What the fitted parameters cannot take up of a column.
class Outside {
 public:
  explicit Outside(const Eigen::MatrixXd& free)
      : free_(free), normal_(free.transpose() * free + 1e-9 * Eigen::MatrixXd::Identity(free.cols(), free.cols())) {}
  Eigen::VectorXd operator()(const Eigen::VectorXd& column) const { return column - free_ * normal_.solve(free_.transpose() * column); }

 private:
  Eigen::MatrixXd free_;
  Eigen::LDLT<Eigen::MatrixXd> normal_;
};

struct Screening {
  std::vector<ScreenedEffect> list;
  std::vector<Eigen::VectorXd> signatures;  ///< of each in the list, whitened, with the fitted parameters projected out; empty: on or off
};

std::vector<Knob> straight(std::vector<Knob> knobs, double widths) {
  for (Knob& knob : knobs) {
    knob.width *= widths;
    knob.curved = false;
  }
  return knobs;
}

/// Candidates with knobs, scattered together in `count` runs.
/// Returns what the fitted parameters alone leave of the residual's square.
double screen_together(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted, const std::vector<Candidate>& candidates,
                     const std::vector<std::size_t>& members, const Workshop& workshop, int count, int first_run, Screening& screening) {
  std::vector<Knob> knobs = straight(fitted, 0.5);
  std::vector<std::size_t> candidate_of;
  std::vector<MeasuredFeatures> with = measured;
  for (const std::size_t c : members) {
    for (const Knob& knob : straight(candidates[c].knobs, 1)) {
      knobs.push_back(knob);
      candidate_of.push_back(c);
    }
    for (MeasuredFeatures& m : with) m.setup = prepared(m.setup, candidates[c], workshop.known);
  }
  const auto n_fitted = static_cast<Eigen::Index>(fitted.size());
  const Linear linear = whitened(with, emulate(with, knobs, count, first_run, workshop), static_cast<Eigen::Index>(knobs.size()));
  const Outside outside(linear.columns.leftCols(n_fitted));
  Eigen::VectorXd without = linear.residual;  // of the model with all candidates absent
  for (std::size_t k = fitted.size(); k < knobs.size(); ++k) without -= linear.columns.col(static_cast<Eigen::Index>(k)) * knobs[k].z_of(when_absent(knobs[k]));
  const Eigen::VectorXd residual = outside(without);
  for (std::size_t k = 0; k < candidate_of.size(); ++k) {
    const Knob& knob = knobs[fitted.size() + k];
    const Eigen::VectorXd signature = outside(linear.columns.col(n_fitted + static_cast<Eigen::Index>(k)));
    const double square = signature.squaredNorm(), by = square > 0 ? signature.dot(residual) / square : 0;
    const double z = knob.z_of(when_absent(knob)) + by;
    const bool allowed = by == 0 || knob.at(z) != when_absent(knob);  // a drag cannot push
    screening.list.push_back({candidate_of[k], candidates[candidate_of[k]].effect, allowed ? by * by * square : 0, knob.at(z), {}});
    screening.signatures.push_back(signature);
  }
  return residual.squaredNorm();
}

/// On or off: the model with it, beside the model without.
void screen_switch(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted, const std::vector<Candidate>& candidates,
                   std::size_t c, const Workshop& workshop, int count, int first_run, double without, Screening& screening) {
  std::vector<MeasuredFeatures> with = measured;
  for (MeasuredFeatures& m : with) m.setup = prepared(m.setup, candidates[c], workshop.known);
  const auto n_fitted = static_cast<Eigen::Index>(fitted.size());
  const Linear linear = whitened(with, emulate(with, straight(fitted, 0.5), count, first_run, workshop), n_fitted);
  screening.list.push_back({c, candidates[c].effect, without - Outside(linear.columns)(linear.residual).squaredNorm(), 0, {}});
  screening.signatures.emplace_back();
}

}  // namespace

std::vector<ScreenedEffect> screen(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
                                   const std::vector<Candidate>& candidates, const Workshop& workshop, int count, int first_run) {
  Screening screening;
  std::vector<std::size_t> cheap;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    if (!candidates[c].dear && !candidates[c].knobs.empty()) cheap.push_back(c);
  int batch = 0;
  const auto next = [&] { return first_run + 5000 * batch++; };
  const double without = screen_together(measured, fitted, candidates, cheap, workshop, count, next(), screening);
  const int few = std::max(40, count / 8);
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (candidates[c].dear && candidates[c].always) {
      screening.list.push_back({c, candidates[c].effect, 0, candidates[c].knobs.front().centre, {}});
      screening.signatures.emplace_back();
      continue;
    }
    if (candidates[c].dear) screen_together(measured, fitted, candidates, {c}, workshop, few, next(), screening);
    if (!candidates[c].knobs.empty()) continue;
    screen_switch(measured, fitted, candidates, c, workshop, few, next(), without, screening);
  }
  std::vector<ScreenedEffect>& list = screening.list;
  const std::vector<Eigen::VectorXd>& signatures = screening.signatures;
  for (std::size_t a = 0; a < list.size(); ++a)
    for (std::size_t b = 0; b < list.size(); ++b) {
      if (a == b || list[a].effect == list[b].effect || signatures[a].size() == 0 || signatures[b].size() == 0) continue;
      const double cosine = signatures[a].dot(signatures[b]) / std::max(1e-300, signatures[a].norm() * signatures[b].norm());
      if (std::abs(cosine) > 0.9) list[a].look_alikes.push_back(list[b].effect);
    }
  std::stable_sort(list.begin(), list.end(), [](const ScreenedEffect& a, const ScreenedEffect& b) { return a.gain > b.gain; });
  return list;
}

}  // namespace shakedown
