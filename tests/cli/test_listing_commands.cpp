// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "program.hpp"

using nlohmann::json;

TEST(EffectsCommand, ListsEffectsAndShowsOne) {
  const Outcome all = shakedown_program({"effects"});
  EXPECT_EQ(all.code, 0);
  EXPECT_NE(all.out.find("grain_friction"), std::string::npos);
  const Outcome one = shakedown_program({"effects", "grain_friction"});
  EXPECT_EQ(one.code, 0);
  EXPECT_NE(one.out.find("[[effect]]"), std::string::npos) << one.out;
}

TEST(EffectsCommand, GivesTheRecordsAsJson) {
  const Outcome all = shakedown_program({"effects", "--json"});
  EXPECT_GE(json::parse(all.out).size(), 20u);
  const Outcome one = shakedown_program({"effects", "grain_friction", "--json"});
  EXPECT_EQ(json::parse(one.out).size(), 1u);
}

TEST(EffectsCommand, KnowsWhatWasMeant) {
  const Outcome outcome = shakedown_program({"effects", "grain_frction"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("did you mean 'grain_friction'"), std::string::npos) << outcome.err;
  const auto meant = [](const std::vector<std::string>& words) { return shakedown_program(words).err; };
  EXPECT_NE(meant({"effects", "dry_friction"}).find("did you mean 'clamp_dry_friction'?"), std::string::npos);
  EXPECT_NE(meant({"effects", "viscous_damping"}).find("did you mean 'blade_viscous_damping'?"),
            std::string::npos);
  const std::string several = meant({"effects", "frictoin"});
  EXPECT_NE(several.find("'clamp_dry_friction'"), std::string::npos) << several;
  EXPECT_NE(several.find("'grain_friction'"), std::string::npos) << several;
  EXPECT_EQ(meant({"effects", "xyzzy"}).find("did you mean"), std::string::npos);
  const std::string films = TEST_DATA "/leaf_spring/";
  const std::string asked = meant(
      {"diagnose", films + "setup.toml", "--data", films + "experiment.toml", "--effects", "clamp_friction"});
  EXPECT_NE(asked.find("did you mean 'clamp_dry_friction' or"), std::string::npos) << asked;
}

TEST(SchemaCommand, PrintsAJsonSchemaOrATable) {
  const Outcome schema = shakedown_program({"schema"});
  EXPECT_EQ(schema.code, 0);
  EXPECT_TRUE(json::parse(schema.out).contains("$schema"));
  EXPECT_EQ(shakedown_program({"schema", "--json"}).out, schema.out);
  const Outcome table = shakedown_program({"schema", "--table"});
  EXPECT_NE(table.out.find("box.length"), std::string::npos) << table.out;
}
