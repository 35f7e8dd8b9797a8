// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "catalogue.hpp"
#include "effects.hpp"
#include "physics.hpp"
#include "setup_file.hpp"
#include "toml_document.hpp"

using namespace shakedown;

namespace shakedown::effect {
extern const EffectRecord eddy_brake;
}

TEST(ExampleEffect, OneFileAndOneLineGiveKeysForceAndDocumentation) {
  std::vector<const EffectRecord*> effects(all_effects().begin(), all_effects().end());
  effects.push_back(&effect::eddy_brake);  // in harness/effects: EFFECT(eddy_brake) in effects.cpp
  const shakedown::Setup setup = parse_setup(example_of(effect::eddy_brake), "example", effects);
  ASSERT_EQ(setup.effects.size(), 1u);
  const Physics physics = physics_of(setup);
  ASSERT_EQ(physics.box.free.size(), 1u);
  EXPECT_DOUBLE_EQ(physics.box.free[0].newton(0.057, 0.5, 0), -0.2 * 0.5 * std::exp(-1));
  EXPECT_NE(describe_effect(effect::eddy_brake).find("A magnet beside the track"), std::string::npos);
  EXPECT_NE(setup_schema(effects).find("eddy_brake"), std::string::npos);
  EXPECT_EQ(parse_setup(write_setup(setup), "again", effects).effects[0].number("width"), 0.012);
}

TEST(ExampleEffect, ReadmeShowsTheFileThatIsCompiled) {
  const auto root = std::filesystem::path(PROJECT_ROOT);
  const std::string readme = read_text_file(root / "harness/effects/README.md");
  const std::string file = read_text_file(root / "tests/effects/eddy_brake.cpp");
  const std::string code = file.substr(file.find("#include"));
  EXPECT_NE(readme.find("```cpp\n" + code + "```"), std::string::npos) << "copy the file into the README";
}
