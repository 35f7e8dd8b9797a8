// SPDX-License-Identifier: MIT
#include "linear_model.hpp"

#include <algorithm>

namespace shakedown {

LinearModel linear_model(const std::vector<MeasuredFeatures>& measured,
                         const std::vector<Emulator>& emulators, std::size_t knobs, const Weigh& weigh) {
  const auto n = static_cast<Eigen::Index>(knobs);
  Eigen::Index total = 0, at = 0;
  for (const MeasuredFeatures& m : measured) total += m.values.size();
  LinearModel model{Eigen::MatrixXd(total, n), Eigen::VectorXd(total)};
  for (std::size_t r = 0; r < measured.size(); ++r) {
    const Eigen::MatrixXd& coefficients = emulators[r].coefficients;
    const Eigen::Index rows = measured[r].values.size();
    Eigen::MatrixXd block(rows, n + 1);
    block.leftCols(n) = coefficients.middleRows(1, n).transpose();
    block.col(n) = measured[r].values - coefficients.row(0).transpose();
    if (weigh) weigh(r, block);
    model.columns.middleRows(at, rows) = block.leftCols(n);
    model.residual.segment(at, rows) = block.col(n);
    at += rows;
  }
  return model;
}

BesideFitted beside_fitted(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
                           const std::vector<Candidate>& candidates, const std::vector<std::size_t>& members,
                           KnownEffects known) {
  BesideFitted beside{straight(fitted, 0.5), {}, measured};
  for (const std::size_t c : members) {
    for (const Knob& knob : straight(candidates[c].knobs, 1)) {
      beside.knobs.push_back(knob);
      beside.candidate_of.push_back(c);
    }
    for (MeasuredFeatures& m : beside.measured) m.setup = prepared(m.setup, candidates[c], known);
  }
  return beside;
}

std::vector<MeasuredFeatures> kicked_rarely(std::vector<MeasuredFeatures> measured) {
  constexpr double rarely = 4e-2;  // s
  for (MeasuredFeatures& m : measured)
    m.setup.hard.kick_interval = std::max(m.setup.hard.kick_interval, rarely);
  return measured;
}

Eigen::VectorXd residual_without(const LinearModel& model, const std::vector<Knob>& knobs,
                                 std::size_t fitted) {
  Eigen::VectorXd residual = model.residual;
  for (std::size_t k = fitted; k < knobs.size(); ++k)
    residual -= model.columns.col(static_cast<Eigen::Index>(k)) * knobs[k].z_of(knobs[k].absent);
  return residual;
}

std::vector<Knob> straight(std::vector<Knob> knobs, double widths) {
  for (Knob& knob : knobs) {
    knob.width *= widths;
    knob.curved = false;
  }
  return knobs;
}

}  // namespace shakedown
