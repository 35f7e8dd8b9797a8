// SPDX-License-Identifier: MIT
// The paper's puzzle from beginning to end, as harness/bounce/README.md has it: drop tests, their lines in
// the experiment file, and a film of L = 40 mm in which friction of 0.2 is hidden between grains and at
// walls.
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"

namespace {

const std::string puzzle = std::string(TEST_DATA) + "/puzzle/";

class SlowPuzzle : public WithFolder {};

/// The lines of [known] in a file of `bounce --known`.
std::string known_of(const std::string& text) {
  std::istringstream stream(text);
  std::string lines;
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("\"")) lines += line + "\n";
  return lines;
}

}  // namespace

TEST_F(SlowPuzzle, DropTestsBringTheFrictionToLight) {
  std::string known;
  for (const auto& [drops, contact, truth] :
       {std::tuple{"drops_on_steel.csv", "grain_grain", 0.95}, {"drops_on_wall.csv", "grain_wall", 0.90}}) {
    const std::string lines = in_folder(std::string(contact) + ".toml");
    const Outcome outcome = shakedown_program({"bounce", puzzle + drops, "--mass", "4.04 g", "--diameter",
                                               "10 mm", "--contact", contact, "--known", lines, "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json answer = nlohmann::json::parse(outcome.out);
    EXPECT_LT(answer["averaged_at_reference"]["low"], truth);
    EXPECT_GT(answer["averaged_at_reference"]["high"], truth);
    known += known_of(contents(lines));
  }
  for (const char* name : {"setup.toml", "L040.csv"})
    std::filesystem::copy_file(puzzle + name, in_folder(name));
  const std::string experiment = file("with_drops.toml", contents(puzzle + "experiment.toml") + known);
  const Outcome outcome =
      shakedown_program({"diagnose", in_folder("setup.toml"), "--data", experiment, "--json"});
  ASSERT_EQ(outcome.code, 1) << outcome.err;
  const nlohmann::json answer = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(answer["verdict"], "missing");
  EXPECT_EQ(answer["missing"], nlohmann::json({"grain_friction"}));
}
