// SPDX-License-Identifier: MIT
// A limit of time holds within a simulation too: grains that stall make a run of minutes.
#include <gtest/gtest.h>

#include <cmath>

#include "effects.hpp"
#include "emulator.hpp"
#include "errors.hpp"

using namespace shakedown;

namespace {

/// Reports its progress a thousand times, unless it is called off.
class Stalling final : public Engine {
 public:
  explicit Stalling(int& reports) : reports_(reports) {}
  std::string_view name() const override { return "stalling"; }
  Capability can_model(const EffectRecord&) const override { return {Fidelity::exact, ""}; }
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    Trajectory trajectory;
    for (int k = 0; k <= 1000; ++k, ++reports_) {
      const double t = k / 1000.0 * setup.run.duration;
      trajectory.time.push_back(t);
      trajectory.x_box.push_back(0.1 * std::cos(7 * t));
      if (options.progress) options.progress(t);
    }
    trajectory.x_com = trajectory.v_box = trajectory.total_energy = trajectory.x_box;
    return trajectory;
  }

 private:
  int& reports_;
};

std::vector<MeasuredFeatures> measured() {
  int unused = 0;
  shakedown::Setup setup;
  setup.run.duration = 3;
  Experiment experiment;
  MeasuredRun& run = experiment.runs.emplace_back();
  run.name = "a";
  run.frame_rate = 1000 / setup.run.duration;
  const Trajectory seen = Stalling(unused).run(setup, {});
  run.time = seen.time, run.x_box = seen.x_box, run.x_com = seen.x_com;
  return features_of(measurement_of({setup}, experiment));
}

}  // namespace

TEST(Limits, AreAskedAfterTheFlagThatStops) {
  std::atomic<bool> stop = false;
  int asked = 0, done = 0;
  const Workshop work{nullptr, {}, {1, &stop},
                      nullptr, {}, {[&](int more) { done += more; }, [&](std::int64_t) { ++asked; }}};
  work.ask(3);
  work.finished(2);
  stop = true;
  EXPECT_THROW(work.ask(0), Interrupted);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(done, 2);
  const Workshop unlimited{};
  unlimited.ask(1000000);
  unlimited.finished(1);
}

TEST(Limits, HoldWithinASimulation) {
  int reports = 0, asked = 0;
  const Stalling engine(reports);
  Workshop workshop{&engine, all_effects(), {1}};
  workshop.meter.ask_for = [&](std::int64_t more) {
    if (more == 0 && ++asked > 1) throw BudgetSpent("the time is up");  // the first run begins in time
  };
  EXPECT_THROW(emulate(measured(), {}, 4, 1, workshop), BudgetSpent);
  EXPECT_LT(reports, 100) << "the first run was called off on its way";
}
