// SPDX-License-Identifier: MIT
// A driven box of a laboratory that shares no code with the program: free decay, width and phase of its
// resonance tell one damping.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

#include "diagnosis.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "experiment_file.hpp"
#include "measurements.hpp"
#include "momentum.hpp"
#include "random.hpp"
#include "scratch_folder.hpp"
#include "setup_file.hpp"
#include "swing_judged.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double mass = 0.4, frequency = 1.3, damping = 0.3, base = 2e-3, rate = 50;  // kg, Hz, N s/m, m, Hz
/// Forced at each of these shares of its frequency for so many periods, then left alone.
constexpr double shares[] = {0.94, 0.98, 1.0, 1.02, 1.06};
constexpr int forced_periods = 14, free_periods = 10;

struct Record {
  std::vector<double> time, box, base;
};

/// By leapfrog in steps of 0.1 ms from rest, with 0.05 mm of noise; the base is what a drive wrote down.
Record recorded() {
  Record record;
  Random random(11, 0, Stream::camera);
  const double stiffness = mass * std::pow(two_pi * frequency, 2);
  std::vector<double> begin{0};
  for (const double share : shares) begin.push_back(begin.back() + forced_periods / (share * frequency));
  const auto base_at = [&](double t) {
    for (std::size_t i = 0; i < std::size(shares); ++i)
      if (t >= begin[i] && t < begin[i + 1])
        return base * std::sin(two_pi * shares[i] * frequency * (t - begin[i]));
    return 0.0;
  };
  const double end = begin.back() + free_periods / frequency;
  constexpr int steps = 200;
  constexpr double step = 1 / (rate * steps);
  double x = 0, v = 0;
  for (int frame = 0; frame / rate < end; ++frame) {
    record.time.push_back(frame / rate);
    record.box.push_back(x + 5e-5 * random.normal());
    record.base.push_back(base_at(frame / rate));
    for (int i = 0; i < steps; ++i) {
      const double t = frame / rate + (i + 0.5) * step;
      x += v * step / 2;
      v += (-stiffness * (x - base_at(t)) - damping * v) / mass * step;
      x += v * step / 2;
    }
  }
  return record;
}

/// Frames from `from` to `to`, s, as a table and an experiment file.
Measurement measured(const Record& record, double from, double to, const shakedown::Setup& setup) {
  const ScratchFolder folder;
  std::ofstream table(folder / "driven.csv");
  table.precision(9);
  table << "t_s,box_mm,drive_rad\n";
  for (std::size_t i = 0; i < record.time.size(); ++i)
    if (record.time[i] >= from && record.time[i] < to)
      table << record.time[i] << "," << 1e3 * record.box[i] << "," << record.base[i] / 0.05 << "\n";
  table.close();
  const std::string text =
      "[column.time]\nfrom = \"t_s\"\nunit = \"s\"\n[column.box_position]\nfrom = \"box_mm\"\nunit = "
      "\"mm\"\n[column.base_position]\nfrom = \"drive_rad\"\nunit = \"rad\"\nper_radian = \"50 mm\"\n"
      "[[run]]\nfile = \"driven.csv\"\n";
  return measurement_of(setup, parse_experiment(text, "driven.toml", folder.path(), all_effects()),
                        all_effects());
}

shakedown::Setup believed() {
  shakedown::Setup setup;
  setup.box.mass = mass;
  setup.grains.count = 0;
  setup.spring.frequency = 1.02 * frequency;
  return setup;
}

/// Of the damping, from the frames between two moments.
FittedValue damping_from(const Record& record, double from, double to) {
  const Measurement measurement = measured(record, from, to, believed());
  const MomentumAudit unasked;
  const std::optional<JudgedSwing> judged =
      judged_swing(believed(), measurement,
                   {Knob{"spring.frequency", believed().spring.frequency, 0.05, 1, 2},
                    Knob{"blade_viscous_damping.damping", 0, 0.05, 0, 2}},
                   unasked, all_effects());
  EXPECT_TRUE(judged && judged->judgement.holds());
  return judged ? judged->refit.values[1] : FittedValue{};
}

