// SPDX-License-Identifier: MIT
// What a blind suite hides, and how strongly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "blind_suite.hpp"
#include "effects.hpp"
#include "force_likeness.hpp"
#include "signal_law.hpp"

using namespace shakedown;

namespace {

std::size_t singles_of_the_list() {
  return static_cast<std::size_t>(
      std::count_if(hideable_effects().begin(), hideable_effects().end(),
                    [](const Hideable& one) { return one.effect->acts_on != ActsOn::camera; }));
}

std::vector<BlindCase> drawn(std::uint64_t seed = 1, const BlindCounts& counts = full_counts) {
  SignalLaws unit;
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list) unit[hideable.id] = {1, 20};
  return draw_cases(shakedown::Setup{}, counts, full_design(), unit, seed, all_effects());
}

}  // namespace

TEST(Hideable, EveryOneCanBePutIntoASetupAtAnyStrengthUpToItsStrongest) {
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list)
      for (const double part : {0.02, 0.3, 1.0}) {
        const shakedown::Setup setup =
            changed({}, at_strength(hideable, part * hideable.strongest), all_effects());
        ASSERT_EQ(setup.effects.size(), 1u) << hideable.id;
        EXPECT_EQ(setup.effects[0].record, hideable.effect);
      }
}

TEST(Hideable, EveryEffectOfTheListThatADiagnosisLooksForCanBeHidden) {
  std::set<std::string_view> hideable, searched;
  for (const Hideable& one : hideable_effects()) {
    hideable.insert(one.effect->name);
    EXPECT_EQ(find_hideable(one.id), &one);
  }
  for (const EffectRecord* record : all_effects())
    if (search_of(*record).not_searched.empty()) searched.insert(record->name);
  EXPECT_EQ(hideable, searched);
}

TEST(Hideable, StrengthsAreTheRecordsOwn) {
  const auto value = [](const char* id, double strength, const char* key) {
    return get_number(changed({}, at_strength(*find_hideable(id), strength), all_effects()), key);
  };
  EXPECT_DOUBLE_EQ(value("blade_viscous_damping", 2, "blade_viscous_damping.damping"), 0.1);
  EXPECT_DOUBLE_EQ(value("constant_acceleration.z", 1, "constant_acceleration.acceleration.z"), 0.15);
  EXPECT_DOUBLE_EQ(value("blade_arc", 2, "blade_arc.blade_length"), 0.295);
  EXPECT_DOUBLE_EQ(value("side_wall_restitution", 2, "side_wall_restitution.restitution"), 0.36);
  EXPECT_DOUBLE_EQ(value("oscillating_acceleration", 1, "oscillating_acceleration.frequency"), 2.3);
  EXPECT_DOUBLE_EQ(value("grain_friction", 1, "grain_friction.grain_wall"), 0.2);
}

TEST(Hideable, FamiliesHoldLookAlikes) {
  const auto family = [](const char* effect) { return family_of(*find_effect(effect)); };
  EXPECT_EQ(family("blade_viscous_damping"), family("clamp_dry_friction"));
  EXPECT_EQ(family("camera_com_bias"), family("blade_mass"));
  EXPECT_NE(family("grain_friction"), family("blade_viscous_damping"));
  EXPECT_EQ(family("camera_scale"), "camera_scale");
}

TEST(BlindCases, AreAsManyOfEachKindAsAskedForUnderNamesThatTellNothing) {
  const std::vector<BlindCase> cases = drawn();
  std::map<BlindKind, int> count;
  std::set<std::string> names;
  int nulls_first = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    ++count[cases[i].kind];
    names.insert(cases[i].name);
    nulls_first += i < 60 && cases[i].kind == BlindKind::null;
  }
  EXPECT_EQ(names.size(), 404u);
  EXPECT_EQ(count[BlindKind::single], 120);
  EXPECT_EQ(count[BlindKind::twins], 20);
  EXPECT_LT(nulls_first, 25);  // 10.5 +- 2.7 expected of a shuffle
}

TEST(BlindCases, AreTheSameForTheSameSeedAndDifferentForAnother) {
  const std::vector<BlindCase> one = drawn(1), same = drawn(1), other = drawn(2);
  int differ = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(digest(one[i].trial.hidden.truth), digest(same[i].trial.hidden.truth));
    EXPECT_EQ(one[i].trial.seed, same[i].trial.seed);
    differ += digest(one[i].trial.hidden.truth) != digest(other[i].trial.hidden.truth);
  }
  EXPECT_GT(differ, 340);
}

TEST(BlindCases, HideWhatTheirKindSays) {
  std::set<std::string> singles;
  for (const BlindCase& one : drawn()) {
    const std::vector<std::string> hidden = hidden_effects(one.trial.hidden);
    EXPECT_EQ(has_other_parameters(one.trial.hidden), one.kind != BlindKind::null) << one.name;
    EXPECT_EQ(hidden.size(), one.ids.size()) << one.name;
    if (one.kind == BlindKind::single) singles.insert(one.ids.at(0));
    const bool fits = one.kind == BlindKind::pair       ? hidden.size() == 2
                      : one.kind == BlindKind::unlisted ? hidden.at(0) == "unknown"
                      : one.kind == BlindKind::camera   ? hidden.at(0).starts_with("camera")
                                                        : hidden.size() < 2;
    EXPECT_TRUE(fits) << one.name;
    EXPECT_EQ(one.twin.empty(), one.kind != BlindKind::twins);
  }
  EXPECT_EQ(singles.size(), singles_of_the_list());
}

