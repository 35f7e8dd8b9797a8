// SPDX-License-Identifier: MIT
// Keys of a setup set one by one: by --set, as numbers, in the table.
#include <gtest/gtest.h>

#include "key_unit.hpp"
#include "setup_keys.hpp"
#include "setup_text.hpp"

using namespace shakedown;

TEST(SetupOverride, ChangesKeysAndEffects) {
  const shakedown::Setup setup =
      parsed("[box]\nlength = \"40 mm\"\n", {{"box.length", "\"65 mm\""},
                                             {"grains.count", "5"},
                                             {"box.width", "60mm"},
                                             {"release.packing", "square"},
                                             {"test_drag.strength", "0.1 N s/m"},
                                             {"test_wind.velocity.y", "2 m/s"},
                                             {"test_wind.constants.c", "0.4 N s/m"}});
  EXPECT_EQ(setup.box.length, 0.065);
  EXPECT_EQ(setup.grains.count, 5);
  EXPECT_EQ(setup.box.width[0], 0.06);
  EXPECT_EQ(setup.release.packing, Packing::square);
  ASSERT_EQ(setup.effects.size(), 2u);
  EXPECT_EQ(setup.effects[0].number("strength"), 0.1);
  EXPECT_EQ(setup.effects[1].vector("velocity"), Vec3(0, 2, 0));
  EXPECT_EQ(setup.effects[1].constants("constants").at("c"), 0.4);
}

TEST(SetupOverride, NamesItsOriginInMessages) {
  EXPECT_EQ(complaint("", {{"box.length", "65"}}),
            "--set: box.length: is the bare number 65 (a length (m) is expected); write the unit that it "
            "has: \"65 m\" or \"65 mm\"");
  EXPECT_EQ(complaint("", {{"box.lenth", "65mm"}}),
            "--set: box.lenth: is not a key of a setup (the section has no such key); did you mean 'length'? "
            "keys of [box]: mass, length, width");
  EXPECT_EQ(complaint("", {{"test_darg.strength", "1 N s/m"}}).substr(0, 77),
            "--set: test_darg: is not a section of a setup; did you mean 'test_drag'? sect");
  EXPECT_EQ(complaint("", {{"nothing", "65mm"}}).substr(0, 47),
            "--set: nothing: is not a section of a setup; se");
  EXPECT_THROW(parse_override("box.length"), InputError);
  EXPECT_EQ(parse_override("box.length = 65 mm").value, "65 mm");
}

TEST(SetupOverride, IsNeverLostSilently) {
  for (const char* key : {"box.length.x", "box.width.x.y", "effect.name", "effect", "box",
                          "grains.count.value", "test_drag", ".", "..", "box.", ".length"})
    EXPECT_NE(complaint("[box]\nlength = \"40 mm\"\n", {{key, "1"}}), "") << key;
  EXPECT_NE(complaint("[effect]\nname = \"test_drag\"\n", {{"test_drag.strength", "1 N s/m"}}), "");
}

TEST(SetupNumber, SetsAndGetsInSi) {
  shakedown::Setup setup;
  for (const SetupKey& key : setup_keys()) {
    if (!is_numeric(key)) continue;
    const double value = get_number(setup, key.path) * (key.path == "soft.steps_per_contact" ? 2 : 1);
    set_number(setup, key.path, value, known);
    EXPECT_EQ(get_number(setup, key.path), value) << key.path;
  }
  set_number(setup, "test_drag.strength", 0.2, known);
  set_number(setup, "test_wind.velocity.z", -1, known);
  EXPECT_EQ(get_number(setup, "test_drag.strength"), 0.2);
  EXPECT_EQ(get_number(setup, "test_wind.velocity.z"), -1);
  EXPECT_EQ(get_number(shakedown::Setup{}, "test_drag.strength", known), 0);
  EXPECT_THROW(set_number(setup, "test_drag.strength", 11, known), InputError);
  EXPECT_THROW(set_number(setup, "test_drag.strenght", 1, known), InputError);
  EXPECT_THROW(set_number(setup, "test_wind.velocity", 1, known), InputError);
  EXPECT_THROW(set_number(setup, "box.mass", -1, known), InputError);
  EXPECT_THROW(set_number(setup, "box.mas", 1, known), InputError);
  EXPECT_THROW(set_number(setup, "grains.count", 1.5, known), InputError);
  EXPECT_THROW(set_number(setup, "release.packing", 1, known), InputError);
}

TEST(SetupKeys, JoinedOnesComeApart) {
  EXPECT_EQ(joined_keys("grain_friction.grain_grain&grain_friction.grain_wall"),
            (std::vector<std::string>{"grain_friction.grain_grain", "grain_friction.grain_wall"}));
  EXPECT_EQ(joined_keys("box.mass"), std::vector<std::string>{"box.mass"});
}

TEST(SetupKeys, TableIsSound) {
  for (const SetupKey& key : setup_keys()) {
    EXPECT_EQ(find_setup_key(key.path), &key);
    EXPECT_TRUE(key.sentence.ends_with('.')) << key.path;
    for (const double value : numbers_of(key, shakedown::Setup{})) {
      EXPECT_GE(value, key.low) << key.path;
      EXPECT_LE(value, key.high) << key.path;
    }
  }
  EXPECT_TRUE(violations_of(shakedown::Setup{}).empty());
}
