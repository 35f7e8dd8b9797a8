// SPDX-License-Identifier: MIT
// Keys that a setup leaves out, named.
#include "paper_values.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scratch_folder.hpp"
#include "setup_text.hpp"

using namespace shakedown;
using Names = std::vector<std::string>;

namespace {

const std::string whole =
    "box = {mass = \"434 g\", length = \"40 mm\", width = \"50 mm\"}\nspring = {frequency = \"1 Hz\"}\n"
    "restitution = {grain_grain = 0.7, grain_wall = 0.7}\nrelease = {displacement = \"0.1 m\"}\n";

}  // namespace

TEST(PaperValues, NamesWhatIsLeftOutWithItsValue) {
  EXPECT_EQ(taken_from_paper(parsed(whole + "grains = {count = 3, diameter = \"8 mm\", mass = \"2 g\"}")),
            Names{});
  EXPECT_EQ(taken_from_paper(parsed(whole + "grains = {count = 3}")),
            (Names{"grains.diameter = 10 mm", "grains.mass = 4.04 g"}));
  EXPECT_EQ(taken_from_paper(parsed("[box]\nlength = \"60 mm\"")),
            (Names{"box.mass = 434 g", "box.width = [50 mm, 50 mm]", "spring.frequency = 1.23 Hz",
                   "grains.count = 37", "grains.diameter = 10 mm", "grains.mass = 4.04 g",
                   "restitution.grain_grain = 0.75", "restitution.grain_wall = 0.76",
                   "release.displacement = 107.5 mm"}));
}

TEST(PaperValues, LeavesOutWhatDoesNotMatterOrComesFromElsewhere) {
  EXPECT_EQ(taken_from_paper(parsed("[grains]\ncount = 0")),
            (Names{"box.mass = 434 g", "spring.frequency = 1.23 Hz", "release.displacement = 107.5 mm"}));
  EXPECT_EQ(
      taken_from_paper(parsed("domain = {kind = \"periodic\"}\ngrains = {count = 3}\nbox = {length = \"60 "
                              "mm\", width = \"60 mm\"}")),
      (Names{"grains.diameter = 10 mm", "grains.mass = 4.04 g", "restitution.grain_grain = 0.75"}));
  const std::string_view elsewhere[] = {"grains.mass", "grains.diameter"};
  EXPECT_EQ(taken_from_paper(parsed(whole + "grains = {count = 3}"), elsewhere), Names{});
}

TEST(PaperValues, StrictRefusesThemWithWhatToWrite) {
  const shakedown::Setup setup = parsed(whole + "grains = {count = 3, diameter = \"8 mm\"}");
  try {
    refuse_paper_values(setup, "s.toml");
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "s.toml: grains.mass: is left out (it would have the paper's value, 4.04 g); write mass = \"4.04 "
        "g\" below [grains], with your damper's value, or leave out --strict");
  }
  EXPECT_NO_THROW(refuse_paper_values(parsed(write_setup(setup)), "s.toml"));
}

TEST(PaperValues, LineForPeople) {
  EXPECT_EQ(line_of_paper_values({}), "");
  EXPECT_EQ(line_of_paper_values({"a = 1", "b = 2"}), "taken from the paper: a = 1, b = 2\n");
}

TEST(PaperValues, AFileWithoutAKeyIsRefused) {
  const ScratchFolder folder;
  for (const char* text : {"", "\n", "# only a comment\n"}) {
    std::ofstream(folder / "s.toml") << text;
    EXPECT_THROW(read_setup(folder / "s.toml", known), InputError) << text;
  }
  std::ofstream(folder / "s.toml") << "[box]\n";
  EXPECT_NO_THROW(read_setup(folder / "s.toml", known));
}
