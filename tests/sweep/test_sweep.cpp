// SPDX-License-Identifier: MIT
// Whatever happens on the way - threads, shards, other processes, SIGKILL - the file ends up with the same
// results.
#include "sweep.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "effects.hpp"
#include "engines.hpp"
#include "run_numbers.hpp"
#include "scratch_folder.hpp"
#include "setup_file.hpp"
#include "sql.hpp"
#include "within.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

class Sweep : public testing::Test {
 protected:
  void SetUp() override {
    base.run.duration = 2;
    plan = plan_sweep(
        base, parse_axes({"box.length=40:60:10 mm", "restitution.grain_grain=0.7,0.8"}, all_effects()), 3,
        *engine, all_effects());
  }

  ResultFile file(const std::string& name, ResultFile::Opening opening = ResultFile::Opening::resume) const {
    return ResultFile(folder / name, identity_of(plan, *engine), opening);
  }
  SweepOutcome sweep(const std::string& name, const SweepOptions& options) const {
    ResultFile results = file(name);
    return run_sweep(*engine, plan, results, options);
  }
  std::string digest_of(const std::string& name) const {
    return results_digest(ResultFile(folder / name).rows());
  }
  std::string undisturbed() const {
    sweep("undisturbed.sqlite", {.execution = {1}});
    return digest_of("undisturbed.sqlite");
  }
  /// A process that sweeps and is killed by SIGKILL when it has added so many runs.
  void sweep_killed_after(const std::string& name, int runs, int threads) const {
    const pid_t child = ::fork();
    if (child == 0) {
      int added = 0;
      SweepOptions options{.execution = {threads}};
      options.progress = [&](double) {
        if (++added == runs) ::kill(::getpid(), SIGKILL);
      };
      sweep(name, options);
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << status;
  }

  const ScratchFolder folder;
  const std::unique_ptr<Engine> engine = engine_named("hard");
  shakedown::Setup base;
  SweepPlan plan;
};

}  // namespace

TEST_F(Sweep, TwoDimensions) {
  EXPECT_EQ(plan.points.size(), 6u);
  const SweepOutcome outcome = sweep("a.sqlite", {.execution = {2}});
  EXPECT_EQ(outcome.added, 18u);
  EXPECT_FALSE(outcome.interrupted);
  const std::vector<PointSummary> points = summaries_of(ResultFile(folder / "a.sqlite").rows());
  ASSERT_EQ(points.size(), 6u);
  EXPECT_EQ(points[3].varied, (std::vector{50.0, 0.8}));
  EXPECT_EQ(points[3].runs, 3);
  // The numbers are those of single runs of these setups.
  shakedown::Setup setup = base;
  setup.box.length = 0.050;
  setup.restitution.grain_grain = 0.8;
  double sum = 0;
  for (int run = 0; run < 3; ++run) sum += numbers_of_run(setup, engine->run(setup, {run, {}, nullptr}))[3];
  WITHIN(points[3].mean[3] / (sum / 3), 1, 4e-15, 2.3e-16);
}

TEST_F(Sweep, ThreadsDoNotMatter) {
  sweep("threads.sqlite", {.execution = {3}});
  EXPECT_EQ(digest_of("threads.sqlite"), undisturbed());
}

TEST_F(Sweep, ShardsMergedEqualSerial) {
  for (int i = 0; i < 3; ++i) sweep("shard" + std::to_string(i), {.execution = {1}, .share = {i, 3, ""}});
  const ResultFile merged = merge_results(
      folder / "merged.sqlite", {folder / "shard2", folder / "shard0", folder / "shard1", folder / "shard0"});
  EXPECT_EQ(results_digest(merged.rows()), undisturbed());
}