/// Amplitude over the base's, and lag behind it, rad, at the end of the forced stretch `i`.
std::pair<double, double> response_of(const Record& record, std::size_t i) {
  double end = 0;
  for (std::size_t k = 0; k <= i; ++k) end += forced_periods / (shares[k] * frequency);
  const double omega = two_pi * shares[i] * frequency, begin = end - forced_periods / (shares[i] * frequency);
  const double from = end - 3 / (shares[i] * frequency);  // whole periods: sine and cosine are orthogonal
  double in_phase = 0, behind = 0, count = 0;
  for (std::size_t f = 0; f < record.time.size(); ++f)
    if (record.time[f] >= from && record.time[f] < end) {
      in_phase += record.box[f] * std::sin(omega * (record.time[f] - begin));
      behind -= record.box[f] * std::cos(omega * (record.time[f] - begin));
      ++count;
    }
  return {2 * std::hypot(in_phase, behind) / count / base, std::atan2(behind, in_phase)};
}

TEST(SlowDrivenBox, FreeDecayAndResonanceTellOneDamping) {
  const Record record = recorded();
  const double whole = record.time.back() + 1, released = record.time.back() - free_periods / frequency;
  const FittedValue free = damping_from(record, released, whole), forced = damping_from(record, 0, released),
                    both = damping_from(record, 0, whole);
  WITHIN_ERRORS(free.value, damping, 3.5, free.error, 3.9e-4);
  WITHIN_ERRORS(forced.value, damping, 3.5, forced.error, 2.7e-5);
  WITHIN_ERRORS(both.value, damping, 3.5, both.error, 2.7e-5);
  WITHIN_ERRORS(free.value, forced.value, 3.5, std::hypot(free.error, forced.error), 3.9e-4);
  EXPECT_LT(both.error, free.error);
}

// What is read off the steady state by hand: width by the amplitudes, and the phase. The transient that is
// left after eleven periods is exp(-0.75 * 11 / 1.3 / 2) = 4 % of the amplitude.
TEST(DrivenBox, WidthAndPhaseByHandAgreeWithTheWaveform) {
  const Record record = recorded();
  const FittedValue both = damping_from(record, 0, record.time.back() + 1);
  const double own = two_pi * frequency;
  for (std::size_t i = 0; i < std::size(shares); ++i) {
    const double omega = shares[i] * own, detuning = own * own - omega * omega;
    const auto [ratio, lag] = response_of(record, i);
    const double by_width = std::sqrt(std::pow(own * own / ratio, 2) - detuning * detuning) / omega * mass;
    WITHIN(by_width / both.value, 1, 0.1, 0.072) << shares[i];
    if (shares[i] == 1) continue;
    WITHIN(std::tan(lag) * detuning / omega * mass / both.value, 1, 0.2, 0.054) << shares[i];
  }
}

TEST(SlowDrivenBox, ADiagnosisNamesItsDampingAndNothingElse) {
  const Record record = recorded();
  DiagnoseOptions options;
  options.known = all_effects();
  const Measurement measurement = measured(record, 0, record.time.back() + 1, believed());
  const Diagnosis d = diagnose(believed(), measurement, *engine_named("hard"), options);
  EXPECT_EQ(d.missing, std::vector<std::string>{"blade_viscous_damping"}) << d.sentence;
  EXPECT_TRUE(d.judgement.holds()) << d.judgement.reason;
}

TEST(SlowDrivenBox, ADiagnosisSetsTheSteadyStateBesideItsModel) {
  shakedown::Setup given = believed();
  given.run.duration = 20;
  set_number(given, "oscillating_acceleration.amplitude.x", 0.3, all_effects());
  set_number(given, "oscillating_acceleration.frequency", 1.1, all_effects());
  shakedown::Setup truth = given;
  set_number(truth, "blade_viscous_damping.damping", damping, all_effects());
  const auto engine = engine_named("hard");
  const Experiment experiment = make_measurements(truth, {{"forced", {}}}, {.box_noise = 1e-4},
                                                  {engine.get(), all_effects(), 3, 1, nullptr});
  DiagnoseOptions options;
  options.known = all_effects();
  const Diagnosis d = diagnose(given, measurement_of(given, experiment, all_effects()), *engine, options);
  EXPECT_EQ(d.missing, std::vector<std::string>{"blade_viscous_damping"}) << d.sentence;
  ASSERT_EQ(d.forced.size(), 1u);
  const ForcedComparison& seen = *d.forced[0].forced;
  WITHIN(seen.amplitude.model / seen.amplitude.measured, 1, 0.02, 8.8e-3);
  WITHIN(seen.phase_lag.model, seen.phase_lag.measured, 5e-3, 2.7e-4);
  EXPECT_NE(diagnosis_text(d).find("forced: measured (final model"), std::string::npos);
  EXPECT_NE(diagnosis_json(d).find("phase_lag_rad"), std::string::npos);
}

}  // namespace
