// SPDX-License-Identifier: MIT
// Setups made to break the reader: refused with one clear message, whatever they hold.
#include <gtest/gtest.h>

#include <algorithm>

#include "quantity.hpp"
#include "setup_text.hpp"
#include "toml_document.hpp"

using namespace shakedown;

namespace {

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

}  // namespace

TEST(HostileSetups, LoneBracketsAreNotToml) {
  for (const char* text : {"[", "[[[1]]]", "[[", "[a", "[[[[[[1]]]]]]", "a = [[[1]]"})
    EXPECT_THROW(parsed(text), InputError) << text;
  EXPECT_NE(complaint("[").find("is not TOML"), std::string::npos);
}

TEST(HostileSetups, DepthIsBoundedBeforeTheParser) {
  EXPECT_NE(complaint("a = " + repeated("[", 100000)).find("s.toml:1:1: nests deeper than 64"),
            std::string::npos);
  EXPECT_NE(complaint("\n\na" + repeated(".a", 10000) + " = 1").find("s.toml:3:1: nests deeper"),
            std::string::npos);
  EXPECT_NE(complaint("a = " + repeated("{a = ", 5000)).find("nests deeper"), std::string::npos);
  // Brackets and points in texts and comments are none.
  const std::string harmless = repeated("[.{", 100);
  EXPECT_NO_THROW(parse_toml("a = \"" + harmless + "\\\"" + harmless + "\"\nb = '" + harmless + "'\n# " +
                                 harmless + "\nc = \"\"\"\n" + harmless + "\n\"\"\"\nd = [1.5, 2.5]\n",
                             "s.toml"));
  EXPECT_NO_THROW(parse_toml("a = [" + repeated("[1.5, 2.5], ", 1000) + "]", "s.toml"));
}

TEST(HostileSetups, SizeIsBounded) {
  EXPECT_NE(complaint("#" + std::string(17'000'000, 'x')).find("16 MB"), std::string::npos);
}

TEST(HostileSetups, UnitsOfManyBrackets) {
  const std::string unit = repeated("(", 20000) + "mm" + repeated(")", 20000);
  EXPECT_NE(complaint("[box]\nlength = \"40 " + unit + "\"").find("more than 200 characters"),
            std::string::npos);
  EXPECT_TRUE(std::holds_alternative<std::string>(parse_unit(unit)));
}

TEST(HostileSetups, OneEffectManyTimesGivesOneMessageEachAndNotAllAreShown) {
  const std::string effect = "[[effect]]\nname = \"test_drag\"\nstrength = \"1 N s/m\"\n";
  try {
    parsed(repeated(effect, 3000));
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_EQ(error.violations.size(), 2999u);
    const std::string text = error.what();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 100);
    EXPECT_TRUE(text.ends_with("and 2899 more")) << text.substr(text.size() - 40);
  }
}

TEST(HostileSetups, ANameOfAnyLengthGivesAShortMessage) {
  const std::string message = complaint("begin" + std::string(100000, 'k') + "end = 1\n");
  EXPECT_LT(message.size(), 10000u);
  EXPECT_NE(message.find("begink"), std::string::npos);
  EXPECT_NE(message.find("kend"), std::string::npos);
}

TEST(HostileSetups, ControlCharactersDoNotReachTheTerminal) {
  const std::string message = to_string(
      Violation{{"s.toml", 1, 1}, "k\x1b[31m", std::string("holds \0 and \x07", 13), "write \u00b5m"});
  EXPECT_EQ(message, "s.toml:1:1: k\\x1b[31m: holds \\x00 and \\x07; write \u00b5m");
}

/// Beyond these bounds an engine keeps no promise, or never comes to an end.
TEST(HostileSetups, NumbersBeyondWhatDoublesHoldAreRefused) {
  for (const auto& [key, value] : {std::pair{"box.length", "1e9 m"},
                                   {"release.displacement", "-1e50 m"},
                                   {"spring.frequency", "1e300 Hz"},
                                   {"grains.diameter", "1e-9 mm"},
                                   {"grains.mass", "1e22 g"},
                                   {"run.duration", "1e22 s"}})
    EXPECT_NE(complaint("", {{key, value}}).find("it must lie between"), std::string::npos)
        << complaint("", {{key, value}});
}
