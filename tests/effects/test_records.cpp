// SPDX-License-Identifier: MIT
// What every record must keep, whatever the effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include "catalogue.hpp"
#include "effect_strength.hpp"
#include "effects.hpp"
#include "initial_state.hpp"
#include "key_unit.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"
#include "value_reading.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

class Records : public testing::TestWithParam<const EffectRecord*> {
 protected:
  const EffectRecord& record = *GetParam();

  shakedown::Setup with_example() const { return parse_setup(example_of(record), "example", all_effects()); }
};

void expect_sentence(std::string_view text, std::string_view what) {
  EXPECT_TRUE(text.ends_with('.')) << what << ": " << text;
  EXPECT_FALSE(text.empty() || std::islower(static_cast<unsigned char>(text.front())))
      << what << ": " << text;
}

bool is_number(const Parameter& parameter) {
  return parameter.kind == ParameterKind::number || parameter.kind == ParameterKind::vector;
}

std::string name_of_case(const testing::TestParamInfo<const EffectRecord*>& info) {
  return std::string(info.param->name);
}

}  // namespace

TEST_P(Records, SaysWhatItIs) {
  EXPECT_TRUE(std::regex_match(std::string(record.name), std::regex("[a-z]+(_[a-z]+)*"))) << record.name;
  expect_sentence(record.sentence, record.name);
  expect_sentence(record.limits, record.name);
  EXPECT_FALSE(record.formula.empty());
  EXPECT_FALSE(record.source.empty());
  EXPECT_NE(record.apply, nullptr);
  EXPECT_FALSE(record.parameters.empty());
  EXPECT_TRUE(record.needs.empty() || find_effect(record.needs) != nullptr) << record.needs;
  for (const Parameter& parameter : record.parameters) expect_sentence(parameter.sentence, parameter.name);
}

TEST_P(Records, CapabilitiesThatAreNotExactSayWhy) {
  for (const std::string_view engine : engines_of(all_effects())) {
    const Capability capability = record.capability(engine);
    EXPECT_TRUE(capability.fidelity == Fidelity::exact || !capability.note.empty()) << engine;
  }
}

TEST_P(Records, ParametersAreSound) {
  std::set<std::string_view> names;
  for (const Parameter& parameter : record.parameters) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_NE(parameter.name, "name");
    EXPECT_EQ(parameter.kind == ParameterKind::choice, !parameter.choices.empty()) << parameter.name;
    if (parameter.kind == ParameterKind::choice) {
      EXPECT_EQ(std::count(parameter.choices.begin(), parameter.choices.end(),
                           std::get<std::string>(parameter.default_value)),
                1);
    }
    if (!is_number(parameter)) continue;
    const auto unit = parse_unit(parameter.unit);
    ASSERT_TRUE(std::holds_alternative<Unit>(unit)) << parameter.unit;
    EXPECT_EQ(std::get<Unit>(unit).si, 1) << "records are in SI: " << parameter.unit;
    EXPECT_LT(parameter.low, parameter.high);
    EXPECT_TRUE(std::isfinite(parameter.low) && std::isfinite(parameter.high))
        << "fits need bounds: " << parameter.name;
    for (const double value :
         {parameter.typical, std::isnan(parameter.neutral) ? parameter.typical : parameter.neutral})
      EXPECT_EQ(out_of_bounds(value, parameter.low, parameter.high, false, parameter.unit), "")
          << parameter.name;
    if (const auto* value = std::get_if<double>(&parameter.default_value)) {
      EXPECT_EQ(out_of_bounds(*value, parameter.low, parameter.high, false, parameter.unit), "")
          << parameter.name;
    }
  }
}

TEST_P(Records, ADiagnosisKnowsHowToLookForItOrWhyNot) {
  const Search search = search_of(record);
  EXPECT_FALSE(search.strengths.empty() && search.not_searched.empty());
  if (!search.not_searched.empty()) expect_sentence(search.not_searched, record.name);
  EXPECT_GT(search.odds, 0);
  EXPECT_LE(search.odds, 1);
  EXPECT_FALSE(record.label.empty());
  for (const auto& [parameter, value] : search.besides) {
    ASSERT_NE(record.find(parameter), nullptr) << parameter;
    EXPECT_EQ(out_of_bounds(value, record.find(parameter)->low, record.find(parameter)->high, false, ""), "");
  }
}

