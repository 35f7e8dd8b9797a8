// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "catalogue.hpp"
#include "effects.hpp"
#include "setup_keys.hpp"

using namespace shakedown;

TEST(Catalogue, ListsEveryEffectOnALine) {
  const std::string list = list_effects(all_effects());
  EXPECT_EQ(static_cast<std::size_t>(std::count(list.begin(), list.end(), '\n')), all_effects().size() + 1);
  for (const EffectRecord* effect : all_effects()) EXPECT_NE(list.find("\n" + std::string(effect->name) + " "), std::string::npos);
}

TEST(Catalogue, DescribesParametersWithUnitsAndBounds) {
  const std::string text = describe_effect(*find_effect("clamp_dry_friction"));
  for (const char* part : {"F = -F0 sgn(v)", "den Hartog", "parameter force (required)", "Bounds: 0 N to 10 N.", "Absent at 0 N.", "force = \"0.02 N\""})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(Catalogue, JsonHoldsEveryRecord) {
  const auto json = nlohmann::json::parse(effects_json(all_effects()));
  ASSERT_EQ(json.size(), all_effects().size());
  EXPECT_EQ(json[0]["name"], "grain_friction");
  EXPECT_EQ(json[0]["engines"]["hard"]["fidelity"], "exact");
  EXPECT_EQ(json[0]["parameters"][0]["neutral"], 0);
}

TEST(Catalogue, SchemaKnowsEveryKeyAndEffect) {
  const auto schema = nlohmann::json::parse(setup_schema(all_effects()));
  for (const SetupKey& key : setup_keys())
    EXPECT_TRUE(schema["properties"][std::string(key.section())]["properties"].contains(std::string(key.name()))) << key.path;
  EXPECT_EQ(schema["properties"]["effect"]["items"]["oneOf"].size(), all_effects().size());
  EXPECT_EQ(schema["properties"]["box"]["properties"]["length"]["default"], "40 mm");
  EXPECT_EQ(schema["properties"]["grains"]["properties"]["count"]["type"], "integer");
  EXPECT_EQ(schema["properties"]["restitution"]["properties"]["grain_wall"]["maximum"], 1);
}

TEST(Catalogue, KeysAsMarkdown) {
  EXPECT_NE(setup_keys_markdown().find("| `box.length` | `\"40 mm\"` | > 0 mm | Inner length along the motion. |"), std::string::npos) << setup_keys_markdown();
}
