// SPDX-License-Identifier: MIT
#include "hidden_case.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "comma_list.hpp"
#include "effects.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

HiddenCase case_of(const std::vector<std::string>& effects, const std::vector<Override>& parameters = {}) {
  std::vector<Override> overrides = parameters;
  for (const std::string& effect : effects)
    for (const Override& override : overrides_of_effect(effect)) overrides.push_back(override);
  return {parse_setup("", "believed", all_effects()), parse_setup("", "truth", all_effects(), overrides)};
}

}  // namespace

TEST(HiddenCase, AnEffectIsWrittenWithItsParametersOrAtItsTypicalStrength) {
  EXPECT_DOUBLE_EQ(get_number(case_of({"grain_friction=grain_grain:0.1, grain_wall:0.3"}).truth,
                              "grain_friction.grain_wall"),
                   0.3);
  EXPECT_DOUBLE_EQ(get_number(case_of({"blade_viscous_damping"}).truth, "blade_viscous_damping.damping"),
                   0.05);
  EXPECT_DOUBLE_EQ(get_number(case_of({"constant_acceleration=acceleration.z:0.2 m/s^2"}).truth,
                              "constant_acceleration.acceleration.z"),
                   0.2);
}

TEST(HiddenCase, EveryEffectButAFormulaHidesAtItsTypicalStrength) {
  for (const EffectRecord* record : all_effects()) {
    if (record->takes_formula()) continue;
    const HiddenCase hidden = case_of({std::string(record->name)});
    ASSERT_EQ(hidden.truth.effects.size(), 1u) << record->name;
    EXPECT_EQ(hidden.truth.effects[0].record, record);
    EXPECT_EQ(hidden_effects(hidden), record->nuisance ? std::vector<std::string>{}
                                                       : std::vector<std::string>{std::string(record->name)});
  }
}

TEST(HiddenCase, AFormulaHoldsCommasAndIsInNoList) {
  const HiddenCase hidden =
      case_of({"user_force=force:\"-c*v*min(1, abs(x)/x0)\",constants.c:0.1 N s/m,constants.x0:45mm"});
  EXPECT_EQ(hidden.truth.effects.at(0).text("force"), "-c*v*min(1, abs(x)/x0)");
  EXPECT_DOUBLE_EQ(hidden.truth.effects.at(0).constants("constants").at("x0"), 0.045);
  EXPECT_EQ(hidden_effects(hidden), std::vector<std::string>{"unknown"});
}

TEST(HiddenCase, WhatAModelIsNotToldOfIsNoParameter) {
  EXPECT_FALSE(
      has_other_parameters(case_of({}, {{"soft.contact_time", "1 ms"}, {"release.packing", "random"}})));
  EXPECT_TRUE(has_other_parameters(case_of({}, {{"restitution.grain_grain", "0.85"}})));
  EXPECT_FALSE(has_other_parameters(case_of({"grain_friction"})));
}

TEST(HiddenCase, AnswersSayWhatDiffers) {
  const HiddenCase hidden = case_of({"clamp_dry_friction=force:0.02 N"},
                                    {{"restitution.grain_wall", "0.7"}, {"soft.contact_time", "0.5 ms"}});
  const nlohmann::json answer = nlohmann::json::parse(truth_json(hidden, {}, "soft", 3));
  EXPECT_EQ(answer["hidden"], nlohmann::json::parse(R"(["clamp_dry_friction"])"));
  EXPECT_EQ(answer["strengths"], nlohmann::json::parse(R"({"clamp_dry_friction.force": 0.02})"));
  EXPECT_EQ(answer["laboratory"], nlohmann::json::parse(R"({"restitution.grain_wall": 0.7})"));
  EXPECT_EQ(answer["nuisances"], nlohmann::json::parse(R"({"soft.contact_time": 5e-4})"));
  const shakedown::Setup truth = parse_setup(answer["setup"].get<std::string>(), "truth", all_effects());
  EXPECT_EQ(digest(truth), digest(hidden.truth));
}

TEST(HiddenCase, MistakesAreNamedWithWhatToDo) {
  const auto message = [](const auto& act) -> std::string {
    try {
      act();
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was wrong";
  };
  EXPECT_NE(message([] { overrides_of_effect("grain_frictoin"); }).find("did you mean 'grain_friction'"),
            std::string::npos);
  EXPECT_NE(message([] { overrides_of_effect("grain_friction=0.1"); }).find("grain_friction=grain_grain:"),
            std::string::npos);
  const std::string both = message([] { parse_recording({"noise.box=0.2", "fsp=500"}); });
  EXPECT_NE(both.find("has no unit"), std::string::npos);
  EXPECT_NE(both.find("known: centre, stamped, declared, noise.box"), std::string::npos);
}

TEST(HiddenCase, EveryEffectOfTheListCanBeHiddenByItsNameAlone) {
  for (const EffectRecord* record : all_effects()) {
    const HiddenCase hidden = case_of({std::string(record->name)});
    ASSERT_EQ(hidden.truth.effects.size(), 1u) << record->name;
    EXPECT_EQ(hidden.truth.effects[0].record, record);
  }
  shakedown::Setup believed;
  believed.restitution.grain_wall = 0.6;
  WITHIN(std::stod(overrides_of_effect("side_wall_restitution", "--effect", believed).at(0).value), 0.4,
         1e-15, 8.9e-17);
}

TEST(HiddenCase, TheCamerasPropertiesAreReadWithUnits) {
  const RecordingSettings recording = parse_recording(split_at_commas(
      "noise.box=\"0.3 mm\", noise.centre=1mm,fps=250,missing=2%,outliers=0.05,centre=false"));
  EXPECT_DOUBLE_EQ(recording.box_noise, 0.3e-3);
  EXPECT_DOUBLE_EQ(recording.centre_noise, 1e-3);
  EXPECT_DOUBLE_EQ(recording.frame_rate, 250);
  EXPECT_DOUBLE_EQ(recording.missing, 0.02);
  EXPECT_DOUBLE_EQ(recording.outliers, 0.05);
  EXPECT_FALSE(recording.centre);
}

TEST(CommaList, IsTrimmedAndHeedsQuotesAndBrackets) {
  EXPECT_EQ(split_at_commas(" a ,b=\"c, d\", f(x,y)"),
            (std::vector<std::string>{"a", "b=\"c, d\"", "f(x,y)"}));
  EXPECT_EQ(names_in("a, b"), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(names_in("").empty());
}
