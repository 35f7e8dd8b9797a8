// SPDX-License-Identifier: MIT
// Against LAMMPS (granular pair style, box coupled to the wall force), same first state, contact time 0.3 ms.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <tuple>

#include "observables.hpp"
#include "soft_engine.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

struct Sample {
  double time, x_box, x_com;
};

std::vector<Sample> read_samples(const std::string& file) {
  std::ifstream input(file);
  std::vector<Sample> samples;
  for (std::string line; std::getline(input, line);) {
    Sample sample{};
    char comma;
    if (std::istringstream(line) >> sample.time >> comma >> sample.x_box >> comma >> sample.x_com)
      samples.push_back(sample);
  }
  return samples;
}

shakedown::Setup setup_of_reference(int length_mm, double duration) {
  shakedown::Setup setup;
  setup.box.length = length_mm * 1e-3;
  setup.release.initial_grains =
      std::string(TEST_DATA) + "/init_damper_L" + std::to_string(length_mm) + ".csv";
  setup.soft.contact_time = 3e-4;
  setup.run.duration = duration;
  return setup;
}

double largest_difference(const Trajectory& run, const std::vector<Sample>& samples, double until) {
  double largest = 0;
  for (const Sample& sample : samples) {
    if (sample.time > until + 1e-9) break;
    const auto k = static_cast<std::size_t>(std::lround(sample.time * 500));
    WITHIN(run.time[k], sample.time, 9e-16, 4.5e-17);
    largest = std::max(largest, std::abs(run.x_box[k] - sample.x_box));
  }
  return largest;
}

}  // namespace

TEST(ReferenceRuns, FollowLammpsUntilChaosSetsIn) {
  const auto samples = read_samples(std::string(TEST_DATA) + "/lammps_damper_L40_tc3e-4_start.csv");
  ASSERT_GT(samples.size(), 100u);
  for (const double steps : {20.0, 50.0}) {
    shakedown::Setup setup = setup_of_reference(40, 0.25);
    setup.soft.steps_per_contact = steps;
    const Trajectory run = make_soft_engine()->run(setup);
    // metre; LAMMPS's own first-order restitution error
    EXPECT_LE(largest_difference(run, samples, 0.05), 2e-6);
    EXPECT_LE(largest_difference(run, samples, 0.2), 5e-5);
  }
}

TEST(SlowReferenceRuns, StayWithLammpsForTenSeconds) {
  const auto samples = read_samples(std::string(TEST_DATA) + "/lammps_damper_L40_tc3e-4_10s.csv");
  ASSERT_GT(samples.size(), 200u);
  const Trajectory run = make_soft_engine()->run(setup_of_reference(40, 10));
  double squares = 0;
  for (const Sample& sample : samples) {
    const auto k = static_cast<std::size_t>(std::lround(sample.time * 500));
    squares += (run.x_box[k] - sample.x_box) * (run.x_box[k] - sample.x_box);
  }
  EXPECT_LE(std::sqrt(squares / static_cast<double>(samples.size())), 1e-3);
}

TEST(SlowReferenceRuns, ApproachTheHardLimitAsContactsGetShorter) {
  // Slope of the peaks in mm/s from earlier measurements (8 seeds, +- 0.014); ours must agree within the
  // scatter of both.
  constexpr int runs = 8;
  for (const auto& [contact_time, steps, wanted] :
       {std::tuple{1e-3, 50.0, -8.055}, {3e-4, 50.0, -8.14}, {1e-4, 20.0, -8.16}}) {
    shakedown::Setup setup;
    setup.release.packing = Packing::square;
    setup.run.duration = 8.2;
    setup.soft.contact_time = contact_time;
    setup.soft.steps_per_contact = steps;
    double mean = 0;
    for (int run = 0; run < runs; ++run) {
      RunOptions options;
      options.run = run;
      mean += observe(make_soft_engine()->run(setup, options), setup).slope * 1e3 / runs;
    }
    RecordProperty("slope_at_contact_time_" + std::to_string(contact_time), std::to_string(mean));
    WITHIN(mean, wanted, 0.06, 0.019) << contact_time;  // 2.5 standard errors of the difference
  }
}
