// SPDX-License-Identifier: MIT
// Into which parts of an experiment features fall, on a swing whose height and phase are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "failure_cells.hpp"

using namespace shakedown;

namespace {

constexpr double frequency = 1.17, decay = 3;  // Hz, s
double height(double time) { return 0.1 * std::exp(-time / decay); }

/// A box that swings and dies away, a feature every 0.1 s for 9 s.
MeasuredFeatures dying_swing() {
  MeasuredFeatures m;
  m.run = "one";
  m.setup.spring.frequency = frequency;
  m.plan.end = 9;
  m.values = Eigen::VectorXd(90);
  for (int i = 0; i < 90; ++i) {
    const double time = 0.05 + 0.1 * i;
    Feature feature;
    feature.observable = Observable::box;
    feature.time = time;
    m.plan.features.push_back(feature);
    m.values[i] = height(time) * std::cos(2 * std::numbers::pi * frequency * time);
  }
  return m;
}

const Cell& cell_of(const std::vector<Cell>& cells, const std::string& what) {
  for (const Cell& cell : cells)
    if (cell.what == what) return cell;
  ADD_FAILURE() << what;
  return cells.front();
}

TEST(FailureCells, AmplitudesAreThoseOfTheSwingAboutEachFeature) {
  const MeasuredFeatures m = dying_swing();
  const std::vector<Cell> cells = cells_of({m});
  // The largest within half a period: the swing's height up to half a period before, less what a turning
  // point between two features hides.
  const double earlier = std::exp(0.55 / frequency / decay),
               hidden = std::cos(0.05 * 2 * std::numbers::pi * frequency);
  const auto expect_heights = [&](const std::string& what, double from, double to) {
    for (const auto& [run, place] : cell_of(cells, what).features) {
      const double share =
          height(m.plan.features[static_cast<std::size_t>(place)].time) / m.values.cwiseAbs().maxCoeff();
      EXPECT_GT(share * earlier, from) << what;
      EXPECT_LT(share * hidden / earlier, to) << what;
    }
  };
  expect_heights("amplitude above 60 % of the largest", 0.6, 2);
  expect_heights("amplitude 30 to 60 % of the largest", 0.3, 0.6);
  expect_heights("amplitude 10 to 30 % of the largest", 0.1, 0.3);
  expect_heights("amplitude below 10 % of the largest", 0, 0.1);
}

TEST(FailureCells, ThePhaseIsThatOfTheSwing) {
  const MeasuredFeatures m = dying_swing();
  const std::vector<Cell> cells = cells_of({m});
  const auto phase_at = [&](Eigen::Index place) {
    return std::remainder(m.plan.features[static_cast<std::size_t>(place)].time * frequency, 1.0);
  };
  // Features 0.1 s apart follow the swing by straight lines, which moves a phase by up to half an octant.
  for (const auto& [run, place] : cell_of(cells, "phase: turning point on the release side").features)
    EXPECT_LT(std::abs(phase_at(place)), 1.5 / 8);
  for (const auto& [run, place] : cell_of(cells, "phase: mid-stroke inwards").features)
    EXPECT_LT(std::abs(phase_at(place) - 0.25), 1.5 / 8);
  for (const auto& [run, place] : cell_of(cells, "phase: mid-stroke outwards").features)
    EXPECT_LT(std::abs(phase_at(place) + 0.25), 1.5 / 8);
}

TEST(FailureCells, ARunIsCutIntoStretchesOfTwoSeconds) {
  const MeasuredFeatures m = dying_swing();
  std::vector<double> from;
  for (const Cell& cell : cells_of({m})) {
    if (cell.what != "time") continue;
    from.push_back(cell.from);
    EXPECT_EQ(cell.to, cell.from + 2);
    for (const auto& [run, place] : cell.features) {
      const double time = m.plan.features[static_cast<std::size_t>(place)].time;
      EXPECT_GE(time, cell.from);
      EXPECT_LT(time, cell.to);
    }
  }
  EXPECT_EQ(from, (std::vector<double>{0, 2, 4, 6, 8}));
}

}  // namespace