TEST_P(Records, StrengthsThatAreSearchedLieWithinTheirBoundsAndGrow) {
  for (const SearchedStrength& strength : search_of(record).strengths) {
    SCOPED_TRACE(strength.parameters);
    const Parameter& parameter = parameter_of(record, strength);
    EXPECT_GE(strength.low, parameter.low);
    EXPECT_LE(strength.high, parameter.high);
    EXPECT_LT(strength.low, strength.high);
    EXPECT_EQ(std::count(strength.levels.begin(), strength.levels.end(), strength.typical), 1);
    EXPECT_GE(strength.levels.size(), 2u);
    EXPECT_LE(strength.levels.size(), 5u);
    const auto weaker = [&](double a, double b) {
      return strength.inverse ? a > b : std::abs(a) < std::abs(b);
    };
    EXPECT_TRUE(std::is_sorted(strength.levels.begin(), strength.levels.end(), weaker));
    EXPECT_TRUE(weaker(strength.typical, strength.strongest));
    const double absent = absent_value(record, strength, {});
    for (const double level : strength.levels) {
      const double value = strength.inverse ? level : absent + level;
      EXPECT_GE(value, strength.low);
      EXPECT_LE(value, strength.high);
      EXPECT_EQ(value_at_level(strength, level, absent), value);
    }
    const double hidden = strength.inverse ? strength.strongest : absent + strength.strongest;
    EXPECT_EQ(out_of_bounds(hidden, parameter.low, parameter.high, false, parameter.unit), "");
  }
}

TEST_P(Records, ItsStrengthCanBeSetByTheKeysOfASearch) {
  for (const SearchedStrength& strength : search_of(record).strengths) {
    shakedown::Setup setup;
    const double absent = absent_value(record, strength, setup);
    for (const std::string& key : joined_keys(keys_of(record, strength)))
      set_number(setup, key, value_at_level(strength, strength.typical, absent), all_effects());
    const shakedown::Setup read = parse_setup(write_setup(setup), "searched", all_effects());
    ASSERT_EQ(read.effects.size(), 1u) << strength.parameters;
    if (strength.inverse) continue;
    for (const std::string& key : joined_keys(keys_of(record, strength)))
      set_number(setup, key, absent, all_effects());
    if (strength.absent_key.empty()) {
      EXPECT_TRUE(parse_setup(write_setup(setup), "absent", all_effects()).effects.empty());
    }
  }
}

TEST(Search, ChangesThatLeaveTheBoundsGoTheOtherWay) {
  const EffectRecord& side = *find_effect("side_wall_restitution");
  const SearchedStrength strength = search_of(side).strengths.at(0);
  shakedown::Setup setup;
  EXPECT_DOUBLE_EQ(value_at_level(strength, -0.2, absent_value(side, strength, setup)), 0.56);
  setup.restitution.grain_wall = 0.2;
  EXPECT_DOUBLE_EQ(value_at_level(strength, -0.2, absent_value(side, strength, setup)), 0.4);
  setup.restitution.grain_wall = 0.62;  // what is nearly there stays on its side
  EXPECT_DOUBLE_EQ(value_at_level(strength, -0.6, absent_value(side, strength, setup)), 0.05);
}

