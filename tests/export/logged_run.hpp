// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "collision_log_file.hpp"
#include "effects.hpp"
#include "hard_engine.hpp"
#include "setup_file.hpp"

namespace shakedown {

/// A short run of the paper's damper with spinning grains, and its log.
inline StoredRun logged_run() {
  const Setup setup = parse_setup(
      "[run]\nduration = \"0.5 s\"\n[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.2\ngrain_wall = "
      "0.1\n",
      "test.toml", all_effects());
  RunOptions options;
  options.log_collisions = true;
  return {"test", setup, 0, *make_hard_engine()->run(setup, options).collision_log};
}

}  // namespace shakedown
