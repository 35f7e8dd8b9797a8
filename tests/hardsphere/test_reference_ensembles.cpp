// SPDX-License-Identifier: MIT
// Ensembles of the paper's damper against the means that six independent codes agree on (an event-driven
// reference with a ledger error of 5e-15; the paper's own engine, LAMMPS, LIGGGHTS, Yade and a Bullet-based
// code beside it): 16 runs of 30 s each.
#include <gtest/gtest.h>

#include <cstdio>

#include "ensemble.hpp"
#include "observables.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

struct Reference {
  double length_mm;
  std::vector<double> peaks_mm;                    ///< |peak|, n = 1, 2, ...
  double slope, frequency, small_peak, energy_95;  ///< mm/s, Hz, s, s
  std::array<double, contact_classes> shares;      ///< of E0: grain-grain, end wall, side wall
  // What the mean of 16 runs may be off.
  double first_peak_off, peak_off, slope_off, frequency_off, energy_95_off;
};

const std::array<Reference, 5> references{{
    {40,
     {104.0, 100.1, 96.1, 92.2, 88.2, 84.3, 80.4, 76.4},
     -8.20,
     1.0478,
     12.93,
     10.56,
     {.545, .335, .120},
     0.5,
     0.5,
     0.1,
     .001,
     0.1},
    {65,
     {99.6, 91.4, 82.6, 74.0, 65.3, 56.8, 48.7, 41.4},
     -16.2,
     1.0363,
     6.30,
     5.32,
     {.568, .293, .140},
     1,
     1,
     0.3,
     .002,
     0.1},
    {85,
     {94.6, 83.8, 71.3, 60.9, 50.8, 40.7, 30.6, 20.6},
     -21.6,
     1.038,
     4.76,
     3.93,
     {.573, .275, .151},
     1,
     1,
     0.4,
     .006,
     0.1},
    {104,
     {92.4, 80.0, 66.3, 52.8, 39.8, 26.4, 14.8, 7.8},
     -27.0,
     1.088,
     3.77,
     3.08,
     {.572, .267, .161},
     1,
     1,
     0.6,
     .01,
     0.1},
    // Its decay has no slope, and its tail is statistics only: a first small peak after 5.6 +- 2.2 s.
    {311, {92.4, 29.6, 15.0, 14.3}, absent, 1.192, 5.6, 1.47, {.485, .283, .228}, 1, 3, absent, .02, 0.2},
}};

class SlowHardDamper : public ::testing::TestWithParam<Reference> {};

void compare(const char* what, const MeanOfRuns& seen, double expected, double off) {
  if (std::isnan(expected)) return;
  std::printf("  %-22s %9.4f +- %7.4f (sd %.4f), reference %9.4f\n", what, seen.mean(), seen.error(),
              seen.deviation(), expected);
  if (std::isnan(off)) return;
  // not WITHIN: what the six codes differ by, in the table
  EXPECT_NEAR(seen.mean(), expected, off) << what;
}

TEST_P(SlowHardDamper, AgreesWithSixCodes) {
  const Reference& reference = GetParam();
  shakedown::Setup setup;
  setup.box.length = reference.length_mm * 1e-3;
  setup.run.duration = 30;
  std::vector<MeanOfRuns> peaks(reference.peaks_mm.size());
  MeanOfRuns slope, frequency, small_peak, energy_95;
  std::array<MeanOfRuns, contact_classes> shares;
  for (const Trajectory& run : hard_ensemble(setup, 16)) {
    EXPECT_LE(run.health.ledger_error, 1e-12);
    EXPECT_LE(run.health.deepest_overlap, 1e-12);  // metre
    EXPECT_LE(run.health.momentum_error, 1e-12);
    const Observables seen = observe(run, setup);
    ASSERT_GE(seen.peaks.size(), peaks.size());
    for (std::size_t n = 0; n < peaks.size(); ++n) peaks[n].add(std::abs(seen.peaks[n].position) * 1e3);
    slope.add(seen.slope * 1e3);
    frequency.add(seen.frequency);
    if (!std::isnan(seen.first_small_peak)) small_peak.add(seen.first_small_peak);
    energy_95.add(seen.seconds_to_energy_fraction[3]);
    for (std::size_t c = 0; c < shares.size(); ++c) shares[c].add(seen.energy_loss[c]);
  }
  std::printf("L = %.0f mm\n", reference.length_mm);
  for (std::size_t n = 0; n < peaks.size(); ++n)
    compare(("peak " + std::to_string(n + 1) + ", mm").c_str(), peaks[n], reference.peaks_mm[n],
            n == 0 ? reference.first_peak_off : reference.peak_off);
  compare("slope, mm/s", slope, reference.slope, reference.slope_off);
  compare("frequency, Hz", frequency, reference.frequency, reference.frequency_off);
  compare("first small peak, s", small_peak, reference.small_peak, absent);
  compare("95 % of energy, s", energy_95, reference.energy_95, reference.energy_95_off);
  for (std::size_t c = 0; c < shares.size(); ++c)
    compare(contact_class_names[c], shares[c], reference.shares[c], .012);
}

INSTANTIATE_TEST_SUITE_P(Lengths, SlowHardDamper, ::testing::ValuesIn(references), [](const auto& tested) {
  return "L" + std::to_string(static_cast<int>(tested.param.length_mm));
});

}  // namespace