TEST(Search, IsMadeFromTheParametersOfARecordThatSaysNothing) {
  const SearchedStrength damping = search_of(*find_effect("blade_viscous_damping")).strengths.at(0);
  EXPECT_EQ(damping.parameters, "damping");
  EXPECT_EQ(damping.levels, (std::vector{0.025, 0.05, 0.1}));
  EXPECT_EQ(damping.high, 10);
  EXPECT_EQ(damping.strongest, 0.5);
  EffectRecord pull;
  pull.name = "pull";
  pull.parameters = {
      {.name = "force", .kind = ParameterKind::vector, .low = -2, .high = 2, .neutral = 0, .typical = 1.5}};
  const Search search = search_of(pull);
  ASSERT_EQ(search.strengths.size(), 3u);
  EXPECT_EQ(keys_of(pull, search.strengths[1]), "pull.force.y");
  EXPECT_EQ(search.strengths[1].levels, (std::vector{0.75, 1.5}));
  EXPECT_EQ(search.strengths[1].strongest, 2);
}

TEST(Search, StrengthsInWords) {
  const auto words = [](const char* effect, double value) {
    const EffectRecord& record = *find_effect(effect);
    return strength_in_words(record, search_of(record).strengths.at(0), value);
  };
  EXPECT_EQ(words("blade_viscous_damping", 0.05), "linear damping of the box, 0.05 N s/m");
  EXPECT_EQ(words("camera_drift", 1.234567e-4), "drift of the camera, 0.123 mm/s");
  EXPECT_EQ(words("grain_friction", 0.2), "friction of the grains, 0.2");
}

TEST_P(Records, ExampleIsASetupThatWritesAndReadsBack) {
  const shakedown::Setup setup = with_example();
  ASSERT_EQ(setup.effects.size(), 1u) << "the example must not be neutral";
  EXPECT_EQ(setup.effects[0].record, &record);
  const shakedown::Setup again = parse_setup(write_setup(setup), "again", all_effects());
  EXPECT_EQ(write_setup(again), write_setup(setup));
  EXPECT_EQ(digest(again), digest(setup));
  EXPECT_NE(digest(setup), digest(shakedown::Setup{}));
  physics_of(setup);
  EXPECT_EQ(initial_state(setup).size(), 37u);
}

TEST_P(Records, NeutralValueIsDroppedWhenRead) {
  shakedown::Setup setup = with_example();
  bool has_neutral = false;
  for (const Parameter& parameter : record.parameters) {
    if (!is_number(parameter) || std::isnan(parameter.neutral)) continue;
    has_neutral = true;
    const bool vector = parameter.kind == ParameterKind::vector;
    for (const std::string& axis :
         vector ? std::vector<std::string>{".x", ".y", ".z"} : std::vector<std::string>{""})
      set_number(setup, std::string(record.name) + "." + std::string(parameter.name) + axis,
                 parameter.neutral, all_effects());
  }
  const shakedown::Setup read = parse_setup(write_setup(setup), "neutral", all_effects());
  EXPECT_EQ(read.effects.empty(), has_neutral);
  EXPECT_EQ(digest(setup) == digest(shakedown::Setup{}), has_neutral);
  EXPECT_EQ(write_setup(read) == write_setup(shakedown::Setup{}), has_neutral);
}

TEST_P(Records, ListedTwiceNamesBothLines) {
  try {
    parse_setup(example_of(record) + example_of(record), "twice", all_effects());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is named twice (first at twice:2)"), std::string::npos)
        << error.what();
  }
}

TEST_P(Records, NumbersBeyondTheirBoundsAreRefusedWithTheirPlace) {
  for (const Parameter& parameter : record.parameters) {
    if (parameter.kind != ParameterKind::number) continue;
    const std::string key = std::string(record.name) + "." + std::string(parameter.name);
    for (const double beyond : {parameter.low - 1, parameter.high + 1}) {
      const std::vector<Override> overrides{{key, toml_of(beyond, parameter.unit)}};
      try {
        parse_setup(example_of(record), "example", all_effects(), overrides);
        FAIL() << key;
      } catch (const InputError& error) {
        ASSERT_EQ(error.violations.size(), 1u) << error.what();
        EXPECT_EQ(error.violations[0].key, key);
        EXPECT_EQ(error.violations[0].place.file, "--set");
      }
      shakedown::Setup setup = with_example();
      EXPECT_THROW(set_number(setup, key, beyond, all_effects()), InputError);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Records, testing::ValuesIn(all_effects().begin(), all_effects().end()),
                         name_of_case);
