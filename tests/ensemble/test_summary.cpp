// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "closed_form_engine.hpp"
#include "ensemble.hpp"
#include "readable_summary.hpp"
#include "summary_file.hpp"
#include "within.hpp"

using namespace shakedown;
using nlohmann::json;

namespace {

json summary_of(int runs, double duration) {
  shakedown::Setup setup;
  setup.run.duration = duration;
  EnsembleOptions options;
  options.runs = runs;
  return json::parse(summary_json(run_ensemble(ClosedFormEngine(), setup, options), setup));
}

}  // namespace

TEST(Summary, HasWhatItPromises) {
  const json summary = summary_of(1, 22);
  for (const char* key :
       {"schema_version", "engine", "setup", "peaks_mm", "slope_mm_per_s", "frequency_hz", "damping",
        "seconds_to_energy_fraction", "energy_loss", "ledger_error", "momentum_error", "deepest_overlap_m",
        "collisions", "events", "wall_seconds", "collisions_per_second", "health"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_LT(summary["peaks_mm"][0], 0);
  EXPECT_GT(summary["peaks_mm"][1], 0);
  for (const char* key : {"amplitude_mm", "loss_per_cycle_fraction", "equivalent_damping_ratio"})
    EXPECT_TRUE(summary["damping"][0].contains(key)) << key;
  for (const char* key : {"0.5", "0.25", "0.1", "0.05", "0.01"})
    EXPECT_TRUE(summary["seconds_to_energy_fraction"][key].is_number()) << key;
  EXPECT_DOUBLE_EQ(summary["energy_loss"]["grain_grain"], 0.2);
  EXPECT_EQ(summary["collisions"]["total"], 1750);
  EXPECT_DOUBLE_EQ(summary["collisions_per_second"], 3500);
  EXPECT_EQ(summary["setup"]["box"]["length"], "40 mm");
  WITHIN(summary["frequency_hz"], 1.23, 4e-12, 2e-13);
}

TEST(Summary, WhatDoesNotExistIsNull) {
  const json summary = summary_of(1, 0.1);
  EXPECT_TRUE(summary["frequency_hz"].is_null());
  EXPECT_TRUE(summary["slope_mm_per_s"].is_null());
  EXPECT_TRUE(summary["seconds_to_energy_fraction"]["0.01"].is_null());
  EXPECT_TRUE(summary["peaks_mm"].empty());
}

TEST(Summary, OfAnEnsembleHasMeanSpreadAndNumber) {
  const json summary = summary_of(5, 22);
  EXPECT_EQ(summary["runs"]["finished"], 5);
  for (const json& statistic :
       {summary["slope_mm_per_s"], summary["peaks_mm"][0], summary["damping"][3]["amplitude_mm"],
        summary["seconds_to_energy_fraction"]["0.5"], summary["collisions"]["grain_grain"],
        summary["wall_seconds"]}) {
    EXPECT_EQ(statistic["n"], 5);
    EXPECT_TRUE(statistic["mean"].is_number());
    EXPECT_TRUE(statistic["sd"].is_number());
  }
  EXPECT_DOUBLE_EQ(summary["collisions"]["grain_grain"]["mean"], 1002);
  EXPECT_DOUBLE_EQ(summary["health"]["ledger_error"]["max"], 5e-15);
  EXPECT_EQ(summary["setup"]["grains"]["count"], 37);  // not a statistic
}

TEST(Summary, RunsWithFewerPeaksCountWhereTheyHaveThem) {
  const json summary = summary_of(3, 1);
  const json nothing = {{"mean", nullptr}, {"sd", nullptr}, {"n", 0}};
  EXPECT_EQ(summary["frequency_hz"], nothing);
}

TEST(ReadableSummary, NamesTheNumbers) {
  shakedown::Setup setup;
  EnsembleOptions options;
  const std::string one = readable_summary(run_ensemble(ClosedFormEngine(), setup, options), setup);
  EXPECT_NE(one.find("1.2300 Hz"), std::string::npos) << one;
  options.runs = 3;
  const std::string three = readable_summary(run_ensemble(ClosedFormEngine(), setup, options), setup);
  EXPECT_NE(three.find("3 runs"), std::string::npos) << three;
  EXPECT_NE(three.find(" +- "), std::string::npos) << three;
}
