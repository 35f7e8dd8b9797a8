// SPDX-License-Identifier: MIT
// A single layer of grains lands at once where contacts last, one grain after the other in the hard engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects.hpp"
#include "engine_choice.hpp"
#include "engines.hpp"
#include "hidden_measurements.hpp"
#include "parameter_knobs.hpp"

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

/// By `laboratory`, where the restitution of end walls is this.
Measurement filmed(const std::string& laboratory, double grain_wall = one_layer().restitution.grain_wall) {
  const std::unique_ptr<Engine> engine = engine_named(laboratory);
  const Laboratory with{engine.get(), all_effects(), 3, 2, nullptr};
  Setup truth = one_layer();
  truth.restitution.grain_wall = grain_wall;
  return as_measured(make_measurements(truth, runs_of_lengths({0.041, 0.065}), {}, with), one_layer());
}

struct Chosen : EngineChoice {
  std::int64_t runs = 0;
};

Chosen chosen(const Measurement& measurement, const Setup& setup, DiagnoseOptions options = {}) {
  options.known = all_effects();
  options.lasting_contacts = engine_named("soft");
  const std::unique_ptr<Engine> hard = engine_named("hard");
  constexpr double of_the_frequency = 0.004;  // as a momentum balance knows it
  DiagnosisTools tools(measurement, *hard, options);
  DiagnosisState model;
  model.setup = setup;
  model.theta = free_parameters(setup, setup.spring.frequency, of_the_frequency * setup.spring.frequency);
  const EngineChoice choice = chosen_engine(model, tools);
  return {choice, tools.runs()};
}

}  // namespace

TEST(EngineChoice, ALayerIsAQuestionOfItsOwn) {
  EXPECT_TRUE(lie_in_one_layer(filmed("hard")));
  EXPECT_FALSE(lie_in_one_layer(as_measured(measured({}), believed())));  // 37 grains
}

TEST(SlowEngineChoice, OneLayerWhoseContactsLastIsSimulatedSo) {
  const Chosen soft = chosen(filmed("soft"), one_layer());
  EXPECT_TRUE(soft.lasting_contacts) << soft.note;
  EXPECT_NE(soft.note, "");
}

// With the restitution that the user believes both engines are far off, the right one farther.
TEST(SlowEngineChoice, AWrongRestitutionDoesNotDecide) {
  constexpr double grain_wall = 0.66;
  const Chosen soft = chosen(filmed("soft", grain_wall), one_layer());
  EXPECT_TRUE(soft.lasting_contacts) << soft.note;
  ASSERT_TRUE(soft.fit.has_value());
  const auto found =
      std::find_if(soft.fit->values.begin(), soft.fit->values.end(),
                   [](const FittedValue& value) { return value.key == "restitution.grain_wall"; });
  ASSERT_NE(found, soft.fit->values.end());
  constexpr double errors = 3;
  EXPECT_LT(std::abs(found->value - grain_wall), errors * found->error);
}

TEST(EngineChoice, OneLayerOfHardSpheresStaysOne) {
  const Chosen hard = chosen(filmed("hard"), one_layer());
  EXPECT_FALSE(hard.lasting_contacts) << hard.note;
  EXPECT_EQ(hard.note, "");  // the data accept the model as given
}

TEST(EngineChoice, SeveralLayersAreNotInQuestion) {
  const Chosen two = chosen(as_measured(measured({}), believed()), believed());
  EXPECT_EQ(two.runs, 0);
}

TEST(EngineChoice, TheQuestionCountsInTheLimits) {
  const Measurement measurement = filmed("soft");
  DiagnoseOptions options;
  options.seconds = 1e-6;
  const Chosen no_time = chosen(measurement, one_layer(), options);
  EXPECT_FALSE(no_time.lasting_contacts);
  EXPECT_NE(no_time.note.find("no time"), std::string::npos) << no_time.note;
  options.seconds = 0;
  options.budget = least_budget(measurement);
  EXPECT_EQ(chosen(measurement, one_layer(), options).runs, 0);
}
