// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>

#include "errors.hpp"
#include "share.hpp"

using namespace shakedown;

namespace {
JobShare with(const std::map<std::string, std::string>& variables) {
  return share_from_launcher([&](const char* name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  });
}
void expect_share(const std::map<std::string, std::string>& variables, int index, int of) {
  const JobShare share = with(variables);
  EXPECT_EQ(share.index, index) << share.source;
  EXPECT_EQ(share.of, of) << share.source;
}
}  // namespace

TEST(Share, WrittenCountsFromOne) {
  EXPECT_EQ(parse_share("2/8").index, 1);
  EXPECT_EQ(parse_share("2/8").of, 8);
  for (const char* bad : {"", "2", "0/8", "9/8", "2/", "/8", "a/b", "1/0", "-1/2", "1/2/3"})
    EXPECT_THROW(parse_share(bad), InputError) << bad;
}

TEST(Share, FromLaunchers) {
  expect_share({}, 0, 1);
  expect_share({{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "2"}}, 1, 2);
  expect_share({{"PMI_RANK", "3"}, {"PMI_SIZE", "4"}}, 3, 4);
  expect_share({{"SLURM_PROCID", "1"}, {"SLURM_NTASKS", "2"}}, 1, 2);
  expect_share({{"SLURM_JOB_ID", "7"},
                {"SLURM_STEP_ID", "0"},
                {"SLURM_PROCID", "1"},
                {"SLURM_STEP_NUM_TASKS", "3"},
                {"SLURM_NTASKS", "8"}},
               1, 3);
  expect_share({{"SLURM_ARRAY_TASK_ID", "14"},
                {"SLURM_ARRAY_TASK_MIN", "10"},
                {"SLURM_ARRAY_TASK_STEP", "2"},
                {"SLURM_ARRAY_TASK_COUNT", "5"}},
               2, 5);
  expect_share(
      {{"SGE_TASK_ID", "3"}, {"SGE_TASK_FIRST", "1"}, {"SGE_TASK_LAST", "4"}, {"SGE_TASK_STEPSIZE", "1"}}, 2,
      4);
  expect_share({{"SGE_TASK_ID", "undefined"}, {"SGE_TASK_LAST", "undefined"}}, 0, 1);
}

TEST(Share, ABatchScriptIsNoTaskOfSrun) {
  expect_share({{"SLURM_JOB_ID", "7"}, {"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "8"}}, 0, 1);
}

TEST(Share, TasksWithinMembersOfAnArray) {
  expect_share({{"SLURM_ARRAY_TASK_ID", "2"},
                {"SLURM_ARRAY_TASK_MIN", "1"},
                {"SLURM_ARRAY_TASK_COUNT", "3"},
                {"OMPI_COMM_WORLD_RANK", "1"},
                {"OMPI_COMM_WORLD_SIZE", "4"}},
               5, 12);
}

TEST(Share, ContradictionsAreRefused) {
  EXPECT_THROW(with({{"OMPI_COMM_WORLD_RANK", "2"}, {"OMPI_COMM_WORLD_SIZE", "2"}}), InputError);
  EXPECT_THROW(with({{"PMI_RANK", "one"}, {"PMI_SIZE", "2"}}), InputError);
}

TEST(Share, SharesCoverEveryJobOnce) {
  for (std::size_t job = 0; job < 100; ++job) {
    int owners = 0;
    for (int i = 0; i < 7; ++i) owners += JobShare{i, 7, ""}.has(job);
    EXPECT_EQ(owners, 1);
  }
}
