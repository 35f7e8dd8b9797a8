// SPDX-License-Identifier: MIT
// What a blind suite hides, and how strongly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "blind_suite.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "force_likeness.hpp"
#include "force_shapes.hpp"
#include "signal_law.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

std::size_t singles_of_the_list() {
  return static_cast<std::size_t>(
      std::count_if(hideable_effects().begin(), hideable_effects().end(),
                    [](const Hideable& one) { return one.effect->acts_on != ActsOn::camera; }));
}

std::vector<BlindCase> drawn(std::uint64_t seed = 1, const BlindCounts& counts = full_counts,
                             const std::vector<double>& signals = {}) {
  SignalLaws unit;
  BlindDesign design = full_design();
  design.signals = signals;
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list) unit[hideable.id] = {1, 20};
  return draw_cases(shakedown::Setup{}, counts, design, unit, seed, all_effects());
}

/// The best that a grid over the family's constants comes to.
double likeness_to_family(const Hideable& force, const ForceShape& shape, const Trajectory& motion) {
  const shakedown::Setup setup = changed({}, at_strength(force, 1), all_effects());
  const EffectChoice& choice = setup.effects.at(0);
  std::vector<double> hidden = force_along(choice.text("force"), choice.constants("constants"), motion);
  const auto largest = [](const std::vector<double>& values) {
    return std::abs(*std::max_element(values.begin(), values.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); }));
  };
  const auto scale = [&](const ShapeParameter& parameter) {
    if (parameter.unit.empty()) return 1.0;
    return parameter.scale_of == ShapeOf::position   ? largest(motion.x_box)
           : parameter.scale_of == ShapeOf::velocity ? largest(motion.v_box)
                                                     : motion.time.back();
  };
  const auto values = [&](std::size_t k) {
    std::vector<double> grid{0};
    if (k < shape.parameters.size()) {
      grid.clear();
      for (const double start : shape.parameters[k].start) grid.push_back(start * scale(shape.parameters[k]));
    }
    return grid;
  };
  double best = 0;
  std::vector<double> offered(motion.time.size());
  for (const double first : values(0))
    for (const double second : values(1)) {
      for (std::size_t i = 0; i < offered.size(); ++i) {
        const double x = motion.x_box[i], v = motion.v_box[i], t = motion.time[i];
        const auto g = [&](double argument) { return shape.value(argument, {first, second}); };
        switch (shape.of) {
          case ShapeOf::position: offered[i] = g(x); break;
          case ShapeOf::damping_at_x: offered[i] = -v * g(x); break;
          case ShapeOf::velocity: offered[i] = g(v); break;
          case ShapeOf::damping_at_t: offered[i] = -v * g(t); break;
          case ShapeOf::stiffness_at_t: offered[i] = -x * g(t); break;
          case ShapeOf::time: offered[i] = g(t); break;
          case ShapeOf::friction_at_x: offered[i] = (v > 0 ? -1 : 1) * g(x); break;
        }
      }
      best = std::max(best, force_likeness(hidden, offered, motion.x_box));
    }
  return best;
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

