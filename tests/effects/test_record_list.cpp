// SPDX-License-Identifier: MIT
// What the list of effects keeps, and effects beside each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "catalogue.hpp"
#include "effects.hpp"
#include "initial_state.hpp"
#include "key_unit.hpp"
#include "physics.hpp"
#include "setup_file.hpp"
#include "toml_string.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(RecordList, NamesAreUniqueAndFound) {
  std::set<std::string_view> names;
  for (const EffectRecord* effect : all_effects()) {
    EXPECT_TRUE(names.insert(effect->name).second) << effect->name;
    EXPECT_EQ(find_effect(effect->name), effect);
  }
  EXPECT_EQ(find_effect("nothing"), nullptr);
}

// Eleven say why no diagnosis of a box with grains looks for them, or only for the waveform of an empty one.
TEST(RecordList, PriorsAreSharedAmongWhatIsLookedFor) {
  EXPECT_EQ(all_effects().size(), 37u);
  EXPECT_EQ(all_effects().searched(), 26u);
  ASSERT_EQ(all_effects().oscillating().size(), 1u);  // a second mode only in the waveform of an empty box
  EXPECT_EQ(all_effects().oscillating().front()->name, "oscillating_acceleration");
  EXPECT_TRUE(KnownEffects().oscillating().empty());
  EXPECT_EQ(KnownEffects().find("grain_friction"), nullptr);
}

/// Setups and measurements of years refer to these.
TEST(RecordList, KeepsTheNamesOnceGiven) {
  for (const std::string_view name : {"grain_friction",
                                      "velocity_dependent_restitution",
                                      "grain_cohesion",
                                      "side_wall_restitution",
                                      "side_wall_friction",
                                      "grain_rolling_resistance",
                                      "grain_polydispersity",
                                      "blade_viscous_damping",
                                      "blade_quadratic_drag",
                                      "clamp_dry_friction",
                                      "clamp_dahl_friction",
                                      "spring_cubic",
                                      "blade_mass",
                                      "initial_box_velocity",
                                      "initial_packing",
                                      "constant_acceleration",
                                      "oscillating_acceleration",
                                      "grain_air_drag",
                                      "blade_arc",
                                      "camera_com_bias",
                                      "camera_scale",
                                      "camera_time_offset",
                                      "camera_drift",
                                      "camera_arc",
                                      "camera_lens",
                                      "camera_shutter",
                                      "camera_depth",
                                      "camera_origin",
                                      "user_force",
                                      "user_restitution",
                                      "user_friction"})
    EXPECT_NE(find_effect(name), nullptr) << name;
}

/// Of two that replace the same part of the model the first in the list.
TEST(RecordList, EffectsCombineInAnyOrder) {
  std::string forward, backward;
  std::set<std::string_view> claimed;
  for (const EffectRecord* effect : all_effects()) {
    if (!effect->claims.empty() && !claimed.insert(effect->claims).second) continue;
    forward += example_of(*effect);
    backward = example_of(*effect) + backward;
  }
  const Physics one = physics_of(parse_setup(forward, "forward", all_effects()));
  const Physics other = physics_of(parse_setup(backward, "backward", all_effects()));
  for (const ContactClass kind : {ContactClass::grain_grain, ContactClass::end_wall, ContactClass::side_wall})
    EXPECT_EQ(one.contact.friction_of(kind, Vec3(0.1, 0, 0)),
              other.contact.friction_of(kind, Vec3(0.1, 0, 0)));
  EXPECT_EQ(one.box_mass, 0.444);
  EXPECT_EQ(one.box.constant.sum(), 0.1 * 0.444) << "an acceleration acts on the added mass too";
  for (const ContactClass kind : {ContactClass::grain_grain, ContactClass::end_wall, ContactClass::side_wall})
    EXPECT_EQ(one.contact.restitution_at(kind, 0.1), other.contact.restitution_at(kind, 0.1));
  EXPECT_EQ(one.contact.restitution_at(ContactClass::side_wall, 0.3), 0.6)
      << "the side walls' own value at the reference speed";
  EXPECT_EQ(one.box.constant.sum(), other.box.constant.sum());
  EXPECT_EQ(one.box.harmonics.at(0).amplitude, other.box.harmonics.at(0).amplitude);
}

TEST(RecordList, KeysHaveTheirUnits) {
  EXPECT_EQ(unit_of_key("box.length", all_effects()), "mm");
  EXPECT_EQ(unit_of_key("grain_cohesion.force", all_effects()), "mN");
  EXPECT_EQ(unit_of_key("constant_acceleration.acceleration.x", all_effects()), "m/s^2");
  EXPECT_EQ(unit_of_key("grain_friction.grain_grain&grain_friction.grain_wall", all_effects()), "");
  EXPECT_EQ(unit_of_key("spring.frequency&box.length", all_effects()), "Hz");
  EXPECT_EQ(unit_of_key("nothing.at_all", all_effects()), "");
}

