// SPDX-License-Identifier: MIT
#include "judged_as_given.hpp"

#include <gtest/gtest.h>

#include "effects.hpp"
#include "engines.hpp"
#include "hidden_case.hpp"
#include "scratch_folder.hpp"
#include "setup_file.hpp"
#include "simulation_journal.hpp"

using namespace shakedown;

// A diagnosis that is resumed may simulate by another engine than before.
TEST(SlowJudgedAsGiven, AJournalTellsTheEnginesApart) {
  const shakedown::Setup setup = parse_setup("[run]\nduration = \"2 s\"\n", "damper", all_effects());
  const std::unique_ptr<Engine> hard = engine_named("hard"), soft = engine_named("soft");
  const Measurement measurement = measurement_of(
      setup,
      make_measurements(setup, runs_of_lengths({0.104}), {}, {hard.get(), all_effects(), 3, 1, nullptr}),
      all_effects());
  const ScratchFolder folder;
  SimulationJournal journal(folder / "journal", "test", false);
  constexpr int count = 4;
  const auto judge = [&](const Engine& engine) {
    Workshop workshop{&engine, all_effects(), {1}};
    workshop.store.journal = &journal;
    judged_as_given(setup, measurement, {}, workshop, count);
  };
  judge(*hard);
  const std::int64_t once = journal.kept();
  EXPECT_GE(once, count);
  judge(*hard);
  EXPECT_EQ(journal.kept(), once);
  judge(*soft);
  EXPECT_EQ(journal.kept(), 2 * once);
}