TEST_F(Sweep, ProcessesShareAFile) {
  std::vector<pid_t> children;
  for (int i = 0; i < 3; ++i) {
    children.push_back(::fork());
    if (children.back() == 0) {
      sweep("shared.sqlite", {.execution = {1}, .share = {i, 3, ""}});
      ::_exit(0);
    }
  }
  for (const pid_t child : children) {
    int status = 1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(digest_of("shared.sqlite"), undisturbed());
}

TEST_F(Sweep, KilledAndResumedLosesNothingFinished) {
  for (const int threads : {1, 2}) {
    const std::string name = "killed" + std::to_string(threads);
    sweep_killed_after(name, 4, threads);
    const std::size_t kept = ResultFile(folder / name).rows().size();
    EXPECT_GE(kept, 7u);  // three pilots and four
    sweep_killed_after(name, 2, threads);
    EXPECT_GE(ResultFile(folder / name).rows().size(), kept + 5);
    const SweepOutcome outcome = sweep(name, {.execution = {threads}});
    EXPECT_EQ(outcome.cost.done + outcome.added, 18u);
    EXPECT_EQ(digest_of(name), undisturbed());
  }
}

TEST_F(Sweep, MoreRunsAndLongerRangesGoOnWithTheSameFile) {
  sweep("a.sqlite", {.execution = {1}});
  plan = plan_sweep(base,
                    parse_axes({"box.length=40:70:10 mm", "restitution.grain_grain=0.7,0.8"}, all_effects()),
                    4, *engine, all_effects());
  const SweepOutcome outcome = sweep("a.sqlite", {.execution = {1}});
  EXPECT_EQ(outcome.cost.done, 18u);
  EXPECT_EQ(outcome.added, 32u - 18u);
  EXPECT_EQ(digest_of("a.sqlite"), undisturbed());
}

TEST_F(Sweep, TheEstimateComesFirstAndMayStop) {
  SweepOptions options{.execution = {1}};
  SweepCost told;
  options.announce = [&](const SweepCost& cost) { return told = cost, false; };
  const SweepOutcome outcome = sweep("a.sqlite", options);
  EXPECT_EQ(told.jobs, 18u);
  EXPECT_GT(told.seconds, 0);
  EXPECT_EQ(outcome.added, 3u);  // the pilots are kept
  EXPECT_TRUE(outcome.interrupted);
}

TEST_F(Sweep, AnotherSweepIsRefused) {
  sweep("a.sqlite", {.execution = {1}});
  EXPECT_THROW(file("a.sqlite", ResultFile::Opening::fresh), InputError);
  base.grains.mass *= 2;
  plan = plan_sweep(base, plan.axes, 1, *engine, all_effects());
  EXPECT_THROW(file("a.sqlite"), InputError);
  std::ofstream(folder / "text") << "This is no database, but it is long enough to be taken for one: "
                                 << std::string(2000, 'x');
  EXPECT_THROW(file("text"), FileError);
  EXPECT_THROW(ResultFile(folder / "missing"), FileError);
}

TEST_F(Sweep, FilesThatDisagreeAreNotMerged) {
  sweep("a.sqlite", {.execution = {1}});
  std::vector<ResultRow> rows = ResultFile(folder / "a.sqlite").rows();
  rows[5].numbers[0] += 1e-9;
  file("b.sqlite").add(rows);
  EXPECT_THROW(merge_results(folder / "merged.sqlite", {folder / "a.sqlite", folder / "b.sqlite"}),
               InputError);
}

TEST_F(Sweep, DamagedFilesAreNamed) {
  sweep("a.sqlite", {.execution = {1}});
  {
    const Database database(folder / "a.sqlite", Database::Access::write);
    database.execute("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE;");
  }
  fs::copy_file(folder / "a.sqlite", folder / "cut.sqlite");
  fs::resize_file(folder / "cut.sqlite", fs::file_size(folder / "cut.sqlite") / 2);
  EXPECT_THROW(merge_results(folder / "merged.sqlite", {folder / "cut.sqlite"}), FileError);
  EXPECT_THROW(file("cut.sqlite"), FileError);
  fs::copy_file(folder / "a.sqlite", folder / "view.sqlite");
  Database(folder / "view.sqlite", Database::Access::write)
      .execute(
          "ALTER TABLE runs RENAME TO others; CREATE VIEW runs AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL "
          "SELECT i + 1 FROM n) SELECT others.* FROM others, n;");
  EXPECT_THROW(file("view.sqlite"), FileError);
  const std::string name(run_numbers().front().name);
  Database(folder / "a.sqlite", Database::Access::write)
      .execute("UPDATE runs SET \"" + name + "\" = 1.5 WHERE run = 1;");
  try {
    ResultFile(folder / "a.sqlite").rows();
    FAIL() << "was not refused";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("a.sqlite: is damaged"), std::string::npos) << error.what();
  }
}

TEST_F(Sweep, PointsThatAreNoSetupAreNamedBeforeAnythingRuns) {
  try {
    plan_sweep(base, parse_axes({"box.length=5:45:10 mm"}, all_effects()), 1, *engine, all_effects());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("[at box.length = 5 mm]"), std::string::npos) << error.what();
  }
  EXPECT_THROW(plan_sweep(base, parse_axes({"oscillating_acceleration.frequency=1,2Hz"}, all_effects()), 1,
                          *engine, all_effects()),
               InputError);
}
