// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "initial_state.hpp"
#include "key_unit.hpp"
#include "random.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"

using namespace shakedown;

namespace {

const EffectRecord drag{.name = "test_drag",
                        .sentence = "A drag for these tests.",
                        .parameters = {{.name = "strength",
                                        .unit = "N s/m",
                                        .low = 0,
                                        .high = 10,
                                        .neutral = 0,
                                        .typical = 0.1,
                                        .sentence = "Strength."}},
                        .claims = "drag",
                        .apply = [](const EffectChoice& choice, int, Physics& physics) {
                          physics.box.viscous = choice.number("strength");
                        }};
const EffectRecord rival{.name = "test_rival",
                         .parameters = {{.name = "on",
                                         .kind = ParameterKind::choice,
                                         .default_value = std::string("box"),
                                         .choices = {"box", "grains"}}},
                         .claims = "drag",
                         .apply = [](const EffectChoice&, int, Physics&) {}};
const EffectRecord arrangement{
    .name = "test_packing", .claims = "release.packing", .apply = [](const EffectChoice&, int, Physics&) {}};
const EffectRecord wind{
    .name = "test_wind",
    .parameters = {{.name = "velocity",
                    .kind = ParameterKind::vector,
                    .unit = "m/s",
                    .default_value = Vec3(0, 0, 0),
                    .low = -5,
                    .high = 5,
                    .neutral = 0},
                   {.name = "formula", .kind = ParameterKind::text, .default_value = std::string("x")},
                   {.name = "constants",
                    .kind = ParameterKind::constants,
                    .default_value = std::map<std::string, double>{}}},
    .apply = [](const EffectChoice&, int, Physics&) {}};
const std::vector<const EffectRecord*> known{&drag, &rival, &arrangement, &wind};

shakedown::Setup parsed(std::string_view text, std::vector<Override> overrides = {}) {
  return parse_setup(text, "s.toml", known, overrides);
}

/// Every message, a line each; "" when the setup is taken.
std::string complaint(std::string_view text, std::vector<Override> overrides = {}) {
  try {
    parsed(text, std::move(overrides));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

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
  EXPECT_EQ(physics_of(setup).box.viscous, 0.05);
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

TEST(SetupFile, UnknownKeys) {
  EXPECT_EQ(complaint("[box]\nlenght = \"40 mm\""),
            "s.toml:2:1: box.lenght: is not a key of a setup (the section has no such key); did you mean "
            "'length'? keys of [box]: mass, length, width");
  EXPECT_EQ(complaint("[box]\ndiameter = \"40 mm\""),
            "s.toml:2:1: box.diameter: is not a key of a setup (the section has no such key); did you mean "
            "grains.diameter? keys of [box]: mass, length, width");
  EXPECT_EQ(complaint("[grain]\ncount = 3"),
            "s.toml:1:2: grain: is not a section of a setup; did you mean 'grains'? sections: domain, box, "
            "spring, blade, grains, restitution, release, run, hard, "
            "soft, bullet, effect");
  EXPECT_EQ(complaint("box = 3"),
            "s.toml:1:1: box: is a whole number (a section is expected); write [box] and its keys below");
  EXPECT_EQ(complaint("[[effect]]\nname = \"test_darg\"\nstrength = \"1 N s/m\""),
            "s.toml:2:8: effect.name: \"test_darg\" is not an effect; did you mean 'test_drag'? effects: "
            "test_drag, test_rival, test_packing, test_wind");
  EXPECT_EQ(complaint("[[effect]]\nname = \"test_drag\"\nstrenght = \"1 N s/m\""),
            "s.toml:3:1: test_drag.strenght: is not a parameter of this effect; did you mean 'strength'? its "
            "parameters: strength");
  EXPECT_EQ(complaint("[test_drag]\nstrength = \"1 N s/m\""),
            "s.toml:1:2: test_drag: is not a section of a setup; write [[effect]] and name = \"test_drag\"");
  EXPECT_EQ(complaint("[effect]\nname = \"test_drag\""),
            "s.toml:1:2: effect: is a table (a list of effects is expected); write [[effect]] with double "
            "brackets for each effect");
  EXPECT_EQ(complaint("[[effect]]\nstrength = \"1 N s/m\""),
            "s.toml:1:1: effect: has no name; write name = \"...\"; `shakedown effects` lists the names");
}

TEST(SetupFile, WrongUnitsAndBareNumbers) {
  EXPECT_EQ(complaint("[box]\nlength = 40"),
            "s.toml:2:10: box.length: is the bare number 40 (a length (m) is expected); write the unit that "
            "it has, e.g. \"40 mm\"");
  EXPECT_EQ(complaint("[box]\nlength = \"40\""),
            "s.toml:2:10: box.length: \"40\" has no unit (a length (m) is expected); write a number and a "
            "unit in quotation marks, e.g. \"1 mm\"");
  EXPECT_EQ(complaint("[box]\nlength = \"40 g\""),
            "s.toml:2:10: box.length: \"40 g\" has the wrong unit (it is a mass (kg), a length (m) is "
            "expected); write a number and a unit in quotation marks, "
            "e.g. \"1 mm\"");
  EXPECT_EQ(complaint("[restitution]\ngrain_wall = \"0.7 mm\""),
            "s.toml:2:14: restitution.grain_wall: \"0.7 mm\" has the wrong unit (it is a length (m), a pure "
            "number is expected); write a number without quotation "
            "marks, e.g. 0.5");
  EXPECT_EQ(complaint("[grains]\ncount = 3.5"),
            "s.toml:2:9: grains.count: is a number (a whole number is expected); write a whole number from 0 "
            "to 100000000 without quotation marks");
  EXPECT_EQ(complaint("[release]\npacking = \"fc\""),
            "s.toml:2:11: release.packing: \"fc\" is not known (one of fcc, square, random, spread is "
            "expected); did you mean \"fcc\"?");
  EXPECT_EQ(
      complaint("[box]\nwidth = [\"50 mm\"]"),
      "s.toml:2:9: box.width: has 1 values (two are expected); write both, e.g. [\"50 mm\", \"50 mm\"]");
  EXPECT_EQ(complaint("[[effect]]\nname = \"test_wind\"\nvelocity = [\"1 m/s\", \"1 m\", \"0 m/s\"]"),
            "s.toml:3:12: test_wind.velocity: \"1 m\" has the wrong unit (it is a length (m), a speed (m/s) "
            "is expected); write a number and a unit in quotation "
            "marks, e.g. \"1 m/s\"");
}

TEST(SetupFile, ImpossibleValues) {
  EXPECT_EQ(complaint("[box]\nmass = \"-434 g\""),
            "s.toml:2:8: box.mass: is -434 g (it must be greater than 0 g); correct the value; the key "
            "means: Mass of the box without grains");
  EXPECT_EQ(complaint("[run]\nduration = \"0 s\""),
            "s.toml:2:12: run.duration: is 0 s (it must be greater than 0 s); correct the value; the key "
            "means: Simulated time");
  EXPECT_EQ(complaint("[restitution]\ngrain_grain = nan"),
            "s.toml:2:15: restitution.grain_grain: is not a finite number; write a number without quotation "
            "marks, e.g. 0.5");
  EXPECT_EQ(complaint("[restitution]\ngrain_grain = inf"),
            "s.toml:2:15: restitution.grain_grain: is not a finite number; write a number without quotation "
            "marks, e.g. 0.5");
  EXPECT_EQ(complaint("[box]\nlength = \"nan mm\""),
            "s.toml:2:10: box.length: \"nan mm\" is not a finite number; write a number and a unit in "
            "quotation marks, e.g. \"1 mm\"");
  EXPECT_EQ(complaint("[restitution]\ngrain_wall = 1.2"),
            "s.toml:2:14: restitution.grain_wall: is 1.2 (it must lie between 0 and 1); correct the value; "
            "the key means: Coefficient of normal restitution of a grain "
            "and the box, end walls and side walls");
  EXPECT_EQ(complaint("[[effect]]\nname = \"test_drag\"\nstrength = \"11 N s/m\""),
            "s.toml:3:12: test_drag.strength: is 11 N s/m (it must lie between 0 N s/m and 10 N s/m); "
            "`shakedown effects test_drag` shows the bounds");
  EXPECT_EQ(complaint("[grains]\nmass = \"404 kg\""),
            "s.toml:2:8: grains.mass: is 404000 g, more than 100 times the box (434 g); check the units of "
            "both masses");
  EXPECT_EQ(complaint("[run]\nsample_rate = \"1 GHz\""),
            "s.toml:2:15: run.sample_rate: gives 2.2e10 samples (5e7 are the most); take a shorter "
            "run.duration or a lower run.sample_rate");
}

TEST(SetupFile, BoxesTooSmall) {
  EXPECT_EQ(complaint("[box]\nlength = \"8 mm\"\n[grains]\ncount = 1"),
            "s.toml:2:10: box.length: is 8 mm, shorter than a grain (10 mm); make the box larger or the "
            "grains smaller");
  EXPECT_EQ(complaint("[grains]\ncount = 150"),
            "s.toml:2:9: grains.count: 150 grains do not fit (they would fill 78.5 % of the box, the densest "
            "packing of spheres fills "
            "74 %); take fewer or smaller grains, or a larger box");
  EXPECT_EQ(complaint("[grains]\ncount = 100"),
            "s.toml:2:9: grains.count: 100 grains do not fit (packing 'fcc' holds 90 in this box); take "
            "fewer or smaller grains, a larger "
            "box, or another release.packing");
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
    EXPECT_NEAR(kinetic_energy(state, 0.434) / spring, 1e-5, 1e-11) << name;
  }
}

TEST(SetupFile, EveryViolationAtOnce) {
  const std::string all = complaint(
      "[box]\nmass = \"-1 g\"\nlength = 40\nwdth = \"1 mm\"\n[run]\nduration = \"0 s\"\n[[effect]]\nname = "
      "\"nothing_like_it\"\n");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n') + 1, 5) << all;
  EXPECT_LT(all.find("s.toml:2:8"), all.find("s.toml:3:10"));
  EXPECT_LT(all.find("s.toml:4:1"), all.find("s.toml:6:12"));
}

TEST(SetupFile, RivalEffectsNameBothLines) {
  EXPECT_EQ(
      complaint(
          "[[effect]]\nname = \"test_drag\"\nstrength = \"1 N s/m\"\n[[effect]]\nname = \"test_rival\"\n"),
      "s.toml:5:8: test_rival: replaces the drag, and so does test_drag at s.toml:2; keep one of the two");
  EXPECT_EQ(complaint("[[effect]]\nname = \"test_rival\"\n[[effect]]\nname = \"test_rival\"\n"),
            "s.toml:4:8: test_rival: is named twice (first at s.toml:2); keep one of them");
  EXPECT_EQ(complaint("[release]\npacking = \"square\"\n[[effect]]\nname = \"test_packing\"\n"),
            "s.toml:4:8: test_packing: sets what release.packing at s.toml:2 sets too; keep one of the two");
  const shakedown::Setup alone = parsed("[[effect]]\nname = \"test_packing\"\n");
  EXPECT_EQ(digest(parsed(write_setup(alone))), digest(alone));
}

TEST(SetupFile, SyntaxErrorsHaveAPlace) {
  const std::string message = complaint("[box]\nlength = 40 mm\n");
  EXPECT_TRUE(message.starts_with("s.toml:2:")) << message;
  EXPECT_NE(message.find("is not TOML"), message.npos);
  EXPECT_TRUE(complaint("[box]\nlength = \"40 mm\"\nlength = \"41 mm\"\n").starts_with("s.toml:3:"));
  EXPECT_TRUE(complaint("[box]\nlength = \"40 mm\"\n[[[effect]]]\n").starts_with("s.toml:3:1: is not TOML"));
}

TEST(SetupFile, MissingFiles) {
  EXPECT_THROW(read_setup("no/such/setup.toml", known), FileError);
  EXPECT_THROW(read_setup(testing::TempDir(), known), FileError);
  const shakedown::Setup setup = parsed("[release]\ninitial_grains = \"no_such.csv\"");
  EXPECT_THROW(initial_state(setup), FileError);
}

TEST(SetupFile, GrainFilesAreCheckedLineByLine) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "grain_files";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "s.toml") << "[grains]\ncount = 2\n[release]\ninitial_grains = \"init.csv\"\n";
  const auto complaint_about = [&](const char* grains) {
    std::ofstream(folder / "init.csv") << grains;
    try {
      initial_state(read_setup(folder / "s.toml", known));
      return std::string();
    } catch (const InputError& error) {
      std::string text = error.what();
      for (std::size_t at; (at = text.find(folder.string())) != text.npos;)
        text.erase(at, folder.string().size() + 1);
      return text;
    }
  };
  EXPECT_EQ(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n2,0.11,0,0,0,0,0\n"), "");
  EXPECT_EQ(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n2,0.109,0,0,0,0,0\n"),
            "init.csv:3:1: grains 1 and 2: overlap by 1 mm; move them apart");
  EXPECT_EQ(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n2,0.109,0,nan,0,0,0\n"),
            "init.csv:3:1: is not seven finite numbers; write id,x,y,z,vx,vy,vz in m and m/s");
  EXPECT_EQ(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n"),
            "init.csv: grains.count: 1 grains in the file, 2 in the setup; make them the same");
  EXPECT_NE(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n2,0.128,0,0,0,0,0\n")
                .find("sticks out of the box by 5.5 mm"),
            std::string::npos);
}

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
            "has, e.g. \"65 mm\"");
  EXPECT_EQ(complaint("", {{"box.lenth", "65mm"}}),
            "--set: box.lenth: is not a key of a setup (the section has no such key); did you mean 'length'? "
            "keys of [box]: mass, length, width");
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

TEST(SetupFile, DamagedTextIsRefusedOrReadNeverWorse) {
  // Anything but InputError ends the test: toml++ itself asserts on some damaged files.
  const std::string text = write_setup(
      parsed("[[effect]]\nname = \"test_wind\"\nvelocity = {x = \"1 m/s\"}\nconstants = {c = \"1 mm\"}\n"));
  const std::string_view bytes = "\"[]{}=.,#\n 0123456789eEmgsN/^-+\\\t\xc2\xb5";
  Random random(1, 0, Stream::other);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = text;
    const std::size_t at = random.bits() % damaged.size();
    if (random.bits() % 2 == 0)
      damaged[at] = bytes[random.bits() % bytes.size()];
    else
      damaged.erase(at, 1 + random.bits() % 5);
    refused += complaint(damaged).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 1500);
  EXPECT_LT(refused, 3000);
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
