// SPDX-License-Identifier: MIT
// The numbers with which a diagnosis decides are few, and each says where it comes from.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "effort.hpp"
#include "rules.hpp"

using namespace shakedown;

namespace {

std::string text_of(const std::string& file) {
  std::ifstream in(std::string(PROJECT_ROOT) + "/harness/" + file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::size_t count_of(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  return static_cast<std::size_t>(
      std::distance(std::sregex_iterator(text.begin(), text.end(), expression), std::sregex_iterator()));
}

TEST(Rules, AreFewerThanTwentyWithThoseOfTheBalance) {
  const std::size_t of_balance =
      count_of(text_of("balance/balance_rules.hpp"), "(^|\n)constexpr (double|int|Rule) ");
  EXPECT_GE(of_balance, 1u);
  EXPECT_LT(diagnosis_rules().size() + of_balance, 20u);
}

TEST(Rules, EachHasAUnitAndASource) {
  std::set<std::string_view> names;
  for (const Rule& rule : diagnosis_rules()) {
    EXPECT_GE(rule.unit.size(), 3u) << rule.name;
    EXPECT_GE(count_of(std::string(rule.source), "\\S+"), 4u) << rule.name << ": " << rule.source;
    EXPECT_GT(rule.value, 0) << rule.name;
    EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
  }
}

/// Sources of a folder that decide, without those that list the rules.
std::string sources_of(const std::string& folder) {
  std::string text;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(PROJECT_ROOT) + "/harness/" + folder))
    if (entry.path().extension() == ".cpp" && !entry.path().filename().string().starts_with("rules"))
      text += text_of(folder + "/" + entry.path().filename().string());
  return text;
}

TEST(Rules, EveryOneIsInTheListUnderItsNameAndUsed) {
  std::set<std::string> listed, written;
  for (const Rule& rule : diagnosis_rules()) listed.emplace(rule.name);
  const std::string text = text_of("diagnose/rules.hpp");
  const std::regex rule(R"re(\nconstexpr Rule (\w+)\{\s*"(\w+)")re");
  for (std::sregex_iterator one(text.begin(), text.end(), rule), end; one != end; ++one) {
    EXPECT_EQ((*one)[1], (*one)[2]);
    written.insert((*one)[1]);
  }
  EXPECT_EQ(written, listed);
  const std::string deciding = sources_of("diagnose");
  for (const std::string& name : written)
    EXPECT_GE(count_of(deciding, "rules::" + name + "\\b"), 1u) << name << " decides nothing";
}

TEST(Rules, AreThoseOfTheDocument) {
  const std::string document = text_of("diagnose/README.md");
  EXPECT_EQ(count_of(text_of("diagnose/effort.hpp"), "\nconstexpr Rule "), effort_rules().size());
  for (const std::span<const Rule> list : {diagnosis_rules(), effort_rules()})
    for (const Rule& rule : list) {
      std::ostringstream row;
      row << "| `" << rule.name << "` | " << rule.value << " | " << rule.unit << " | " << rule.source << " |";
      EXPECT_NE(document.find(row.str()), std::string::npos) << row.str();
    }
}

/// The line without its words, comments and template arguments.
std::string code_of(const std::string& line) {
  static const std::regex words(R"("(\\.|[^"\\])*")"), comment("//.*"),
      arguments(R"(([A-Za-z_]\w*)<[\w:,*& ]*(<[\w:,*& ]*>)?[\w:,*& ]*>)");
  std::string code = std::regex_replace(std::regex_replace(line, words, ""), comment, "");
  return std::regex_replace(code, arguments, "$1");
}

/// Numbers that are compared with something, but for 0, 1 and 2.
std::vector<std::string> compared_numbers(const std::string& line) {
  static const std::string number = R"((-?\d[\d.]*(?:e-?\d+)?))";
  static const std::regex after("(^|[^<>-])[<>]=? ?" + number),
      before("(^|[^\\w.])" + number + " ?[<>]=?[^<>]");
  std::vector<std::string> found;
  const std::string code = code_of(line);
  for (const std::regex* pattern : {&after, &before})
    for (std::sregex_iterator match(code.begin(), code.end(), *pattern), end; match != end; ++match)
      if (const double value = std::abs(std::stod((*match)[2])); value != 0 && value != 1 && value != 2)
        found.push_back((*match)[2]);
  return found;
}

TEST(Rules, BareNumbersOfConditionsAreSeen) {
  EXPECT_EQ(compared_numbers("if (share > 0.5) return;"), std::vector<std::string>{"0.5"});
  EXPECT_EQ(compared_numbers("return 1e-3 < x;  // 4 < y"), std::vector<std::string>{"1e-3"});
  EXPECT_EQ(compared_numbers("while (step >= 14 && falls < 2)"), std::vector<std::string>{"14"});
  EXPECT_TRUE(compared_numbers(R"(text += format("{:>5.1f} < 7", std::max<double>(3, x));)").empty());
  EXPECT_TRUE(compared_numbers("std::array<double, 3> squares{}; p->value = 4;").empty());
}

// What a verdict turns on has a name, and beside the name its unit and reason.
TEST(Rules, NoConditionHasABareNumber) {
  for (const char* folder : {"balance", "likelihood", "diagnose", "judgement"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(PROJECT_ROOT) + "/harness/" + folder)) {
      std::ifstream source(entry.path());
      int number = 0;
      for (std::string line; std::getline(source, line);) {
        ++number;
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
        for (const std::string& bare : compared_numbers(line))
          ADD_FAILURE() << folder << "/" << entry.path().filename().string() << ":" << number << ": " << bare
                        << " has no name: " << line;
      }
    }
}

// A number of the balance has its reason in the comment right above it.
TEST(Rules, OfTheBalanceFollowAComment) {
  const std::string text = text_of("balance/balance_rules.hpp");
  EXPECT_EQ(count_of(text, "\n/// [^\n]*(\n/// [^\n]*)*\nconstexpr "), count_of(text, "\nconstexpr "));
}

TEST(Rules, ThatAreProbabilitiesAreBetweenNoneAndOne) {
  for (const Rule& rule : diagnosis_rules())
    if (rule.unit == "probability" || rule.unit == "p-value") {
      EXPECT_LT(rule.value, 1) << rule.name;
    }
}

}  // namespace
