// SPDX-License-Identifier: MIT
#include "engines.hpp"

#include <gtest/gtest.h>

#include "errors.hpp"

using namespace shakedown;

TEST(Engines, EachNameMakesTheEngineOfThatName) {
  const std::vector<std::string> names = engine_names();
  EXPECT_EQ(names, (std::vector<std::string>{"hard", "soft", "bullet", "lammps", "apart"}));
  for (const std::string& name : names) EXPECT_EQ(engine_named(name)->name(), name);
}

TEST(Engines, AnUnknownNameIsTheUsersInput) {
  try {
    engine_named("magic");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("hard"), std::string::npos);
  }
}
