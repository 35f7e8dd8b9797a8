// SPDX-License-Identifier: MIT
// What release and masses that are known to an error do to the features, on a stand-in whose motion is a
// formula.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "damper_errors.hpp"
#include "effects.hpp"
#include "formula_engine.hpp"
#include "random.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// A swing from where it was let go, slower with a heavier box, and noise that is the microstate's.
class Swing final : public FormulaEngine {
 public:
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    Random random(setup.run.seed, static_cast<std::uint64_t>(options.run), Stream::velocities);
    const double chaos = 1e-3 * random.normal();
    return sampled(setup, 500, [&](double t) {
      const double drawn = chaos * std::sin(1.7 * t);
      const double box = setup.release.displacement * std::cos(7 * t) + 0.2 * setup.box.mass * t + drawn;
      return std::pair(box, box + drawn);
    });
  }
};

Measurement two_runs() {
  Setup setup;
  setup.run.duration = 3;
  Experiment experiment;
  for (const char* name : {"a", "b"}) {
    MeasuredRun run;
    run.name = name;
    run.frame_rate = 500;
    const Trajectory seen = Swing{}.run(setup, {});
    run.time = seen.time, run.x_box = seen.x_box, run.x_com = seen.x_com;
    run.release_error = run.name == "a" ? 4e-4 : 0;
    experiment.runs.push_back(run);
  }
  experiment.known = {{"box.mass", 0.434, 0.002, {}}, {"grains.mass", 0.00404, 0, {}}};
  return measurement_of({setup, setup}, experiment);
}

}  // namespace

TEST(DamperErrors, AreThoseOfWhatWasWeighedAndOfEachRelease) {
  const std::vector<DamperError> errors = damper_errors(two_runs());
  ASSERT_EQ(errors.size(), 2u);  // grains weighed without an error are none
  EXPECT_EQ(errors[0].key, "release.displacement");
  EXPECT_TRUE(errors[0].each_run);
  EXPECT_EQ(errors[0].deviation, (std::vector<double>{4e-4, 0}));
  EXPECT_EQ(errors[1].key, "box.mass");
  EXPECT_FALSE(errors[1].each_run);
  EXPECT_EQ(errors[1].deviation, (std::vector<double>{0.002, 0.002}));
}

// Grains whose places were measured move with the box that is let go elsewhere.
TEST(DamperErrors, ARunWithMeasuredGrainsHasThatOfItsRelease) {
  Measurement measurement = two_runs();
  measurement.runs[0].setup.release.initial_grains = "grains.csv";
  const std::vector<DamperError> errors = damper_errors(measurement);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[0].key, "release.displacement");
  EXPECT_EQ(errors[0].deviation, (std::vector<double>{4e-4, 0}));
}

TEST(DamperErrors, ColumnsHaveNoNoiseForTheMicrostatesAreTheSame) {
  const Measurement measurement = two_runs();
  std::vector<MeasuredFeatures> measured = features_of(measurement);
  const std::vector<DamperError> errors = damper_errors(measurement);
  const Swing engine;
  Workshop workshop;
  workshop.engine = &engine;
  workshop.known = all_effects();
  workshop.execution.threads = 1;
  const std::vector<FeatureColumns> columns = columns_of(errors, measured, 8, 1000, workshop);
  ASSERT_EQ(columns.size(), 2u);
  add_columns(errors, columns, all_effects(), measured);
  // Of the run that was let go 0.4 mm off; the other has nothing of its own.
  ASSERT_EQ(measured[0].own.cols(), 1);
  EXPECT_EQ(measured[1].own.cols(), 0);
  for (Eigen::Index f = 0; f < measured[0].values.size(); ++f) {
    const double t = measured[0].plan.features[static_cast<std::size_t>(f)].time;
    // A parabola's level in a bin of 0.1 s is not quite the cosine's at its middle. Seen: 4e-8.
    WITHIN(measured[0].own(f, 0), 4e-4 * std::cos(7 * t), 5e-7, 4.1e-8);
    WITHIN(measured[0].by_camera.at("box.mass")[f], 0.2 * t, 2e-13, 1.3e-14);
  }
  const std::vector<Knob> knobs = knobs_of(errors, measurement.runs.front().setup);
  ASSERT_EQ(knobs.size(), 1u);
  EXPECT_TRUE(knobs[0].exact);
  EXPECT_EQ(knobs[0].believed_error, 0.002);
}

// Each film has a release of its own, measured in its first frames; what they share is worth a third of the
// time.
TEST(DamperErrors, RepeatsShareSimulationsFromTheMeanOfTheirReleases) {
  Measurement measurement = two_runs();
  measurement.runs[1].recorded.release_error = 4e-4;
  measurement.runs[0].setup.release.displacement = 0.1072;
  measurement.runs[1].setup.release.displacement = 0.1078;
  const std::vector<DamperError> errors = damper_errors(measurement);
  ASSERT_EQ(errors[0].shift.size(), 2u);
  WITHIN(errors[0].shift[0], -3e-4, 1e-16, 8.7e-18);  // rounding
  WITHIN(errors[0].shift[1], 3e-4, 1e-16, 5.3e-18);
  std::vector<MeasuredFeatures> measured = features_of(measurement);
  const Eigen::VectorXd before = measured[0].values;
  const Swing engine;
  Workshop workshop;
  std::int64_t runs = 0;
  workshop.engine = &engine;
  workshop.known = all_effects();
  workshop.execution.threads = 1;
  workshop.meter.done = [&](int more) { runs += more; };
  const std::vector<FeatureColumns> columns = columns_of(errors, measured, 8, 1000, workshop);
  EXPECT_EQ(runs, 3 * 8);  // without, release, mass: each once for both
  add_columns(errors, columns, all_effects(), measured);
  for (const MeasuredFeatures& run : measured) EXPECT_DOUBLE_EQ(run.setup.release.displacement, 0.1075);
  for (Eigen::Index f = 0; f < before.size(); ++f) {
    const double t = measured[0].plan.features[static_cast<std::size_t>(f)].time;
    // What it would have shown, let go where its repeats are. Seen: 3e-8 (the level in a bin).
    WITHIN(measured[0].values[f], before[f] + 3e-4 * std::cos(7 * t), 3e-7, 3.1e-8);
  }
}

TEST(DamperErrors, RunsThatWereMeantToDifferShareNothing) {
  Measurement measurement = two_runs();
  measurement.runs[1].recorded.release_error = 4e-4;
  measurement.runs[1].setup.release.displacement = 0.09;
  const std::vector<double> shift = damper_errors(measurement)[0].shift;
  EXPECT_EQ(shift, (std::vector<double>{0, 0}));
}