TEST(BlindCases, OneRoundMeetsEveryEffectAndFourMeetEachAtEverySignal) {
  const auto met = [](int singles) {
    std::set<std::string> effects;
    std::set<std::pair<std::string, double>> at_signals;
    for (const BlindCase& one : drawn(1, {0, 0, singles, 0, 0, 0, 0})) {
      effects.insert(one.ids.at(0));
      at_signals.insert({one.ids.at(0), one.signal_to_noise});
    }
    return std::pair(effects.size(), at_signals.size());
  };
  const std::size_t all = singles_of_the_list();
  EXPECT_EQ(met(static_cast<int>(all)).first, all);
  EXPECT_EQ(met(4 * static_cast<int>(all)).second, 4 * all);
}

TEST(BlindCases, AreAtTheSignalsOfTheDesign) {
  BlindDesign design = full_design();
  design.signals = {9};
  const SignalLaws viscous{{"blade_viscous_damping", {1, 20}}};
  int met = 0;
  for (const BlindCase& one : draw_cases({}, {0, 0, 30, 0, 0, 0, 0}, design, viscous, 1, all_effects())) {
    if (one.ids.at(0) != "blade_viscous_damping") continue;
    ++met;
    EXPECT_NEAR(one.signal_to_noise, 9, 1e-12);
  }
  EXPECT_EQ(met, 2);
}

TEST(SignalLaw, IsAPowerOfTheStrengthAndOfTheBalanceAloneInverseToTheNoise) {
  const SignalLaw contact{3, 18, 2, false}, force{0.1, 20, 1, true};
  EXPECT_NEAR(contact.signal_at(1.5, 2), 4.5, 1e-12);
  EXPECT_NEAR(contact.strength_for(4.5, 2), 1.5, 1e-12);
  EXPECT_NEAR(force.signal_at(0.2, 2), 20, 1e-12);
  EXPECT_NEAR(force.strength_for(20, 2), 0.2, 1e-12);
}

TEST(SignalLaw, NoiseCountsWithTheMassesThatTheBalanceMultipliesItBy) {
  const shakedown::Setup setup;
  RecordingSettings camera;
  EXPECT_DOUBLE_EQ(relative_noise(camera, setup), 1);
  camera.box_noise *= 3, camera.centre_noise *= 3;
  EXPECT_NEAR(relative_noise(camera, setup), 3, 1e-12);
  camera.centre = false;
  // 3 M s_b / hypot(M s_b, N m s_c) with M = 434 g, N m = 149.48 g, s_b = .2 mm, s_c = .5 mm
  EXPECT_NEAR(relative_noise(camera, setup), 3 * 86.8 / std::hypot(86.8, 74.74), 1e-6);
}

TEST(BlindCases, StrengthsGiveTheSignalOfTheTable) {
  for (const BlindCase& one : drawn()) {
    if (one.kind != BlindKind::single || one.ids[0] != "blade_viscous_damping") continue;
    // Typical strength (0.05 N s/m) has a signal of 20 in this table.
    EXPECT_NEAR(get_number(one.trial.hidden.truth, "blade_viscous_damping.damping"),
                0.05 * one.signal_to_noise / 20, 1e-12);
  }
}

TEST(BlindCases, AVariantIsTheSameDesignRecordedWorse) {
  const BlindDesign design = full_design();
  EXPECT_EQ(varied(design, "one-repeat").runs.size(), 4u);
  EXPECT_EQ(varied(design, "two-lengths").runs.size(), 2u);
  EXPECT_EQ(varied(design, "two-lengths").runs.back().name, "L104");
  EXPECT_EQ(varied(design, "half-duration").runs.front().overrides.back().value, "\"10 s\"");
  EXPECT_EQ(varied(design, "250fps").recording.frame_rate, 250);
  EXPECT_FALSE(varied(design, "no-centre").recording.centre);
  EXPECT_THROW(varied(design, "no-camera"), InputError);
  for (const std::string_view name : variant_names) EXPECT_NO_THROW(varied(design, name));
}

TEST(BlindCases, CountsAreReadOrRefusedWithTheReason) {
  EXPECT_EQ(parse_counts("singles=3, nulls=2"), (BlindCounts{2, 0, 3, 0, 0, 0, 0}));
  EXPECT_THROW(parse_counts("single=3"), InputError);
  EXPECT_THROW(parse_counts("singles=many"), InputError);
}

TEST(ForceLikeness, IsThatOfTheShapeWithoutItsLinearPart) {
  Trajectory motion;
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.005 * i;
    motion.time.push_back(t);
    motion.x_box.push_back(0.1 * std::cos(7 * t));
    motion.v_box.push_back(-0.7 * std::sin(7 * t));
  }
  const auto force = [&](const char* formula) { return force_along(formula, {{"c", 2.0}}, motion); };
  const std::vector<double> cubic = force("-c*x^3");
  EXPECT_NEAR(force_likeness(cubic, force("c*x^3+5*x"), motion.x_box), 1, 1e-9);
  EXPECT_LT(force_likeness(cubic, force("-c*v"), motion.x_box), 0.05);
  // One is even about a turning point, the other odd.
  EXPECT_LT(force_likeness(cubic, force("-c*v^3"), motion.x_box), 0.05);
  // v and v^3 share 3/4 of the fundamental: cos = (3/4) / sqrt(5/8) = 0.9487.
  EXPECT_NEAR(force_likeness(force("c*v"), force("c*v^3"), motion.x_box), 0.75 / std::sqrt(0.625), 5e-3);
}
