// SPDX-License-Identifier: MIT
// Setups for tests: grains placed by hand, effects with given strengths.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "effects.hpp"
#include "engines_under_test.hpp"
#include "scratch_folder.hpp"

namespace shakedown {

struct PlacedGrain {
  Vec3 position, velocity;
};

/// A file of grains that lives as long as this object.
class PlacedGrains {
 public:
  explicit PlacedGrains(const std::vector<PlacedGrain>& grains) {
    std::ofstream file(path());
    file.precision(17);
    file << "id,x,y,z,vx,vy,vz\n";
    int id = 0;
    for (const PlacedGrain& grain : grains) {
      file << ++id;
      for (const Vec3* part : {&grain.position, &grain.velocity})
        for (const double value : *part) file << ',' << value;
      file << '\n';
    }
  }
  std::string path() const { return (folder_ / "grains.csv").string(); }

 private:
  ScratchFolder folder_;
};

/// Runs a setup whose grains are these.
inline Trajectory run_with(const Engine& engine, Setup setup, const std::vector<PlacedGrain>& grains) {
  const PlacedGrains file(grains);
  setup.grains.count = static_cast<int>(grains.size());
  setup.release.initial_grains = file.path();
  return engine.run(setup);
}

/// Adds an effect, its parameters at their defaults but for those given.
inline void add_effect(Setup& setup, std::string_view name,
                       const std::map<std::string, ParameterValue>& values) {
  const EffectRecord* record = find_effect(name);
  ASSERT_NE(record, nullptr) << name;
  EffectChoice choice = with_defaults(*record);
  for (const auto& [parameter, value] : values) {
    ASSERT_NE(record->find(parameter), nullptr) << parameter;
    choice.values.insert_or_assign(parameter, value);
  }
  setup.effects.push_back(choice);
}

inline Capability capability_of(const EngineUnderTest& engine, std::string_view effect) {
  return engine.make()->can_model(*find_effect(effect));
}

inline std::vector<EngineUnderTest> engines_that_model(std::string_view effect) {
  std::vector<EngineUnderTest> engines;
  for (const EngineUnderTest& engine : engines_under_test())
    if (capability_of(engine, effect).fidelity != Fidelity::not_modelled) engines.push_back(engine);
  return engines;
}

}  // namespace shakedown
