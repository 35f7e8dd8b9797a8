// SPDX-License-Identifier: MIT
// The soft engine with effects written into its physics directly, so that these are tests of the engine, not
// of the effects' records.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scratch_folder.hpp"
#include "soft_engine.hpp"

namespace shakedown {

using Apply = void (*)(const EffectChoice&, int, Physics&);

class SoftEffects : public ::testing::Test {
 protected:
  /// A setup with effects as they would come from records.
  shakedown::Setup with(std::vector<Apply> effects) {
    shakedown::Setup setup;
    setup.run.duration = 1;
    for (const Apply apply : effects) {
      auto record = std::make_unique<EffectRecord>();
      record->name = "test_effect";
      record->engines = {{every_engine, {Fidelity::exact}}};
      record->apply = apply;
      setup.effects.push_back({record.get(), {}, {}});
      records.push_back(std::move(record));
    }
    return setup;
  }

  shakedown::Setup empty_box(std::vector<Apply> effects) {
    shakedown::Setup setup = with(std::move(effects));
    setup.grains.count = 0;
    return setup;
  }

  /// Grains x, y, z, vx, vy, vz in a closed cube of 0.2 m.
  shakedown::Setup closed_cube(std::vector<Apply> effects, const std::vector<std::array<double, 6>>& grains) {
    shakedown::Setup setup = with(std::move(effects));
    setup.domain = Domain::closed;
    setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.2;
    setup.grains.count = static_cast<int>(grains.size());
    const std::filesystem::path file = folder / "grains.csv";
    std::ofstream out(file);
    out.precision(17);
    out << "id,x,y,z,vx,vy,vz\n";
    for (std::size_t i = 0; i < grains.size(); ++i) {
      out << i + 1;
      for (const double value : grains[i]) out << ',' << value;
      out << '\n';
    }
    setup.release.initial_grains = file.string();
    return setup;
  }

  Trajectory run(const shakedown::Setup& setup, double ledger_error = 1e-12) const {
    Trajectory result = make_soft_engine()->run(setup);
    EXPECT_LE(result.health.ledger_error, ledger_error);
    EXPECT_LE(result.health.momentum_error, 1e-12);
    EXPECT_EQ(result.ledger.effect_loss.size(), setup.effects.size());
    return result;
  }

  std::vector<std::unique_ptr<EffectRecord>> records;
  ScratchFolder folder;
};
using SlowSoftEffects = SoftEffects;

}  // namespace shakedown