TEST(RecordList, TwoArrangementsNameBothLines) {
  try {
    parse_setup(
        "[release]\npacking = \"fcc\"\n[[effect]]\nname = \"initial_packing\"\npacking = \"square\"\n",
        "s.toml", all_effects());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "s.toml:4:8: initial_packing: sets what release.packing at s.toml:2 sets too; keep one of the two");
  }
}

TEST(RecordList, ForcesHaveTheSignsOfTheirFormulas) {
  const auto physics_with = [](const std::string& key, const std::string& value) {
    const std::vector<Override> overrides{{key, value}};
    return physics_of(parse_setup("", "s", all_effects(), overrides));
  };
  EXPECT_EQ(physics_with("blade_viscous_damping.damping", "0.05 N s/m").box.viscous.sum(), 0.05);
  EXPECT_EQ(physics_with("clamp_dry_friction.force", "20 mN").box.dry_friction.sum(), 0.02);
  const Physics drag = physics_with("blade_quadratic_drag.drag", "0.5 N s^2/m^2");
  EXPECT_EQ(drag.box.free.at(0).newton(0, 2, 0), -2);
  EXPECT_EQ(drag.box.free.at(0).newton(0, -2, 0), 2);
  EXPECT_DOUBLE_EQ(physics_with("spring_cubic.coefficient", "0.04").spring_cubic * 0.1075 * 0.1075, 0.04);
  const Physics gravity = physics_with("constant_acceleration.acceleration.x", "0.2 m/s^2");
  EXPECT_EQ(gravity.grains.constant.sum(), Vec3(0.2, 0, 0));
  EXPECT_DOUBLE_EQ(gravity.box.constant.sum(), 0.434 * 0.2);
  EXPECT_EQ(physics_with("constant_acceleration.acceleration.y", "0.2 m/s^2").box.constant.sum(), 0);
  const std::vector<Override> jitter{
      {"oscillating_acceleration.amplitude", "[\"0.1 m/s^2\", \"0 m/s^2\", \"0.3 m/s^2\"]"},
      {"oscillating_acceleration.frequency", "7 Hz"},
      {"oscillating_acceleration.phase", "90 deg"}};
  const Physics shaken = physics_of(parse_setup("", "s", all_effects(), jitter));
  EXPECT_EQ(shaken.grains.harmonics.at(0).amplitude, Vec3(0.1, 0, 0.3));
  EXPECT_DOUBLE_EQ(shaken.box.harmonics.at(0).amplitude, 0.0434);
  EXPECT_DOUBLE_EQ(shaken.box.harmonics.at(0).phase, 1.5707963267948966);
  EXPECT_EQ(physics_with("initial_box_velocity.velocity", "2 cm/s").initial_box_velocity, 0.02);
  EXPECT_EQ(physics_with("blade_arc.blade_length", "590 mm").grains.arc_length, 0.59);
  EXPECT_EQ(physics_with("camera_arc.blade_length", "590 mm").camera.arc_length, 0.59);
  EXPECT_EQ(physics_with("camera_time_offset.offset", "2 ms").camera.time_offset, 0.002);
}

TEST(RecordList, PolydisperseGrainsKeepTheirTotalMass) {
  const std::vector<Override> overrides{{"grain_polydispersity.relative_deviation", "0.05"}};
  const shakedown::Setup setup = parse_setup("", "s", all_effects(), overrides);
  const State one = initial_state(setup, 0), other = initial_state(setup, 1);
  double mass = 0, spread = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    mass += one.mass[i];
    spread += std::pow(one.radius[i] / 0.005 - 1, 2);
    WITHIN(one.mass[i] / std::pow(one.radius[i], 3), one.mass[0] / std::pow(one.radius[0], 3), 3e-10,
           1.5e-11);
    EXPECT_LE(std::abs(one.radius[i] / 0.005 - 1), 0.125);
  }
  WITHIN(mass, 37 * 4.04e-3, 6e-16, 3.4e-17);
  WITHIN(std::sqrt(spread / 37), 0.05, 0.015, 0.0058);  // standard error
  EXPECT_NE(one.radius[0], other.radius[0]);
}

TEST(RecordList, CubicSpringNeedsADisplacement) {
  const std::vector<Override> overrides{{"spring_cubic.coefficient", "0.04"},
                                        {"release.displacement", "0 mm"}};
  EXPECT_THROW(physics_of(parse_setup("", "s", all_effects(), overrides)), InputError);
}

TEST(RecordList, ACubicSpringMayHaveAReferenceOfItsOwn) {
  const auto cubic = [](const char* displacement, const char* reference) {
    const std::vector<Override> overrides{{"spring_cubic.coefficient", "0.04"},
                                          {"spring_cubic.reference", toml_string(reference)},
                                          {"release.displacement", toml_string(displacement)}};
    return physics_of(parse_setup("", "s", all_effects(), overrides)).spring_cubic;
  };
  EXPECT_DOUBLE_EQ(cubic("50 mm", "0 mm"), 0.04 / (0.05 * 0.05));
  EXPECT_DOUBLE_EQ(cubic("50 mm", "100 mm"), 0.04 / (0.1 * 0.1));
  EXPECT_DOUBLE_EQ(cubic("0 mm", "100 mm"), 0.04 / (0.1 * 0.1));
}
