// SPDX-License-Identifier: MIT
// Records of velocity and acceleration against the position in closed form.
#include "integrated_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "errors.hpp"
#include "experiment_file.hpp"
#include "scratch_folder.hpp"

using namespace shakedown;

namespace {

constexpr double amplitude = 0.1, frequency = 1.3, rate = 0.08;  // m, Hz, 1/s

/// The n-th derivative of A exp(-g t) cos(w t).
double swing(double t, int derivative) {
  const std::complex<double> s(-rate, 2 * std::numbers::pi * frequency);
  return amplitude * (std::pow(s, derivative) * std::exp(s * t)).real();
}

/// `offset`: the sensor's zero, which drifts by half of it.
TimeSeries sensed(int derivative, double offset, bool uneven) {
  TimeSeries series;
  for (int i = 0; i < 4000; ++i) {
    const double t = 5e-3 * (i + (uneven ? 0.4 * std::sin(12.0 * i) : 0));
    series.time.push_back(t);
    series.value.push_back(swing(t, derivative) + offset * (1 + t / 40));
  }
  return series;
}

/// Of the amplitude; where the middle lies, nobody knows.
double farthest(const TimeSeries& place) {
  EXPECT_EQ(place.why_not, "");
  EXPECT_GT(place.time.size(), 3000u);
  double off = 0, most = 0;
  for (std::size_t i = 0; i < place.time.size(); ++i) off += place.value[i] - swing(place.time[i], 0);
  off /= static_cast<double>(place.time.size());
  for (std::size_t i = 0; i < place.time.size(); ++i)
    most = std::max(most, std::abs(place.value[i] - off - swing(place.time[i], 0)));
  return most / amplitude;
}

}  // namespace

// The swing loses (g / f / 2 pi)^2 = 1e-4 of itself; trapezoids over 1/154 of a period err by (2 pi/154)^2/12
// = 1.4e-4.
TEST(IntegratedMotion, IsThePositionOfADecayingSwingWhateverTheSensorsZero) {
  for (const bool uneven : {false, true}) {
    const double plain = farthest(integral_of_swing(sensed(1, 0, uneven))),
                 drifting = farthest(integral_of_swing(sensed(1, 0.3, uneven)));
    EXPECT_LT(plain, 5e-4) << "seen 5e-5";
    EXPECT_LT(drifting, 5e-4) << "seen 7e-5";
  }
  EXPECT_LT(farthest(integral_of_swing(integral_of_swing(sensed(2, 1, false)))), 2e-3);
}

TEST(IntegratedMotion, StepsOverWhatIsNoNumber) {
  TimeSeries series = sensed(1, 0, false);
  for (std::size_t i = 100; i < series.value.size(); i += 37) series.value[i] = std::nan("");
  EXPECT_LT(farthest(integral_of_swing(series)), 1e-3);
}

TEST(IntegratedMotion, OfAFewSwingsIsRefused) {
  TimeSeries series = sensed(1, 0, false);
  series.time.resize(600), series.value.resize(600);  // four
  EXPECT_NE(integral_of_swing(series).why_not, "");
  EXPECT_NE(integral_of_swing({{0, 1, 2, 3}, {1, 1, 1, 1}}).why_not, "");
  EXPECT_NE(integral_of_swing({}).why_not, "");
}

TEST(IntegratedMotion, AGyrosColumnIsReadWithItsUnits) {
  const ScratchFolder scratch;
  const std::filesystem::path& folder = scratch.path();
  std::string table = "t,w\n";
  const TimeSeries series = sensed(1, 0.02, false);
  constexpr double arm = 0.4;
  for (std::size_t i = 0; i < series.time.size(); ++i)
    table += std::to_string(series.time[i]) + "," +
             std::to_string(series.value[i] / arm * 180 / std::numbers::pi) + "\n";
  std::ofstream(folder / "gyro.csv") << table;
  const std::string begin =
                        "[column.time]\nfrom = \"t\"\nunit = \"s\"\n[column.box_velocity]\nfrom = \"w\"\n",
                    end = "[[run]]\nfile = \"gyro.csv\"\n";
  const Experiment read =
      parse_experiment(begin + "unit = \"deg/s\"\nper_radian = \"400 mm\"\n" + end, "gyro.toml", folder);
  const MeasuredRun& run = read.runs.at(0);
  EXPECT_LT(farthest({run.time, run.x_box}), 1.5e-3);
  for (const auto& [unit, said] :
       {std::pair{"deg/s", "per_radian"}, {"mm", "use m/s"}, {"m/s^2", "use m/s"}}) {
    try {
      parse_experiment(begin + "unit = \"" + unit + "\"\n" + end, "gyro.toml", folder);
      ADD_FAILURE() << unit;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(parse_experiment(begin + "unit = \"m/s\"\norigin = \"1 mm\"\n" + end, "gyro.toml", folder),
               InputError);
}
