// SPDX-License-Identifier: MIT
// Experiment files that lie beside the project, where they do: real recordings, and cases through real
// cameras.
#include <gtest/gtest.h>

#include <filesystem>

#include "experiment_file.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

namespace fs = std::filesystem;

/// The folder `name` of the shared files beside the project or beside the folder that holds it; empty: there
/// is none.
fs::path shared_folder(const std::string& name) {
  for (const char* way : {"../shared", "../../shared"})
    if (const fs::path folder = fs::path(PROJECT_ROOT) / way / name; fs::is_directory(folder)) return folder;
  return {};
}

TEST(SharedRecordings, WhatIsKnownOfTenCamerasIsRead) {
  const fs::path folder = shared_folder("challenge-camera");
  if (folder.empty()) GTEST_SKIP() << "the cases are not here";
  int cases = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!fs::exists(entry.path() / "experiment.toml")) continue;
    const Experiment experiment = read_experiment(entry.path() / "experiment.toml");
    ASSERT_EQ(experiment.known.size(), 5u) << entry.path();
    EXPECT_DOUBLE_EQ(find_known(experiment.known, "box.mass")->value, 0.434);
    EXPECT_DOUBLE_EQ(find_known(experiment.known, "grains.mass")->error, 1e-5);
    EXPECT_DOUBLE_EQ(find_known(experiment.known, "release.displacement")->error, 5e-4);
    EXPECT_DOUBLE_EQ(find_known(experiment.known, "camera.scale")->error, 5e-3);
    EXPECT_DOUBLE_EQ(find_known(experiment.known, "camera.trigger")->error, 2e-3);
    ++cases;
  }
  EXPECT_EQ(cases, 10);
}

TEST(SharedRecordings, RealOscillatorsAreRead) {
  const fs::path folder = shared_folder("recordings");
  if (folder.empty()) GTEST_SKIP() << "the recordings are not here";
  const Experiment pendulum = read_experiment(folder / "pendulum/experiment.toml");
  EXPECT_TRUE(pendulum.runs.at(0).origin_stated);
  WITHIN(pendulum.runs[0].x_box.at(0), (3.075462128 - 3.14159265) * 0.1, 1e-15, 5e-17);
  for (const char* name : {"light", "heavy", "stiff"}) {
    const Experiment springs = read_experiment(folder / "springs" / (std::string(name) + ".toml"));
    EXPECT_GE(springs.runs.size(), 3u);
    EXPECT_FALSE(springs.runs[0].origin_stated);
  }
}

}  // namespace
}  // namespace shakedown
