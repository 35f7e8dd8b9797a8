// SPDX-License-Identifier: MIT
// What the momentum balance found, as knobs of a fit.
#include <gtest/gtest.h>

#include <utility>

#include "effects.hpp"
#include "engines.hpp"
#include "from_balance.hpp"
#include "known_effects.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

FoundTerm sine_of(double frequency) {
  FoundTerm sine;
  sine.effect = "oscillating_acceleration";
  sine.parameter = "amplitude";
  sine.value = 0.1, sine.low = 0, sine.high = 0.5;
  sine.frequency = frequency, sine.phase = 3;
  return sine;
}

/// The paper's damper with these terms, and what was noted.
std::pair<DiagnosisState, std::vector<std::string>> with_terms(const std::vector<FoundTerm>& terms) {
  DiagnosisState state;
  state.setup = read_setup(std::string(PROJECT_ROOT) + "/harness/examples/L040.toml", all_effects());
  DiagnoseOptions options;
  options.known = all_effects();
  std::vector<std::string> notes;
  const std::unique_ptr<Engine> engine = engine_named("hard");
  state = with_balance(state, terms, {}, *engine, options, notes);
  return {state, notes};
}

}  // namespace

// A setup has one sine: the second one would take the place of the first, whose knobs would move nothing.
TEST(FromBalance, TheSecondOfTwoSinesIsNoted) {
  const auto [state, notes] = with_terms({sine_of(1.4), sine_of(3)});
  EXPECT_EQ(state.missing, std::vector<std::string>{"oscillating_acceleration"});
  EXPECT_EQ(state.found.size(), 3u);
  EXPECT_EQ(get_number(state.setup, "oscillating_acceleration.frequency", all_effects()), 1.4);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes.front().find("two sines"), std::string::npos);
}

// A sine that is hardly known: a fit may move its phase, but not to where no setup can have it.
TEST(FromBalance, ASineStaysWithinTheBoundsOfASetup) {
  const DiagnosisState state = with_terms({sine_of(1.4)}).first;
  ASSERT_EQ(state.found.size(), 3u);
  for (const Knob& knob : state.found) {
    const Parameter* parameter = all_effects().find_parameter(knob.key);
    ASSERT_NE(parameter, nullptr);
    EXPECT_GE(knob.at(-1e3), parameter->low) << knob.key;
    EXPECT_LE(knob.at(1e3), parameter->high) << knob.key;
  }
}
