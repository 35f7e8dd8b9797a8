// SPDX-License-Identifier: MIT
#include "failure_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace shakedown {

namespace {

constexpr double stretch = 2.0;  // s
constexpr std::size_t least_features = 4;

const char* name_of(Observable observable) { return observable == Observable::box ? "box" : "grain centre"; }

/// Holds the measured box at each feature's time; tells its place, the height of its swing and its phase
/// about then.
struct Swing {
  std::vector<double> time, x;

  double at(double t) const {
    const auto next = std::lower_bound(time.begin(), time.end(), t);
    if (next == time.begin()) return x.front();
    if (next == time.end()) return x.back();
    const auto i = static_cast<std::size_t>(next - time.begin());
    return x[i - 1] + (x[i] - x[i - 1]) * (t - time[i - 1]) / (time[i] - time[i - 1]);
  }
  double largest() const {
    double most = 0;
    for (const double place : x) most = std::max(most, std::abs(place));
    return most;
  }
  double amplitude(double t, double period) const {
    constexpr double about_half = 0.55;  // of a period: a turning point lies within
    double most = 0;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (std::abs(time[i] - t) <= about_half * period) most = std::max(most, std::abs(x[i]));
    return most;
  }
  /// Returns the phase, rad: 0 at the release side's turning point, growing with time, in (-pi, pi].
  double phase(double t, double period) const {
    const double speed =
        (at(t + period / 16) - at(t - period / 16)) / (period / 8) * period / (2 * std::numbers::pi);
    return std::atan2(-speed, at(t));
  }
};

Swing swing_of(const MeasuredFeatures& m) {
  Swing swing;
  for (std::size_t f = 0; f < m.plan.features.size(); ++f)
    if (m.plan.features[f].observable == Observable::box) {
      swing.time.push_back(m.plan.features[f].time);
      swing.x.push_back(m.values[static_cast<Eigen::Index>(f)]);
    }
  return swing;
}

/// Names an amplitude by its share of the run's largest.
std::string amplitude_word(double share) {
  constexpr std::array<std::pair<double, const char*>, 3> words{
      {{0.6, "amplitude above 60 % of the largest"},
       {0.3, "amplitude 30 to 60 % of the largest"},
       {0.1, "amplitude 10 to 30 % of the largest"}}};
  for (const auto& [above, word] : words)
    if (share > above) return word;
  return "amplitude below 10 % of the largest";
}

std::string phase_word(double phase) {
  static const std::array<const char*, 8> words{"turning point on the release side",
                                                "leaving the release side",
                                                "mid-stroke inwards",
                                                "nearing the far side",
                                                "turning point on the far side",
                                                "leaving the far side",
                                                "mid-stroke outwards",
                                                "nearing the release side"};
  const double octant = std::round(phase / (std::numbers::pi / 4));
  return std::string("phase: ") + words[static_cast<std::size_t>(static_cast<int>(octant) + 8) % 8];
}

}  // namespace

