// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "effects.hpp"
#include "initial_state.hpp"
#include "setup_text.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(SetupFile, EmptyTextIsThePapersDamper) {
  const shakedown::Setup setup = parsed("");
  EXPECT_EQ(write_setup(setup), write_setup(shakedown::Setup{}));
  EXPECT_EQ(digest(setup), digest(shakedown::Setup{}));
}

TEST(SetupFile, ByteOrderMarksAndCarriageReturnsDoNotMatter) {
  EXPECT_EQ(parsed("\xef\xbb\xbf[box]\r\nlength = \"65 mm\"\r\n").box.length, 0.065);
}

TEST(SetupFile, ReadsQuantitiesWithUnits) {
  const shakedown::Setup setup = parsed(R"(
[box]
mass = "0.5 kg"
length = "6.5 cm"
width = ["50 mm", "60 mm"]
[release]
packing = "random"
[domain]
kind = "closed"
[run]
seed = 7
[bullet]
defaults = true
[[effect]]
name = "test_drag"
strength = "50 mN s/m"
)");
  EXPECT_EQ(setup.box.mass, 0.5);
  EXPECT_EQ(setup.box.length, 0.065);
  EXPECT_EQ(setup.box.width[1], 0.06);
  EXPECT_EQ(setup.release.packing, Packing::random);
  EXPECT_EQ(setup.domain, Domain::closed);
  EXPECT_EQ(setup.run.seed, 7u);
  EXPECT_TRUE(setup.bullet.defaults);
  ASSERT_EQ(setup.effects.size(), 1u);
  EXPECT_EQ(setup.effects[0].number("strength"), 0.05);
  EXPECT_EQ(setup.effects[0].place.line, 15);
  EXPECT_EQ(setup.places.at("box.length").line, 4);
  EXPECT_EQ(physics_of(setup).box.viscous.sum(), 0.05);
}

TEST(SetupFile, WritesWhatReadsBackBitForBit) {
  shakedown::Setup setup;
  setup.box.length = 0.1 + 0.2;
  setup.grains.mass = 1.0 / 3;
  setup.blade.youngs_modulus = 1e11 / 7;
  setup.run.seed = (1ull << 62) + 1;
  setup.grains.count = 5;
  setup.effects.push_back(with_defaults(wind));
  setup.effects[0].values["velocity"] = Vec3(1.0 / 3, 0, -1e-7);
  setup.effects[0].values["formula"] = std::string("a \"quoted\" \\ text");
  setup.effects[0].values["constants"] = std::map<std::string, double>{{"c", 0.1}, {"w", -2.0 / 3}};
  const std::string text = write_setup(setup);
  const shakedown::Setup again = parsed(text);
  EXPECT_EQ(write_setup(again), text);
  EXPECT_EQ(again.box.length, setup.box.length);
  EXPECT_EQ(again.grains.mass, setup.grains.mass);
  EXPECT_EQ(again.run.seed, setup.run.seed);
  ASSERT_EQ(again.effects.size(), 1u);
  EXPECT_EQ(again.effects[0].vector("velocity"), setup.effects[0].vector("velocity"));
  EXPECT_EQ(again.effects[0].text("formula"), setup.effects[0].text("formula"));
  EXPECT_EQ(again.effects[0].constants("constants"), setup.effects[0].constants("constants"));
  EXPECT_EQ(digest(again), digest(setup));
}

TEST(SetupFile, DigestKnowsNumbersAndGrainsButNotPlaces) {
  const std::string first = digest(parsed("[box]\nlength = \"65 mm\""));
  EXPECT_EQ(first.size(), 16u);
  EXPECT_EQ(first, digest(parsed("\n\n[box]\nlength = \"6.5 cm\"")));
  EXPECT_NE(first, digest(parsed("[box]\nlength = \"66 mm\"")));
  EXPECT_EQ(
      first,
      digest(parsed("[box]\nlength = \"65 mm\"\n[[effect]]\nname = \"test_drag\"\nstrength = \"0 N s/m\"")));
  EXPECT_NE(
      first,
      digest(parsed("[box]\nlength = \"65 mm\"\n[[effect]]\nname = \"test_drag\"\nstrength = \"1 N s/m\"")));
  const auto folder = std::filesystem::path(testing::TempDir());
  std::ofstream(folder / "one.csv") << "a";
  std::ofstream(folder / "two.csv") << "a";
  std::ofstream(folder / "three.csv") << "b";
  shakedown::Setup setup;
  const auto with_file = [&](const char* name) {
    setup.release.initial_grains = (folder / name).string();
    return digest(setup);
  };
  EXPECT_EQ(with_file("one.csv"), with_file("two.csv"));
  EXPECT_NE(with_file("one.csv"), with_file("three.csv"));
}

