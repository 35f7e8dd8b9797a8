// SPDX-License-Identifier: MIT
// Setups for LAMMPS, and a way out where there is none.
#pragma once
#include "engines/setups.hpp"
#include "lammps_engine.hpp"

namespace shakedown {

/// Tests of this kind are left out where there is no LAMMPS.
class WithLammps : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_lammps()) GTEST_SKIP() << "there is no program lmp";
  }
  const std::unique_ptr<Engine> lammps = make_lammps_engine(), soft = make_soft_engine();
};
using SlowWithLammps = WithLammps;

/// A wide box at rest on a spring so weak that it does nothing during an impact.
inline Setup resting_box() {
  Setup setup;
  setup.release.displacement = 0;
  setup.spring.frequency = 1e-6;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.1;
  return setup;
}

/// Without grains, `seconds` long.
inline Setup empty_box(double seconds) {
  Setup setup;
  setup.grains.count = 0;
  setup.run.duration = seconds;
  setup.run.sample_rate = 100;
  return setup;
}

/// Largest difference of the box's places, m.
inline double largest_difference(const Trajectory& one, const Trajectory& other) {
  EXPECT_EQ(one.x_box.size(), other.x_box.size());
  double most = 0;
  for (std::size_t k = 0; k < std::min(one.x_box.size(), other.x_box.size()); ++k)
    most = std::max(most, std::abs(one.x_box[k] - other.x_box[k]));
  return most;
}

}  // namespace shakedown