std::vector<Cell> cells_of(const std::vector<MeasuredFeatures>& measured) {
  std::map<std::pair<std::string, std::string>, Cell> of_all;
  std::vector<Cell> cells;
  for (std::size_t r = 0; r < measured.size(); ++r) {
    const MeasuredFeatures& m = measured[r];
    const Swing swing = swing_of(m);
    const double period = 1 / m.setup.spring.frequency, largest = swing.largest();
    std::map<std::pair<int, int>, Cell> of_run;  // observable; stretch, -1: whole
    std::map<double, double> centre;
    for (std::size_t f = 0; f < m.plan.features.size(); ++f)
      if (m.plan.features[f].observable == Observable::centre)
        centre[m.plan.features[f].time] = m.values[static_cast<Eigen::Index>(f)];
    constexpr std::size_t a_swing = 4;  // features
    constexpr double at_a_wall = 0.75;  // of the farthest that the centre comes from the middle
    double farthest = 0;
    if (swing.time.size() >= a_swing)
      for (const auto& [time, x] : centre) farthest = std::max(farthest, std::abs(x - swing.at(time)));
    for (std::size_t f = 0; f < m.plan.features.size(); ++f) {
      const Feature& feature = m.plan.features[f];
      const std::pair<std::size_t, Eigen::Index> place{r, static_cast<Eigen::Index>(f)};
      const std::string observable = name_of(feature.observable);
      const int slot = static_cast<int>(feature.time / stretch), which = static_cast<int>(feature.observable);
      of_run.try_emplace({which, -1}, Cell{m.run, observable, "whole run", 0, m.plan.end, {}})
          .first->second.features.push_back(place);
      of_run
          .try_emplace({which, slot},
                       Cell{m.run, observable, "time", slot * stretch, (slot + 1) * stretch, {}})
          .first->second.features.push_back(place);
      const auto in_all = [&](const std::string& what) {
        of_all.try_emplace({observable, what}, Cell{"", observable, what, 0, 0, {}})
            .first->second.features.push_back(place);
      };
      if (swing.time.size() < a_swing) continue;
      in_all(amplitude_word(swing.amplitude(feature.time, period) / largest));
      in_all(phase_word(swing.phase(feature.time, period)));
      if (const auto there = centre.find(feature.time); there != centre.end())
        in_all(std::abs(there->second - swing.at(feature.time)) > at_a_wall * farthest
                   ? "landing (grains at an end wall)"
                   : "flight (grains between the end walls)");
    }
    for (auto& [key, cell] : of_run) cells.push_back(std::move(cell));
  }
  for (auto& [key, cell] : of_all) cells.push_back(std::move(cell));
  std::erase_if(cells, [](const Cell& cell) { return cell.features.size() < least_features; });
  return cells;
}

Eigen::VectorXd cell_sums(const std::vector<Cell>& cells, const std::vector<Eigen::VectorXd>& residuals,
                          const std::vector<Eigen::VectorXd>& spreads) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(cells.size()));
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const auto& [run, f] : cells[c].features)
      sums[static_cast<Eigen::Index>(c)] += std::pow(residuals[run][f] / spreads[run][f], 2);
  return sums;
}

std::vector<FailureCell> judge_cells(const std::vector<Cell>& cells,
                                     const std::vector<Eigen::VectorXd>& residuals,
                                     const std::vector<Eigen::VectorXd>& spreads,
                                     const Eigen::MatrixXd& pseudo) {
  if (cells.empty()) return {};  // recordings too short for a cell
  const Eigen::VectorXd sums = cell_sums(cells, residuals, spreads);
  const Eigen::RowVectorXd mean = pseudo.colwise().mean();
  const Eigen::RowVectorXd deviation = ((pseudo.rowwise() - mean).colwise().squaredNorm() /
                                        std::max<double>(1, static_cast<double>(pseudo.rows() - 1)))
                                           .cwiseSqrt();
  const Eigen::VectorXd worst =
      ((pseudo.rowwise() - mean).array().rowwise() / deviation.array().max(1e-12)).rowwise().maxCoeff();
  std::vector<FailureCell> list;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    double squares = 0;
    for (const auto& [run, f] : cells[c].features) squares += std::pow(residuals[run][f], 2);
    FailureCell cell{cells[c].run,
                     cells[c].observable,
                     cells[c].what,
                     cells[c].from,
                     cells[c].to,
                     std::sqrt(squares / static_cast<double>(cells[c].features.size())),
                     (sums[i] - mean[i]) / std::max(1e-12, deviation[i]),
                     1};
    if (!std::isfinite(cell.sigmas)) continue;  // tells nothing of a place; p of the whole does
    cell.p_value = static_cast<double>(1 + (worst.array() >= cell.sigmas).count()) /
                   static_cast<double>(1 + pseudo.rows());
    list.push_back(std::move(cell));
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const FailureCell& a, const FailureCell& b) { return a.sigmas > b.sigmas; });
  return list;
}

}  // namespace shakedown
