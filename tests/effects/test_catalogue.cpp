// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "catalogue.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "setup_keys.hpp"

using namespace shakedown;

TEST(Catalogue, ListsEveryEffectOnALine) {
  const std::string list = list_effects(all_effects());
  EXPECT_EQ(static_cast<std::size_t>(std::count(list.begin(), list.end(), '\n')), all_effects().size() + 2);
  for (const EffectRecord* effect : all_effects())
    EXPECT_NE(list.find("\n" + std::string(effect->name) + " "), std::string::npos);
}

TEST(Catalogue, DescribesParametersWithUnitsAndBounds) {
  const std::string text = describe_effect(*find_effect("clamp_dry_friction"));
  for (const char* part : {"F = -F0 sgn(v)", "den Hartog", "parameter force (required)",
                           "Bounds: 0 N to 10 N.", "Absent at 0 N.", "force = \"0.02 N\""})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(Catalogue, JsonHoldsEveryRecord) {
  const auto json = nlohmann::json::parse(effects_json(all_effects()));
  ASSERT_EQ(json.size(), all_effects().size());
  EXPECT_EQ(json[0]["name"], "grain_friction");
  EXPECT_EQ(json[0]["engines"]["hard"]["fidelity"], "exact");
  EXPECT_EQ(json[0]["parameters"][0]["neutral"], 0);
}

/// What a new measurement must keep: every effect that an engine sees, at both lengths, beside the plain
/// model.
TEST(Catalogue, DifferencesOfTheEnginesAreThereAndSmallBesideTheEffect) {
  for (const EngineDifference& row : engine_differences()) {
    if (row.effect.empty()) continue;
    ASSERT_NE(find_effect(row.effect), nullptr) << row.effect;
    for (const double length : {0.040, 0.104}) {
      SCOPED_TRACE(std::string(row.effect) + " at " + std::to_string(length));
      const auto found = added_difference(row.effect, length);
      ASSERT_TRUE(found.has_value());
      EXPECT_GT(found->half_width, 0);
      EXPECT_LT(std::abs(found->added), 1e-3 + found->half_width);
    }
  }
  EXPECT_EQ(strength_uncertainty("camera_drift"), 0);
  EXPECT_EQ(strength_uncertainty(""), 0);
  for (const EffectRecord* effect : all_effects())
    EXPECT_LT(strength_uncertainty(effect->name), 1) << effect->name;
  EXPECT_FALSE(added_difference("grain_friction", 0.3));
  EXPECT_FALSE(added_difference("", 0.04));
  EXPECT_FALSE(added_difference("camera_drift", 0.04));
  const auto friction = nlohmann::json::parse(effects_json(all_effects()))[0]["hard_soft_difference"];
  ASSERT_EQ(friction.size(), 2u);
  EXPECT_EQ(friction[0]["box_length_mm"], 40);
  const auto added = added_difference("grain_friction", 0.04);
  EXPECT_DOUBLE_EQ(friction[0]["added_to_plain_model_mm_per_s"].get<double>(), 1e3 * added->added);
  EXPECT_LT(friction[0]["slope_change_mm_per_s"], -0.5);
}

TEST(Catalogue, SchemaKnowsEveryKeyAndEffect) {
  const auto schema = nlohmann::json::parse(setup_schema(all_effects()));
  for (const SetupKey& key : setup_keys())
    EXPECT_TRUE(
        schema["properties"][std::string(key.section())]["properties"].contains(std::string(key.name())))
        << key.path;
  EXPECT_EQ(schema["properties"]["effect"]["items"]["oneOf"].size(), all_effects().size());
  EXPECT_EQ(schema["properties"]["box"]["properties"]["length"]["default"], "40 mm");
  EXPECT_EQ(schema["properties"]["grains"]["properties"]["count"]["type"], "integer");
  EXPECT_EQ(schema["properties"]["restitution"]["properties"]["grain_wall"]["maximum"], 1);
}

TEST(Catalogue, KeysAsMarkdown) {
  EXPECT_NE(setup_keys_markdown().find(
                "| `box.length` | `\"40 mm\"` | > 0 mm, <= 1000000 mm | Inner length along the motion. |"),
            std::string::npos)
      << setup_keys_markdown();
}
