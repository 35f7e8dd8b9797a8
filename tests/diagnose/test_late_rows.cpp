// SPDX-License-Identifier: MIT
// A rolling shutter whose frames have the time of their first row sees all runs late by half of its time.
#include <gtest/gtest.h>

#include <algorithm>

#include "camera_features.hpp"
#include "diagnosis.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "engines.hpp"
#include "hidden_measurements.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr const char* clock_key = "camera_time_offset.offset";

const Knob* clock_of(const std::vector<Knob>& knobs) {
  const auto found =
      std::find_if(knobs.begin(), knobs.end(), [](const Knob& knob) { return knob.key == clock_key; });
  return found == knobs.end() ? nullptr : &*found;
}

Measurement filmed(const std::vector<KnownValue>& known) {
  Measurement measurement = as_measured(measured({{}, {}, {}, {0.065}, 5, "1 s"}, "hard"), believed("1 s"));
  measurement.known = known;
  return measurement;
}

TEST(LateRows, HalfOfWhatTheShutterMayTakeIsTheClocks) {
  const Measurement measurement = filmed({{"camera.shutter", 0, 0.004, {}}, {"camera.trigger", 0, 1e-3, {}}});
  const std::vector<Knob> knobs = camera_knobs(believed("1 s"), measurement, all_effects());
  const Knob* clock = clock_of(knobs);
  ASSERT_NE(clock, nullptr);
  EXPECT_EQ(clock->width, 0.002);
  EXPECT_EQ(clock->centre, 0);
  EXPECT_TRUE(clock->exact);
}

// One that is known is late by half of that all the same.
TEST(LateRows, AShutterThatIsKnownIsLateToo) {
  shakedown::Setup setup = believed("1 s");
  set_number(setup, "camera_shutter.time", 0.006, all_effects());
  const Measurement measurement = filmed({{"camera.shutter", 0.006, 1e-4, {}}});
  const std::vector<Knob> knobs = camera_knobs(setup, measurement, all_effects());
  const Knob* clock = clock_of(knobs);
  ASSERT_NE(clock, nullptr);
  WITHIN(clock->width, 0.003, 1e-6, 4.2e-7);
}

// What the balance tells of it counts more than what was said.
TEST(LateRows, OfAShutterThatWasFoundHalfIsTheClocks) {
  const Measurement measurement = filmed({{"camera.shutter", 0, 0.003, {}}});
  const auto width = [&](double value, double error) {
    const std::vector<Knob> knobs =
        camera_knobs(believed("1 s"), measurement, all_effects(), ValueWithError{value, error});
    const Knob* clock = clock_of(knobs);
    return clock == nullptr ? 0 : clock->width;
  };
  WITHIN(width(0.006, 1e-4), 0.003, 2e-6, 4.2e-7);
  EXPECT_EQ(width(0, 1e-4), 5e-5);
}

TEST(LateRows, AClockOrAShutterThatIsKnownExactlyLeavesNothingOpen) {
  for (const char* exact : {"camera.shutter", "camera.trigger"})
    EXPECT_EQ(clock_of(camera_knobs(believed("1 s"), filmed({{exact, 0, 0, {}}}), all_effects())), nullptr)
        << exact;
}

// Before, "push at the release, -31 mm/s" was found in such films: 6.4 m/s^2 at the release times 5 ms.
TEST(SlowLateRows, ARollingShutterIsNoPushAtTheRelease) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  RecordingSettings phone;
  phone.frame_rate = 240;
  const Hidden hidden{{"camera_shutter=time:6 ms", "camera_time_offset=offset:-4.6 ms"},
                      {},
                      phone,
                      {0.040, 0.065, 0.085, 0.104}};
  DiagnoseOptions options;
  options.effects = {"initial_box_velocity", "blade_arc"};
  options.known = all_effects();
  options.execution.threads = 2;
  options.strength_uncertainty = &strength_uncertainty;
  Measurement measurement = as_measured(measured(hidden));
  for (KnownValue& known :
       std::vector<KnownValue>{{"camera.shutter", 0, 0.003, {}}, {"camera.trigger", 0, 0.001, {}}})
    measurement.known.push_back(known);
  const Diagnosis d = diagnose(believed(), measurement, *engine, options);
  EXPECT_TRUE(d.missing.empty()) << d.sentence;
  for (const Hypothesis& answer : d.answers)
    EXPECT_EQ(std::count(answer.effects.begin(), answer.effects.end(), "initial_box_velocity"), 0)
        << d.sentence;
}

}  // namespace