TEST(SetupFile, CellsWithoutASpringAnswerToo) {
  const std::string cell =
      "[domain]\nkind = \"periodic\"\n[box]\nlength = \"40 mm\"\nwidth = \"40 mm\"\n[grains]\n";
  EXPECT_EQ(complaint(cell + "count = 32"), "");
  EXPECT_EQ(complaint(cell + "count = 90"),
            "s.toml:7:9: grains.count: 90 grains do not fit (packing 'fcc, stretched to the cell' leaves "
            "overlaps in this box); take fewer or "
            "smaller grains, a larger box, or another release.packing");
}

TEST(SetupFile, ExamplesAreThePapersDamper) {
  const auto folder = std::filesystem::path(PROJECT_ROOT) / "harness/examples";
  for (const auto& [name, length] :
       {std::pair("L040", 0.040), {"L065", 0.065}, {"L085", 0.085}, {"L104", 0.104}, {"L311", 0.311}}) {
    shakedown::Setup expected;
    expected.box.length = length;
    expected.run.duration = 30;
    EXPECT_EQ(write_setup(read_setup(folder / (std::string(name) + ".toml"), known)), write_setup(expected))
        << name;
  }
}

TEST(SetupFile, InitialGrainsOfOtherCodesAreTaken) {
  for (const auto& [name, length] :
       {std::pair("L40", 0.040), {"L65", 0.065}, {"L85", 0.085}, {"L104", 0.104}}) {
    shakedown::Setup setup;
    setup.box.length = length;
    setup.release.initial_grains = std::string(TEST_DATA) + "/init_damper_" + name + ".csv";
    const State state = initial_state(setup);
    const double spring = physics_of(setup).stiffness * state.x_box * state.x_box / 2;
    EXPECT_EQ(state.size(), 37u);
    WITHIN(kinetic_energy(state, 0.434) / spring, 1e-5, 4e-20, 2.3e-21) << name;
  }
}

// Whatever is set on the values must be what a file with these keys would give.
TEST(Overrides, OnValuesAreWhatTheyAreInAFile) {
  const std::vector<Override> first{
      {"box.length", "\"65 mm\""},
      {"grain_friction.grain_grain", "0.1"},
      {"grain_friction.grain_wall", "0.3"},
      {"constant_acceleration.acceleration", "[\"0.1 m/s^2\", \"0.2 m/s^2\", \"0 m/s^2\"]"}};
  const shakedown::Setup setup = parse_setup("[grains]\ncount = 20\n", "file", all_effects(), first);
  const std::vector<std::vector<Override>> changes{
      {},
      {{"grains.count", "0"}},
      {{"box.width.x", "\"70 mm\""}},
      {{"grain_friction.grain_wall", "0.5"}},
      {{"grain_friction.grain_wall", "0"}, {"grain_friction.grain_grain", "0"}},
      {{"constant_acceleration.acceleration.y", "\"0.3 m/s^2\""},
       {"constant_acceleration.acceleration.x", "\"0.4 m/s^2\""}},
      {{"clamp_dry_friction.force", "20 mN"}, {"release.packing", "random"}}};
  for (const std::vector<Override>& change : changes)
    EXPECT_EQ(write_setup(with_overrides(setup, change, all_effects())),
              write_setup(parse_setup(write_setup(setup), "file", all_effects(), change)));
}

TEST(Overrides, OnValuesAreCheckedAndNameTheirOrigin) {
  const std::vector<Override> wrong{{"box.length", "\"65 kg\"", "experiment.toml:7"},
                                    {"box.lenght", "\"65 mm\"", "experiment.toml:8"}};
  try {
    with_overrides(shakedown::Setup{}, wrong, all_effects());
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.violations.size(), 2u);
    EXPECT_NE(std::string(error.what()).find("experiment.toml:7"), std::string::npos);
  }
}

TEST(Overrides, OfOnePartOfAnEffectKeepTheOthers) {
  const shakedown::Setup setup = parsed(
      "[[effect]]\nname = \"test_wind\"\nvelocity = [\"1 m/s\", \"2 m/s\", \"0 m/s\"]\nformula = \"x*a\"\n"
      "constants = {a = 1, b = 2}\n[[effect]]\nname = \"test_drag\"\nstrength = \"0.1 N s/m\"\n");
  const std::vector<Override> change{{"test_wind.constants.b", "5"}, {"test_wind.velocity.x", "3 m/s"}};
  const shakedown::Setup changed = with_overrides(setup, change, known);
  ASSERT_EQ(changed.effects.size(), 2u);
  EXPECT_EQ(changed.effects[0].record, &wind);
  EXPECT_EQ(changed.effects[0].constants("constants"), (std::map<std::string, double>{{"a", 1}, {"b", 5}}));
  EXPECT_EQ(changed.effects[0].vector("velocity"), Vec3(3, 2, 0));
  EXPECT_EQ(changed.effects[0].text("formula"), "x*a");
  EXPECT_EQ(write_setup(changed), write_setup(parse_setup(write_setup(setup), "file", known, change)));
}
