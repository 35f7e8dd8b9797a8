// SPDX-License-Identifier: MIT
// What a setup file can have wrong, and the one message for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "grain_file.hpp"
#include "initial_state.hpp"
#include "random.hpp"
#include "setup_text.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(SetupMistakes, UnknownKeys) {
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
  EXPECT_EQ(
      complaint("[test_drag]\nstrength = \"1 N s/m\""),
      "s.toml:1:2: test_drag: is not a section of a setup; write [[effect]] and name = \"test_drag\", or "
      "--set test_drag.PARAMETER=VALUE");
  EXPECT_EQ(complaint("[effect]\nname = \"test_drag\""),
            "s.toml:1:2: effect: is a table (a list of effects is expected); write [[effect]] with double "
            "brackets for each effect");
  EXPECT_EQ(complaint("[[effect]]\nstrength = \"1 N s/m\""),
            "s.toml:1:1: effect: has no name; write name = \"...\"; `shakedown effects` lists the names");
}

TEST(SetupMistakes, WrongUnitsAndBareNumbers) {
  EXPECT_EQ(complaint("[box]\nlength = 40"),
            "s.toml:2:10: box.length: is the bare number 40 (a length (m) is expected); write the unit that "
            "it has: \"40 m\" or \"40 mm\"");
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

TEST(SetupMistakes, ImpossibleValues) {
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

TEST(SetupMistakes, BoxesTooSmall) {
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

TEST(SetupMistakes, DomainsWithoutAMovingBox) {
  EXPECT_EQ(
      complaint("[domain]\nkind = \"closed\"\n[grains]\ncount = 5\n[[effect]]\nname = \"test_rival\""),
      "s.toml:6:8: test_rival: does nothing in this domain (closed: there is no box that moves); leave it "
      "out, or take domain.kind = \"damper\"");
  const std::string periodic = "[domain]\nkind = \"periodic\"\n[grains]\ncount = ",
                    cube = "[box]\nlength = \"60 mm\"\nwidth = \"";
  EXPECT_EQ(
      complaint(periodic + "0\n"),
      "s.toml:4:9: grains.count: is 0 (a periodic cell without grains holds nothing); take one grain or "
      "more");
  EXPECT_EQ(complaint(periodic + "5\n" + cube + "25 mm\""),
            "s.toml:7:9: box.width: is 25 mm, a period of three grains (10 mm each) or less (a grain would "
            "meet another and its image at once); make the cell larger or the grains smaller");
  EXPECT_EQ(complaint(periodic + "5\n" + cube + "31 mm\""), "");
}

TEST(SetupMistakes, KicksThatWouldComeTooLate) {
  EXPECT_NE(complaint("[hard]\nkick_interval = \"50 s\"").find("hard.kick_interval: is 50000 ms (it must "),
            std::string::npos);
}

TEST(SetupMistakes, EveryViolationAtOnce) {
  const std::string all = complaint(
      "[box]\nmass = \"-1 g\"\nlength = 40\nwdth = \"1 mm\"\n[run]\nduration = \"0 s\"\n[[effect]]\nname = "
      "\"nothing_like_it\"\n");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n') + 1, 5) << all;
  EXPECT_LT(all.find("s.toml:2:8"), all.find("s.toml:3:10"));
  EXPECT_LT(all.find("s.toml:4:1"), all.find("s.toml:6:12"));
}

TEST(SetupMistakes, RivalEffectsNameBothLines) {
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

TEST(SetupMistakes, SyntaxErrorsHaveAPlace) {
  const std::string message = complaint("[box]\nlength = 40 mm\n");
  EXPECT_TRUE(message.starts_with("s.toml:2:")) << message;
  EXPECT_NE(message.find("is not TOML"), message.npos);
  EXPECT_TRUE(complaint("[box]\nlength = \"40 mm\"\nlength = \"41 mm\"\n").starts_with("s.toml:3:"));
  EXPECT_TRUE(complaint("[box]\nlength = \"40 mm\"\n[[[effect]]]\n").starts_with("s.toml:3:1: is not TOML"));
}

TEST(SetupMistakes, MissingFiles) {
  EXPECT_THROW(read_setup("no/such/setup.toml", known), FileError);
  EXPECT_THROW(read_setup(testing::TempDir(), known), FileError);
  const shakedown::Setup setup = parsed("[release]\ninitial_grains = \"no_such.csv\"");
  EXPECT_THROW(initial_state(setup), FileError);
}

TEST(SetupMistakes, ATableIsNoSetup) {
  const auto file = std::filesystem::path(testing::TempDir()) / "film.csv";
  for (const char* table : {"frame,x_px\n0,1.5\n", "0;1,5\n", "\"t\"\t\"x\"\n"}) {
    std::ofstream(file) << table;
    try {
      read_setup(file, known);
      ADD_FAILURE() << table;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("is a table, not a setup"), std::string::npos) << error.what();
    }
  }
}

TEST(SetupMistakes, GrainFilesAreCheckedLineByLine) {
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
  // Measured positions err by some hundredths of a millimetre: pushed apart, and said.
  EXPECT_EQ(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n2,0.10996,0,0,0,0,0\n"), "");
  const shakedown::Setup measured = read_setup(folder / "s.toml", known);
  WITHIN(initial_state(measured).pushed_apart, 2e-5, 1e-8, 5.1e-10);  // half the overlap each
  EXPECT_GE((initial_state(measured).position[1] - initial_state(measured).position[0]).norm(), 0.01);
  EXPECT_NE(note_on_measured_grains(measured).find("pushed apart, none by more than 0.02 mm"),
            std::string::npos)
      << note_on_measured_grains(measured);
  EXPECT_EQ(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n2,0.109,0,0,0,0,0\n"),
            "init.csv:3:1: grains 1 and 2: overlap by 1 mm (more than an error of measured positions, 0.05 "
            "mm, or there is no room to push "
            "them apart); move them apart, or correct grains.diameter");
  EXPECT_EQ(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n2,0.109,0,nan,0,0,0\n"),
            "init.csv:3:1: is not seven finite numbers; write id,x,y,z,vx,vy,vz in m and m/s");
  EXPECT_EQ(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n"),
            "init.csv: grains.count: 1 grains in the file, 2 in the setup; make them the same");
  EXPECT_NE(complaint_about("id,x,y,z,vx,vy,vz\n1,0.1,0,0,0,0,0\n2,0.128,0,0,0,0,0\n")
                .find("sticks out of the box by 5.5 mm"),
            std::string::npos);
}

TEST(SetupMistakes, DamagedTextIsRefusedOrReadNeverWorse) {
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
