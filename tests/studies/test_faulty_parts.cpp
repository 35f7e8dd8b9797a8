// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "faulty_parts.hpp"

using namespace shakedown;

namespace {

/// Remembers the restitution that it was asked for.
class Listener : public Engine {
 public:
  mutable double restitution = 0;
  std::string_view name() const override { return "listener"; }
  Capability can_model(const EffectRecord&) const override { return {Fidelity::exact}; }
  Trajectory run(const shakedown::Setup& setup, const RunOptions&) const override {
    restitution = setup.restitution.grain_grain;
    return {};
  }
};

}  // namespace

TEST(FaultyParts, AnEngineWhoseRestitutionGoesTheWrongWay) {
  const Listener inner;
  TrialTools tools;
  tools.model = &inner;
  const FaultyParts faulty("wrong-sign", {}, tools);
  shakedown::Setup harder;
  harder.restitution.grain_grain = 0.85;
  tools.model->run(harder);
  EXPECT_DOUBLE_EQ(inner.restitution, 0.65);  // the paper's is 0.75
  EXPECT_EQ(tools.model->name(), "listener");
}

TEST(FaultyParts, WhatWasMeasuredIsDamaged) {
  Experiment experiment;
  experiment.runs.resize(1);
  for (int i = 0; i < 100; ++i) {
    experiment.runs[0].x_box.push_back(i % 2 == 0 ? 1e-3 : -1e-3);
    experiment.runs[0].x_com.push_back(0.01);
  }
  TrialTools tools;
  const FaultyParts smoothed("smoothed", {}, tools);
  tools.damage(experiment);
  EXPECT_LT(std::abs(experiment.runs[0].x_box[50]), 1e-4);
  EXPECT_DOUBLE_EQ(experiment.runs[0].x_com[50], 0.01);
  const FaultyParts lost("no-centre", {}, tools);
  tools.damage(experiment);
  EXPECT_FALSE(experiment.runs[0].has_com());
}

TEST(FaultyParts, NothingIsFaultyUnlessAskedFor) {
  TrialTools tools;
  const FaultyParts none("none", {}, tools);
  EXPECT_EQ(tools.damage, nullptr);
  EXPECT_TRUE(tools.fixed.empty());
  const FaultyParts no_refit("no-refit", {}, tools);
  EXPECT_EQ(tools.fixed.size(), 3u);
}
