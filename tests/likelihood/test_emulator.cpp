// SPDX-License-Identifier: MIT
// What emulators learn from simulations, on a stand-in for the hard engine.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <mutex>
#include <set>

#include "damped_oscillation.hpp"
#include "effects.hpp"
#include "parameter_knobs.hpp"

using namespace shakedown;

namespace {

TEST(Emulator, HasSquaresAndProductsOfCurvedKnobsAlone) {
  const Knob curved{"a", 0, 1, -9, 9, true}, straight{"b", 0, 1, -9, 9, false};
  Knob cubic = curved;
  cubic.cubic = true;
  const Eigen::Vector3d z(2, 3, 5);
  const auto terms = [&](const std::vector<Knob>& knobs) {
    const Eigen::VectorXd list = regression_terms(knobs, z);
    return std::vector<double>(list.begin(), list.end());
  };
  EXPECT_EQ(terms({straight, straight, straight}), (std::vector<double>{1, 2, 3, 5}));
  EXPECT_EQ(terms({curved, straight, curved}), (std::vector<double>{1, 2, 3, 5, 4, 10, 25}));
  EXPECT_EQ(terms({straight, cubic, straight}), (std::vector<double>{1, 2, 3, 5, 9, 27}));
}

TEST(Emulator, LearnsFromThePoolWhatLiesInItsBox) {
  const DampedOscillation engine;
  const std::vector<MeasuredFeatures> measured = measured_on(believed_setup(), believed_setup(), 1);
  SimulationPool pool;
  Workshop workshop{&engine, all_effects(), {2}, &pool};
  EXPECT_EQ(emulate(measured, theta, 64, 0, workshop)[0].residuals.rows(), 64);
  EXPECT_EQ(emulate(measured, theta, 64, 1000, workshop)[0].residuals.rows(), 128);
  std::vector<Knob> narrow = theta;
  for (Knob& knob : narrow) knob.width *= 0.6;
  const Eigen::Index some = emulate(measured, narrow, 64, 2000, workshop)[0].residuals.rows();
  EXPECT_GT(some, 64 + 128 * 0.2);  // 0.75^3 of them
  EXPECT_LT(some, 64 + 128 * 0.7);
  std::vector<MeasuredFeatures> other = measured;
  for (MeasuredFeatures& m : other) m.setup.grains.count = 20;
  EXPECT_EQ(emulate(other, theta, 64, 3000, workshop)[0].residuals.rows(), 64);
}

/// So many knobs with squares and products have more terms than the simulations that were asked for; a
/// diagnosis with two effects and a curve of restitution came to 66 terms of 64 simulations and ended there.
TEST(Emulator, MakesAsManySimulationsAsItsTermsNeed) {
  const DampedOscillation engine;
  const std::vector<MeasuredFeatures> measured = measured_on(believed_setup(), believed_setup(), 1);
  const Workshop workshop{&engine, all_effects(), {2}};
  std::vector<Knob> many = theta;
  for (Knob& knob : many) knob.curved = true;
  const Emulator emulator = emulate(measured, many, 4, 0, workshop)[0];
  EXPECT_EQ(emulator.terms.cols(), 10);  // of three knobs
  EXPECT_EQ(emulator.terms.rows(), 13);
}

/// Notes with which masses of the box it was asked.
class Weighing final : public Engine {
 public:
  std::string_view name() const override { return inner_.name(); }
  Capability can_model(const EffectRecord& record) const override { return inner_.can_model(record); }
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    const std::lock_guard lock(guard_);
    masses.insert(setup.box.mass);
    return inner_.run(setup, options);
  }
  mutable std::set<double> masses;

 private:
  DampedOscillation inner_;
  mutable std::mutex guard_;
};

// Boxes of three lengths weigh what they weigh: a fit that finds all of them 2 g heavier moves each from its
// own mass, and not at all the one that is known exactly.
TEST(Emulator, ARunKeepsItsOwnMassWhereTheCommonOneIsFree) {
  const Weighing engine;
  const Workshop workshop{&engine, all_effects(), {2}};
  std::vector<MeasuredFeatures> measured = measured_on(believed_setup(), believed_setup(), 1);
  ASSERT_GE(measured.size(), 2u);
  const double common = believed_setup().box.mass, heavier = common + 0.05;
  for (MeasuredFeatures& m : measured) m.by_camera["box.mass"] = m.values;
  measured[1].setup.box.mass = heavier;
  Knob mass = exact_knob("box.mass", common, 0.002);
  emulate(measured, {theta[0], mass}, 16, 0, workshop);
  EXPECT_EQ(engine.masses, (std::set<double>{common, heavier})) << "what the mass does is a column";
  engine.masses.clear();
  mass.centre += 0.002, mass.width = 0;  // simulations at a solution
  emulate(measured, {theta[0], mass}, 16, 1000, workshop);
  EXPECT_EQ(engine.masses, (std::set<double>{common + 0.002, heavier + ((common + 0.002) - common)}));
  engine.masses.clear();
  measured[1].by_camera["box.mass"].setZero();
  emulate(measured, {theta[0], mass}, 16, 2000, workshop);
  EXPECT_EQ(engine.masses, (std::set<double>{common + 0.002, heavier}));
}

