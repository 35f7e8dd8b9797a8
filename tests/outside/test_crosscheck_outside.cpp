// SPDX-License-Identifier: MIT
// Codes of other people among the engines that are compared.
#include <algorithm>
#include <set>

#include "child_program.hpp"
#include "crosscheck.hpp"
#include "lammps.hpp"
#include "outside_errors.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

CrosscheckOptions between(std::vector<std::string> engines) {
  CrosscheckOptions options;
  options.engines = std::move(engines);
  options.runs = 2;
  return options;
}

const Statistic& number_of(const EngineResult& result, std::string_view key) {
  const auto numbers = crosscheck_numbers();
  const auto found = std::ranges::find(numbers, key, &CrosscheckNumber::key);
  return result.numbers.at(static_cast<std::size_t>(found - numbers.begin()));
}

TEST_F(SlowWithLammps, StandsBesideTheOtherEngines) {
  shakedown::Setup setup;
  setup.run.duration = 0.1;
  const Crosscheck found = crosscheck("damper", setup, between({"hard", "soft", "lammps"}));
  ASSERT_EQ(found.engines.size(), 3u);
  std::set<std::pair<std::string, std::string>> pairs;
  for (const Comparison& one : found.comparisons) pairs.insert({one.first, one.second});
  EXPECT_EQ(pairs.size(), 3u);
  EXPECT_EQ(number_of(found.engines[2], "energy_loss_end_wall").n, 2);
  EXPECT_EQ(number_of(found.engines[2], "collisions_end_wall").n, 0);  // LAMMPS does not tell them
}

TEST(CrosscheckOutside, ComparesWhatACommandTells) {
  if (!program_named("python3")) GTEST_SKIP() << "there is no python3";
  const std::string command = std::string("command:") + PROJECT_ROOT + "/harness/outside/example/damper.py";
  shakedown::Setup setup = empty_box(6);
  const Crosscheck found = crosscheck("empty", setup, between({"hard", command}));
  WITHIN(number_of(found.engines[0], "frequency_hz").mean, number_of(found.engines[1], "frequency_hz").mean,
         1e-5, 7.7e-7);
  EXPECT_EQ(number_of(found.engines[1], "energy_loss_end_wall").n, 0);
  for (const Comparison& one : found.comparisons) EXPECT_STRNE(one.number->key, "energy_loss_end_wall");
}

}  // namespace
