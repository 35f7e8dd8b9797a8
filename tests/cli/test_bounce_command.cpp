// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "program.hpp"

using nlohmann::json;

namespace {

const std::string throws = std::string(TEST_DATA) + "/drops/throws.csv";

class BounceCommand : public WithFolder {};
using SlowBounceCommand = BounceCommand;

}  // namespace

TEST_F(SlowBounceCommand, NamesTheLawAndTheEdge) {
  const Outcome outcome = shakedown_program({"bounce", throws, "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json answer = json::parse(outcome.out);
  EXPECT_EQ(answer["law"], "power");
  EXPECT_LT(answer["laws"][0]["parameters"]["exponent"]["low"], 0.06);
  EXPECT_GT(answer["laws"][0]["parameters"]["exponent"]["high"], 0.06);
  ASSERT_EQ(answer["outliers"].size(), 1u);
  EXPECT_EQ(answer["outliers"][0]["drop"], "throw 4");
  EXPECT_EQ(answer["outliers"][0]["impact"], 5);
  EXPECT_EQ(answer["impacts"].size(), 34u);
}

TEST_F(SlowBounceCommand, WritesPageAndKnownValues) {
  const Outcome outcome =
      shakedown_program({"bounce", throws, "--mass", "8 g", "--diameter", "12.7 mm", "--known",
                         in_folder("known.toml"), "--report", in_folder("page.html")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(contents(in_folder("known.toml")).find("\"restitution.grain_wall\" = \"0.83"), std::string::npos);
  const std::string page = contents(in_folder("page.html"));
  EXPECT_NE(page.find("Restitution against the speed of impact"), std::string::npos);
  EXPECT_NE(page.find("throw 4"), std::string::npos);
}

TEST_F(BounceCommand, SaysWhatIsWrongWithItsInput) {
  const auto refused = [](const std::vector<std::string>& words, int code, const char* with) {
    const Outcome outcome = shakedown_program(words);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(with), std::string::npos) << outcome.err;
  };
  refused({"bounce", in_folder("none.csv")}, 4, "none.csv");
  refused({"bounce", throws, "--mass", "8 g"}, 2, "--diameter");
  refused({"bounce", throws, "--mass", "8 mm", "--diameter", "1 cm"}, 2, "--mass");
  refused({"bounce", throws, "--contact", "floor"}, 2, "grain_wall or grain_grain");
  refused({"bounce", file("a.csv", "x,y\n1,2\n2,3\n3,9\n")}, 2, "a.csv");
  refused({"bounce", file("b.csv", "0.8\n0.7\n")}, 2, "b.csv");
}
