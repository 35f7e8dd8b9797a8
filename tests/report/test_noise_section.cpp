// SPDX-License-Identifier: MIT
// The spectrum of a track on a page: noise of a known density beside a swing, and the figures of a run.
#include "noise_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "random.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double interval = 1.0 / 240;

/// A swing of 100 mm with first-order noise of 0.1 mm and this memory, 20 s.
std::vector<double> track(double memory) {
  Random random(11, 0, Stream::camera);
  std::vector<double> x;
  double noise = 1e-4 * random.normal();
  for (int i = 0; i < 4800; ++i) {
    x.push_back(0.1 * std::cos(2 * std::numbers::pi * 1.26 * i * interval) + noise);
    noise = memory * noise + 1e-4 * std::sqrt(1 - memory * memory) * random.normal();
  }
  return x;
}

/// rms of density over that of the noise as it was made, from so many Hz on.
double above(double from, const std::vector<double>& x, double memory) {
  NoiseFound made;
  made.standard_deviation = 1e-4;
  made.correlation[0] = memory;
  const TrackSpectrum spectrum = spectrum_of_track(x, interval);
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < spectrum.frequency.size(); ++k)
    if (spectrum.frequency[k] > from)
      sum += std::pow(spectrum.density[k] / density_of(made, interval, spectrum.frequency[k]), 2), ++count;
  return std::sqrt(sum / count);
}

}  // namespace

TEST(NoiseSection, ASpectrumComesDownToTheNoiseWhateverItsColour) {
  for (const double memory : {0.0, 0.5}) {
    const double ratio = above(6, track(memory), memory);
    RecordProperty("ratio_of_memory_" + std::to_string(memory), std::to_string(ratio));
    WITHIN(ratio, 1, 0.04, 0.01);  // standard error of 4600 numbers
  }
  const TrackSpectrum spectrum = spectrum_of_track(track(0), interval);
  WITHIN(spectrum.frequency.back(), 120, 5e-13, 2.7e-14);
  // At the swing it is the swing's: a hundred times the noise and more.
  NoiseFound white;
  white.standard_deviation = 1e-4;
  EXPECT_GT(spectrum.density[2] / density_of(white, interval, 1.26), 100);
}

TEST(NoiseSection, GapsAreBridgedAndShortTracksHaveNone) {
  std::vector<double> x = track(0);
  for (std::size_t i = 0; i < x.size(); i += 50) x[i] = std::nan("");
  const double ratio = above(20, x, 0);
  RecordProperty("ratio", std::to_string(ratio));
  WITHIN(ratio, 1, 0.1, 6.3e-3);  // 0.994 seen: a frame in fifty lies on a line
  EXPECT_TRUE(spectrum_of_track(std::vector<double>(63, 0.0), interval).frequency.empty());
  EXPECT_TRUE(spectrum_of_track(std::vector<double>(500, std::nan("")), interval).frequency.empty());
}

TEST(NoiseSection, EachRunHasItsNoiseAgainstTimeAndItsSpectrum) {
  Measurement measurement;
  Measurement::Run& run = measurement.runs.emplace_back();
  run.audit.run = "a", run.audit.frame_interval = interval, run.audit.x_box = track(0);
  run.audit.box.standard_deviation = 1e-4;
  run.audit.box.over_time = {{0, 10, 0.9e-4}, {10, 20, 1.1e-4}};
  const ReportSection section = noise_section(measurement);
  ASSERT_EQ(section.plots.size(), 2u);  // the grains were not followed
  EXPECT_EQ(section.plots[0].y_label, "noise of a frame, mm");
  EXPECT_DOUBLE_EQ(section.plots[0].curves[0].y.front(), 0.09);
  EXPECT_DOUBLE_EQ(section.plots[0].curves[0].y.back(), 0.11);
  EXPECT_EQ(section.plots[1].curves.size(), 2u);
  EXPECT_TRUE(section.plots[1].logarithmic_y);
  ASSERT_EQ(section.tables[0].rows.size(), 1u);
}
