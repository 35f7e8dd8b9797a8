// SPDX-License-Identifier: MIT
// A single layer of grains lands at once where contacts last, one grain after the other in the hard engine.
#include <gtest/gtest.h>

#include "effects.hpp"
#include "engine_choice.hpp"
#include "engines.hpp"
#include "hidden_measurements.hpp"

using namespace shakedown;

namespace {

/// Eighteen grains, where a layer has room for twenty-five; a box as light as its grains tell of them.
Setup one_layer() {
  return parse_setup(
      "[box]\nmass = \"224 g\"\n[spring]\nfrequency = \"1.776 Hz\"\n[grains]\ncount = "
      "18\n[release]\ndisplacement = "
      "\"68 mm\"\n[run]\nduration = \"5 s\"\n",
      "layer", all_effects());
}

Measurement filmed(const std::string& laboratory) {
  const std::unique_ptr<Engine> engine = engine_named(laboratory);
  const Laboratory with{engine.get(), all_effects(), 3, 2, nullptr};
  return as_measured(make_measurements(one_layer(), runs_of_lengths({0.041, 0.065}), {}, with), one_layer());
}

EngineChoice chosen(const Measurement& measurement, const Setup& setup, DiagnoseOptions options = {}) {
  options.known = all_effects();
  options.lasting_contacts = engine_named("soft");
  return chosen_engine(setup, measurement, *engine_named("hard"), options);
}

}  // namespace

TEST(EngineChoice, ALayerIsAQuestionOfItsOwn) {
  EXPECT_TRUE(lie_in_one_layer(filmed("hard")));
  EXPECT_FALSE(lie_in_one_layer(as_measured(measured({}), believed())));  // 37 grains
}

TEST(EngineChoice, OneLayerWhoseContactsLastIsSimulatedSo) {
  const EngineChoice soft = chosen(filmed("soft"), one_layer());
  EXPECT_TRUE(soft.lasting_contacts) << soft.note;
  EXPECT_NE(soft.note, "");
}

TEST(EngineChoice, OneLayerOfHardSpheresStaysOne) {
  const EngineChoice hard = chosen(filmed("hard"), one_layer());
  EXPECT_FALSE(hard.lasting_contacts) << hard.note;
  EXPECT_EQ(hard.note, "");  // the data accept the model as given
}

TEST(EngineChoice, SeveralLayersAreNotInQuestion) {
  const EngineChoice two = chosen(as_measured(measured({}), believed()), believed());
  EXPECT_EQ(two.runs, 0);
}

TEST(EngineChoice, TheQuestionCountsInTheLimits) {
  const Measurement measurement = filmed("soft");
  DiagnoseOptions options;
  options.seconds = 1e-6;
  const EngineChoice no_time = chosen(measurement, one_layer(), options);
  EXPECT_FALSE(no_time.lasting_contacts);
  EXPECT_NE(no_time.note.find("no time"), std::string::npos) << no_time.note;
  options.seconds = 0;
  options.budget = least_budget(measurement);
  EXPECT_EQ(chosen(measurement, one_layer(), options).runs, 0);
}
