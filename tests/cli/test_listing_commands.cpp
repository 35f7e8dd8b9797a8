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
}

TEST(SchemaCommand, PrintsAJsonSchemaOrATable) {
  const Outcome schema = shakedown_program({"schema"});
  EXPECT_EQ(schema.code, 0);
  EXPECT_TRUE(json::parse(schema.out).contains("$schema"));
  EXPECT_EQ(shakedown_program({"schema", "--json"}).out, schema.out);
  const Outcome table = shakedown_program({"schema", "--table"});
  EXPECT_NE(table.out.find("box.length"), std::string::npos) << table.out;
}
