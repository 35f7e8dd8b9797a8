// SPDX-License-Identifier: MIT
// From the same grains as LAMMPS, LIGGGHTS and Yade, whose contacts last 3e-4 s.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "hard_engine.hpp"

using namespace shakedown;

namespace {

struct Sample {
  double time, x_box;
};

std::vector<Sample> samples_of(const std::string& file) {
  std::ifstream input(std::string(TEST_DATA) + "/" + file);
  std::vector<Sample> samples;
  for (std::string line; std::getline(input, line);) {
    Sample sample{};
    char comma;
    if (std::istringstream(line) >> sample.time >> comma >> sample.x_box) samples.push_back(sample);
  }
  return samples;
}

Trajectory hard_run(double duration) {
  shakedown::Setup setup;
  setup.release.initial_grains = std::string(TEST_DATA) + "/init_damper_L40.csv";
  setup.run.duration = duration;
  return make_hard_engine()->run(setup);
}

double difference(const Trajectory& run, const Sample& sample) {
  const auto k = static_cast<std::size_t>(std::lround(sample.time * 500));
  EXPECT_NEAR(run.time.at(k), sample.time, 1e-9);
  return std::abs(run.x_box[k] - sample.x_box);
}

TEST(HardAgainstOtherCodes, FollowsLammpsUntilChaosSetsIn) {
  const auto samples = samples_of("lammps_damper_L40_tc3e-4_start.csv");
  ASSERT_GT(samples.size(), 100u);
  const Trajectory run = hard_run(0.25);
  double largest = 0;
  for (const Sample& sample : samples)
    if (sample.time < 0.2001) largest = std::max(largest, difference(run, sample));
  std::printf("largest difference from LAMMPS in 0.2 s: %.1f um\n", largest * 1e6);
  EXPECT_LE(largest, 1e-4);  // metre
}

TEST(HardAgainstOtherCodes, StaysWithThemForTenSeconds) {
  const Trajectory run = hard_run(10);
  for (const std::string code : {"lammps", "liggghts", "yade"}) {
    const auto samples = samples_of(code + "_damper_L40_tc3e-4_10s.csv");
    ASSERT_EQ(samples.size(), 501u);
    double squares = 0;
    for (const Sample& sample : samples) squares += std::pow(difference(run, sample), 2);
    const double rms = std::sqrt(squares / static_cast<double>(samples.size()));
    std::printf("rms difference from %s over 10 s: %.3f mm\n", code.c_str(), rms * 1e3);
    EXPECT_LE(rms, 1e-3) << code;  // metre; the spread of one run is half of it
  }
}

}  // namespace
