// SPDX-License-Identifier: MIT
// Whatever a legal setup asks for, a run ends with results that keep the energy's book or with one sentence
// why there are none, or it says how long it will take. By hand, longer: `test_draws FIRST COUNT`, which
// prints each finding and a summary.
#include <gtest/gtest.h>

#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "drawn_setup.hpp"
#include "program.hpp"

using namespace shakedown;

namespace {

constexpr int most_seconds = 12;  // of a core; after ten it says how long it will take

struct Asked {
  std::string setup;
  Outcome outcome;
  double seconds = 0;

  /// Of what was written: the hard engine's ledger and overlap (hardsphere/promise.hpp).
  std::string broken_promise() const {
    const nlohmann::json told = nlohmann::json::parse(outcome.out);
    if (told["engine"] != "hard") return "";
    if (const double error = told["health"]["ledger_error"]; !(error <= 1e-9))
      return "opens the energy's book";
    if (const double overlap = told["health"]["deepest_overlap_m"]; !(overlap <= 1e-12))
      return "has grains overlap";
    return "";
  }
  bool goes_on() const { return outcome.code == -SIGKILL || outcome.code == -SIGXCPU; }
  /// Empty: as it should be.
  std::string complaint() const {
    if (outcome.code == 0) return broken_promise();
    if (goes_on()) return outcome.err.find("    10 s  ") == std::string::npos ? "works in silence" : "";
    if (outcome.code != 2 && outcome.code != 3) return "ends with " + std::to_string(outcome.code);
    if (outcome.err.empty()) return "says nothing";
    return outcome.err.size() > 3000 ? "says " + std::to_string(outcome.err.size()) + " characters" : "";
  }
};

Asked asked(std::uint64_t number, const ScratchFolder& folder) {
  Asked one{drawn_setup(number), {}};
  const std::string path = (folder / "drawn.toml").string();
  std::ofstream(path) << one.setup;
  const auto begin = std::chrono::steady_clock::now();
  one.outcome =
      shakedown_program({"run", path, "--engine", number % 5 == 4 ? "soft" : "hard", "--json"}, most_seconds);
  one.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return one;
}

int hunt(std::uint64_t first, std::uint64_t count) {
  const ScratchFolder folder;
  std::map<int, int> ends;
  double longest = 0;
  int findings = 0;
  for (std::uint64_t number = first; number < first + count; ++number) {
    const Asked one = asked(number, folder);
    ++ends[one.outcome.code];
    if (one.seconds > longest) std::cout << number << ": " << (longest = one.seconds) << " s" << std::endl;
    if (one.complaint().empty()) continue;
    ++findings;
    std::cout << number << " " << one.complaint() << "\n"
              << one.setup << one.outcome.err.substr(0, 300) << std::endl;
  }
  for (const auto& [code, times] : ends)
    std::cout << (code < 0 ? "stopped at the bound: " : "exit " + std::to_string(code) + ": ") << times
              << "\n";
  std::cout << "longest " << longest << " s, findings " << findings << "\n";
  return findings > 0 ? 1 : 0;
}

}  // namespace

namespace {

void expect_no_complaint(std::uint64_t first, std::uint64_t last) {
  const ScratchFolder folder;
  for (std::uint64_t number = first; number <= last; ++number) {
    const Asked one = asked(number, folder);
    EXPECT_EQ(one.complaint(), "") << number << "\n" << one.setup << one.outcome.err;
  }
}

}  // namespace

TEST(Draws, EndWithResultsOrAReason) { expect_no_complaint(7, 26); }

// 29 and 44 take longer than their bound.
TEST(SlowDraws, EndWithResultsOrAReasonOrSayHowLongTheyTake) { expect_no_complaint(27, 66); }

int main(int count, char** words) {
  // Else the names of tests are asked, or some of them.
  if (count == 3 && std::isdigit(static_cast<unsigned char>(words[1][0])) != 0)
    return hunt(std::strtoull(words[1], nullptr, 10), std::strtoull(words[2], nullptr, 10));
  testing::InitGoogleTest(&count, words);
  return RUN_ALL_TESTS();
}