/// The stand-in's data with what two errors of a camera would do to them.
std::vector<MeasuredFeatures> filmed_on_stand_in() {
  std::vector<MeasuredFeatures> measured = measured_on(believed_setup(), believed_setup(), 1);
  for (MeasuredFeatures& m : measured) {
    m.by_camera["camera_scale.scale"] = m.values;
    m.by_camera["camera_lens.distortion"] = m.values.cwiseAbs2();
  }
  return measured;
}

/// The row of coefficients of the knob of this key; the terms after the constant are the knobs' in order.
Eigen::RowVectorXd slope_of(const Emulator& emulator, const std::vector<Knob>& knobs, std::string_view key) {
  for (std::size_t k = 0; k < knobs.size(); ++k)
    if (knobs[k].key == key) return emulator.coefficients.row(static_cast<Eigen::Index>(k) + 1);
  ADD_FAILURE() << key;
  return {};
}

TEST(Emulator, KnowsEachKnobWhereverTheCamerasStand) {
  const DampedOscillation engine;
  const std::vector<MeasuredFeatures> measured = filmed_on_stand_in();
  const Workshop workshop{&engine, all_effects(), {2}};
  std::vector<Knob> scattered = theta;
  scattered.push_back({"blade_viscous_damping.damping", 0, 0.05, 0, 10, false});
  for (Knob& knob : scattered) knob.curved = false;
  std::vector<Knob> exact{{"camera_scale.scale", 0, 0.005, -0.5, 0.5, false},
                          {"camera_lens.distortion", 0, 0.1, -1, 1, false}};
  for (Knob& knob : exact) knob.exact = true;
  const std::vector<Knob> before{exact[0], exact[1], scattered[0], scattered[1], scattered[2], scattered[3]},
      between{scattered[0], exact[0], scattered[1], scattered[2], exact[1], scattered[3]},
      after{scattered[0], scattered[1], scattered[2], scattered[3], exact[0], exact[1]};
  const Emulator plain = emulate(measured, scattered, 48, 0, workshop)[0];
  for (const std::vector<Knob>& knobs : {before, between, after}) {
    const Emulator emulator = emulate(measured, knobs, 48, 0, workshop)[0];
    EXPECT_EQ(emulator.exact.size(), 2u);
    for (const Knob& knob : scattered)  // the same runs, so the same to rounding; seen: 0
      EXPECT_LT(
          (slope_of(emulator, knobs, knob.key) - slope_of(plain, scattered, knob.key)).cwiseAbs().maxCoeff(),
          1e-15)
          << knob.key;
    for (const Knob& knob : exact)
      EXPECT_EQ(slope_of(emulator, knobs, knob.key),
                knob.width * measured[0].by_camera.at(knob.key).transpose())
          << knob.key;
  }
}

TEST(EmulatorDeathTest, ADesignThatCannotTellItsColumnsApartIsAnError) {
  const DampedOscillation engine;
  const std::vector<MeasuredFeatures> measured = measured_on(believed_setup(), believed_setup(), 1);
  const Workshop workshop{&engine, all_effects(), {2}};
  std::vector<Knob> knobs = theta;
  knobs[1].width = 0;  // cannot move, while the others do
  EXPECT_DEATH(emulate(measured, knobs, 48, 0, workshop), "rank");
}

TEST(Emulator, LeavesOutABlockAsARegressionWithoutItWould) {
  const DampedOscillation engine;
  const std::vector<MeasuredFeatures> measured = measured_on(believed_setup(), believed_setup(), 1);
  const Workshop workshop{&engine, all_effects(), {2}};
  std::vector<Knob> knobs = theta;
  knobs[0].cubic = true;
  const Emulator all = emulate(measured, knobs, 50, 0, workshop)[0];
  ASSERT_EQ(all.terms.cols(), 11);
  const double left = 39.0 / 50;
  const Eigen::MatrixXd features = all.terms * all.coefficients + all.residuals * std::sqrt(left);
  const auto rest = [](const Eigen::MatrixXd& rows) {  // without rows 3, 11, 19, ...
    Eigen::MatrixXd kept(rows.rows() - 6, rows.cols());
    for (Eigen::Index i = 0, k = 0; i < rows.rows(); ++i)
      if (i % 8 != 3) kept.row(k++) = rows.row(i);
    return kept;
  };
  const Eigen::MatrixXd expected = rest(all.terms).colPivHouseholderQr().solve(rest(features));
  EXPECT_LT((all.coefficients_without(3, 8) - expected).cwiseAbs().maxCoeff(), 5e-15);  // m; seen: 3e-16
}

}  // namespace