TEST(Hideable, EveryEffectOfTheListThatADiagnosisLooksForCanBeHiddenWhereItStandsAlone) {
  std::set<std::string_view> hideable, searched;
  for (const Hideable& one : hideable_effects()) {
    hideable.insert(one.effect->name);
    EXPECT_EQ(find_hideable(one.id), &one);
  }
  for (const EffectRecord* record : all_effects())
    if (search_of(*record).not_searched.empty() && record->needs.empty()) searched.insert(record->name);
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
  EXPECT_EQ(names.size(), 464u);
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
  int as_believed = 0, with_any = 0;
  for (const BlindCase& one : drawn()) {
    const std::vector<std::string> hidden = hidden_effects(one.trial.hidden);
    const bool others = has_other_parameters(one.trial.hidden);
    if (one.kind == BlindKind::null || one.kind == BlindKind::parameters) {
      EXPECT_EQ(others, one.kind == BlindKind::parameters) << one.name;
    } else if (one.kind != BlindKind::films) {  // where masses are off
      ++with_any, as_believed += !others;
    }
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
  WITHIN_ERRORS(as_believed / double(with_any), 0.25, 4, std::sqrt(0.25 * 0.75 / with_any), 0.026);
}

TEST(BlindCases, DampersAreEachAnotherOneThatTheModelRuns) {
  const auto hard = engine_named("hard");
  std::set<int> counts;
  int one_length = 0, driven = 0, nothing = 0;
  for (const BlindCase& one : drawn(3, {0, 0, 0, 0, 0, 0, 0, 0, 24})) {
    const HiddenCase& hidden = one.trial.hidden;
    counts.insert(hidden.believed.grains.count);
    EXPECT_EQ(hidden.believed.grains.count, hidden.truth.grains.count);
    EXPECT_EQ(hidden.believed.release.displacement, hidden.truth.release.displacement);
    driven += !hidden.believed.effects.empty();
    one_length += one.trial.runs.size() == 2;
    nothing += one.ids.empty();
    EXPECT_EQ(hidden_effects(hidden).size(), one.ids.size()) << one.name;
    for (const PlannedRun& run : one.trial.runs) {
      shakedown::Setup setup = changed(hidden.believed, run.overrides, all_effects());
      setup.run.duration = 0.02;
      EXPECT_NO_THROW(hard->run(setup)) << one.name << " " << run.name;
    }
  }
  EXPECT_GT(counts.size(), 12u);
  EXPECT_EQ(one_length, 8);
  EXPECT_EQ(driven, 8);
  EXPECT_EQ(nothing, 6);
}

/// Along the plain damper's motion, by grids of constants as the search begins with.
TEST(Hideable, SevenForcesInNoListAreOfNoDictionaryEither) {
  const auto hard = engine_named("hard");
  shakedown::Setup setup;
  setup.run.duration = 8;
  const Trajectory motion = hard->run(setup);
  int of_none = 0;
  for (const Hideable& force : hideable_forces()) {
    of_none += !force.of_the_dictionary;
    const bool offered =
        std::any_of(force_shapes().begin(), force_shapes().end(),
                    [&](const ForceShape& shape) { return likeness_to_family(force, shape, motion) > 0.95; });
    EXPECT_TRUE(force.of_the_dictionary || !offered) << force.id;
    if (force.id == "force:hysteresis" || force.id == "force:rubbing spot") {
      EXPECT_TRUE(offered) << force.id;
    }
  }
  EXPECT_EQ(of_none, 7);
}

TEST(BlindCases, OneRoundMeetsEveryEffectAndFourMeetEachAtEverySignal) {
  const auto met = [](int singles) {
    std::set<std::string> effects;
    std::set<std::pair<std::string, double>> at_signals;
    for (const BlindCase& one : drawn(1, {0, 0, singles, 0, 0, 0, 0}, {3, 6, 12, 25})) {
      effects.insert(one.ids.at(0));
      at_signals.insert({one.ids.at(0), one.signal_to_noise});
    }
    return std::pair(effects.size(), at_signals.size());
  };
  const std::size_t all = singles_of_the_list();
  EXPECT_EQ(met(static_cast<int>(all)).first, all);
  EXPECT_EQ(met(4 * static_cast<int>(all)).second, 4 * all);
}

TEST(BlindCases, SignalsAreLogUniformWhereTheDesignNamesNone) {
  std::vector<double> logarithms;
  for (const BlindCase& one : drawn(2, {0, 0, 200, 0, 0, 0, 0}))
    if (one.signal_to_noise > 0)  // within the strongest sensible strength
      logarithms.push_back(std::log(one.signal_to_noise / weakest_signal) /
                           std::log(strongest_signal / weakest_signal));
  EXPECT_EQ(logarithms.size(), 200u);
  EXPECT_GT(uniformity_p_value(logarithms), 1e-3);
}

TEST(BlindCases, AreAtTheSignalsOfTheDesign) {
  BlindDesign design = full_design();
  design.signals = {9};
  const SignalLaws viscous{{"blade_viscous_damping", {1, 20}}};
  int met = 0;
  for (const BlindCase& one : draw_cases({}, {0, 0, 30, 0, 0, 0, 0}, design, viscous, 1, all_effects())) {
    if (one.ids.at(0) != "blade_viscous_damping") continue;
    ++met;
    WITHIN(one.signal_to_noise, 9, 4e-14, 2e-15);
  }
  EXPECT_EQ(met, 2);
}

/// A laboratory that does not model an effect hides all the others.
TEST(BlindCases, AreThoseThatTheLaboratoryCanMake) {
  const std::vector<BlindCase> all = drawn();
  const auto ids_of = [](const std::vector<BlindCase>& cases) {
    std::set<std::string> ids;
    for (const BlindCase& one : cases) ids.insert(one.ids.begin(), one.ids.end());
    return ids;
  };
  EXPECT_EQ(cases_within_reach(all, *engine_named("soft")).size(), all.size());
  const std::vector<BlindCase> by_lammps = cases_within_reach(all, *engine_named("lammps"));
  const std::set<std::string> hidden = ids_of(by_lammps);
  for (const std::string made : {"grain_friction", "grain_cohesion", "force:table", "clamp_dry_friction"})
    EXPECT_TRUE(hidden.contains(made)) << made;
  for (const std::string not_made : {"blade_arc", "velocity_dependent_restitution"}) {
    EXPECT_TRUE(ids_of(all).contains(not_made)) << not_made;
    EXPECT_FALSE(hidden.contains(not_made)) << not_made;
  }
  std::map<std::string, const BlindCase*> named;
  for (const BlindCase& one : all) named[one.name] = &one;
  for (const BlindCase& one : by_lammps) EXPECT_EQ(one.ids, named.at(one.name)->ids);
}

TEST(SignalLaw, IsAPowerOfTheStrengthAndOfTheBalanceAloneInverseToTheNoise) {
  const SignalLaw contact{3, 18, 2, false}, force{0.1, 20, 1, true};
  WITHIN(contact.signal_at(1.5, 2), 4.5, 2e-14, 1e-15);
  WITHIN(contact.strength_for(4.5, 2), 1.5, 6e-15, 3.4e-16);
  WITHIN(force.signal_at(0.2, 2), 20, 9e-14, 4.5e-15);
  WITHIN(force.strength_for(20, 2), 0.2, 9e-16, 4.5e-17);
}

TEST(SignalLaw, NoiseCountsWithTheMassesThatTheBalanceMultipliesItBy) {
  const shakedown::Setup setup;
  RecordingSettings camera;
  EXPECT_DOUBLE_EQ(relative_noise(camera, setup), 1);
  camera.box_noise *= 3, camera.centre_noise *= 3;
  WITHIN(relative_noise(camera, setup), 3, 1e-14, 6.7e-16);
  camera.centre = false;
  // 3 M s_b / hypot(M s_b, N m s_c) with M = 434 g, N m = 149.48 g, s_b = .2 mm, s_c = .5 mm
  WITHIN(relative_noise(camera, setup), 3 * 86.8 / std::hypot(86.8, 74.74), 1e-14, 5.1e-16);
}

TEST(BlindCases, StrengthsGiveTheSignalOfTheTable) {
  for (const BlindCase& one : drawn()) {
    if (one.kind != BlindKind::single || one.ids[0] != "blade_viscous_damping") continue;
    // Typical strength (0.05 N s/m) has a signal of 20 in this table.
    WITHIN(get_number(one.trial.hidden.truth, "blade_viscous_damping.damping"),
           0.05 * one.signal_to_noise / 20, 4e-16, 2e-17);
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
  WITHIN(force_likeness(cubic, force("c*x^3+5*x"), motion.x_box), 1, 9e-15, 4.5e-16);
  EXPECT_LT(force_likeness(cubic, force("-c*v"), motion.x_box), 0.05);
  // One is even about a turning point, the other odd.
  EXPECT_LT(force_likeness(cubic, force("-c*v^3"), motion.x_box), 0.05);
  // v and v^3 share 3/4 of the fundamental: cos = (3/4) / sqrt(5/8) = 0.9487.
  WITHIN(force_likeness(force("c*v"), force("c*v^3"), motion.x_box), 0.75 / std::sqrt(0.625), 5e-3, 6.9e-4);
}
