// SPDX-License-Identifier: MIT
// Observables of trajectories that other codes computed (tests/data/README.md) against what was read off them
// elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "observables.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

Trajectory read_reference(const std::string& name) {
  std::ifstream file(std::string(TEST_DATA) + "/" + name);
  EXPECT_TRUE(file) << name;
  Trajectory trajectory;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::array<double, 3> value{};
    char comma = 0;
    cells >> value[0] >> comma >> value[1] >> comma >> value[2];
    trajectory.time.push_back(value[0]);
    trajectory.x_box.push_back(value[1]);
    trajectory.x_com.push_back(value[2]);
  }
  return trajectory;
}

struct Expected {
  const char* file;
  std::vector<double> peaks_mm;  ///< of this run, read off its 500 samples a second without interpolation
  double frequency;              ///< Hz, likewise
  std::vector<double> mean_mm;   ///< of three seeds
  Tolerance within_mm;           ///< twice half their range, and 0.5 mm
};

}  // namespace

TEST(OtherCodes, DynamoPeaksAndFrequencies) {
  const std::vector<Expected> cases{{"dynamo_damper_L40_50hz.csv",
                                     {103.0, 99.2, 95.3, 91.3, 87.4, 83.7, 79.8, 75.7},
                                     1.047855,
                                     {103.0, 99.1, 95.3, 91.4, 87.4, 83.6, 79.7, 75.8},
                                     {0.7, 0.14}},
                                    {"dynamo_damper_L65_50hz.csv",
                                     {98.3, 89.6, 80.7, 72.1, 63.3, 54.5, 47.3, 40.2},
                                     1.035295,
                                     {98.5, 90.0, 81.2, 72.5, 63.9, 55.4, 47.5, 40.6},
                                     {2.7, 0.92}},
                                    {"dynamo_damper_L85_50hz.csv",
                                     {93.7, 81.6, 69.4, 58.4, 48.8, 39.2, 28.5, 19.0},
                                     1.037186,
                                     {93.8, 81.2, 69.6, 59.0, 48.8, 39.1, 28.8, 19.1},
                                     {1.7, 0.6}},
                                    {"dynamo_damper_L104_50hz.csv",
                                     {91.3, 77.2, 63.8, 50.6, 36.1, 24.8, 12.3, 6.1},
                                     1.093765,
                                     {91.0, 77.5, 63.4, 49.9, 36.5, 23.9, 12.4, 6.6},
                                     {3.7, 0.9}},
                                    {"dynamo_damper_L311_50hz.csv",
                                     {91.3, 34.1, 12.7, 11.8, 11.5, 10.2, 9.8, 9.0},
                                     1.205836,
                                     {91.0, 32.9},
                                     {3.0, 1.2}}};
  for (const Expected& expected : cases) {
    const Observables seen = observe(read_reference(expected.file), shakedown::Setup{});
    ASSERT_GE(seen.peaks.size(), expected.peaks_mm.size()) << expected.file;
    for (std::size_t n = 0; n < expected.peaks_mm.size(); ++n) {
      const double peak = 1e3 * std::abs(seen.peaks[n].position);
      WITHIN(peak, expected.peaks_mm[n], 0.15, 0.084)
          << expected.file << " n = " << n + 1;  // mm; ten times fewer samples
      if (n < expected.mean_mm.size()) {
        WITHIN(peak, expected.mean_mm[n], expected.within_mm) << expected.file;
      }
    }
    WITHIN(seen.frequency, expected.frequency, 2e-4, 2.6e-5) << expected.file;  // Hz
  }
}

TEST(OtherCodes, LammpsSlopeAndFrequency) {
  const Observables seen = observe(read_reference("lammps_damper_L40_50hz.csv"), shakedown::Setup{});
  WITHIN(1e3 * seen.slope, -8.2502, 0.01, 1.1e-3);                     // mm/s
  WITHIN(seen.frequency, 1.047841, 2e-5, 1.7e-6);                      // Hz
  WITHIN(seen.first_small_peak, 12.93, 0.1, 0.014);                    // s
  EXPECT_LT(seen.decay.linear.rms, 0.2 * seen.decay.exponential.rms);  // the paper's finding
}
