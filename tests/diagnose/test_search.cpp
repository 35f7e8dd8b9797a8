// SPDX-License-Identifier: MIT
// One round of the search beside a model that is far off, on a stand-in whose motion is a formula: what it
// adds while simulations suffice, and what it says where they do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects.hpp"
#include "formula_engine.hpp"
#include "random.hpp"
#include "rival.hpp"
#include "rules.hpp"
#include "setup_file.hpp"
#include "state.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

double strength(const Setup& setup, std::string_view effect, std::string_view parameter) {
  for (const EffectChoice& choice : setup.effects)
    if (choice.record->name == effect) return choice.number(parameter);
  return 0;
}

/// A decay by the restitutions, which a law of restitution slows with time, and drag speeds up; two shapes of
/// chaos.
class StandIn final : public FormulaEngine {
 public:
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    Random random(setup.run.seed, static_cast<std::uint64_t>(options.run), Stream::velocities);
    const double early = 3e-4 * random.normal(), late = 3e-4 * random.normal();
    const double w = 2 * std::numbers::pi * setup.spring.frequency,
                 rate = 0.3 * (1 - setup.restitution.grain_grain),
                 law = strength(setup, "velocity_dependent_restitution", "exponent"),
                 drag = strength(setup, "grain_air_drag", "linear") / 1e-3;
    return sampled(setup, 500, [&](double t) {
      const double turned = law * std::sin(1.1 * t), faster = 0.02 * drag * std::sin(0.5 * t);
      const double x = 0.1 * std::exp(-(rate + faster) * t) * std::cos(w * t + turned);
      return std::pair(x + early * std::sin(1.3 * t) + late * std::sin(0.7 * t + 1),
                       0.9 * x + 0.01 * setup.restitution.grain_wall + late * std::cos(2 * t));
    });
  }
};

Setup as_believed() {
  Setup setup;
  setup.run.duration = 8;
  return setup;
}

/// Two films of a law, and of drag (in typical ones), that are not in what is believed.
Measurement two_films(double drag) {
  Setup truth = as_believed();
  const EffectRecord& law = *all_effects().find("velocity_dependent_restitution");
  truth.effects.push_back(with_defaults(law));
  truth.effects.back().values["exponent"] = 0.12;
  if (drag > 0) {
    truth.effects.push_back(with_defaults(*all_effects().find("grain_air_drag")));
    truth.effects.back().values["linear"] = 1e-3 * drag;
  }
  Experiment experiment;
  for (const int number : {1, 2}) {
    MeasuredRun run;
    run.name = number == 1 ? "a" : "b";
    run.frame_rate = 500;
    RunOptions options;
    options.run = 1000 + number;
    const Trajectory seen = StandIn{}.run(truth, options);
    Random noise(7, static_cast<std::uint64_t>(number), Stream::camera);
    run.time = seen.time, run.x_box = seen.x_box, run.x_com = seen.x_com;
    for (double& x : run.x_box) x += 1e-4 * noise.normal();
    for (double& x : run.x_com) x += 1e-4 * noise.normal();
    experiment.runs.push_back(run);
  }
  return measurement_of({as_believed(), as_believed()}, experiment);
}

/// A diagnosis that may take so many simulations, after a refit of the parameters, which takes 704.
struct Refitted {
  Measurement measurement;
  StandIn engine;
  DiagnoseOptions options;
  DiagnosisTools tools;
  DiagnosisState state;

  explicit Refitted(int budget, double drag = 0)
      : measurement(two_films(drag)),
        options{.effects = {"velocity_dependent_restitution", "grain_air_drag"},
                .budget = budget,
                .execution = {1},
                .known = all_effects(),
                .progress = {}},
        tools(measurement, engine, options) {
    state.setup = as_believed();
    state.theta = {{"restitution.grain_grain", 0.75, 0.15, 0.2, 0.999, true},
                   {"spring.frequency", 1.23, 0.01, 1, 1.5, true}};
    state.fit = tools.fit(state, "refitting", state.knobs(), effort::refit);
    if (drag == 0) {
      EXPECT_EQ(tools.runs(), 704);
    }
    EXPECT_TRUE(is_far_off(state.fit));
  }
};

SearchRound searched(int budget, double drag = 0) {
  Refitted refitted(budget, drag);
  refitted.tools.limit_to(rules::for_the_search);
  return search_round(refitted.state, refitted.tools, {});
}

using Names = std::vector<std::string>;

/// The law was added, and the data accept it.
void expect_the_law(const SearchRound& round) {
  EXPECT_TRUE(round.added);
  EXPECT_EQ(round.next.missing, Names{"velocity_dependent_restitution"});
  EXPECT_GT(round.next.fit.p_value, rules::holds);
  ASSERT_FALSE(round.next.found.empty());
  const double exponent = round.next.found.front().centre;
  WITHIN(exponent, 0.12, 6e-4, 6.1e-5);
  EXPECT_EQ(round.table.front().effects, Names{"velocity_dependent_restitution"});
}

}  // namespace

TEST(Search, BesideAModelThatIsFarOffFitsShortlyAndThenWhatHolds) {
  const SearchRound round = searched(1800);
  expect_the_law(round);
  EXPECT_TRUE(round.notes.empty());
  EXPECT_TRUE(round.not_tried.empty());
}

TEST(Search, AShortFitStandsWhereSimulationsSufficeForNoMore) {
  const SearchRound round = searched(1100);
  expect_the_law(round);
  ASSERT_EQ(round.notes.size(), 1u);
  EXPECT_NE(round.notes.front().find("no time for more than a short fit"), std::string::npos);
}

TEST(Search, AFitOfOneMoreBeginsAtWhatItsSignatureAsksFor) {
  Refitted refitted(1000);
  Candidate law;
  law.effect = "velocity_dependent_restitution";
  law.knobs = {{"velocity_dependent_restitution.exponent", 0, 0.01, 0, 0.5}};
  law.dear = true;
  Rival rival{&law, {}};
  rival.screened.value = 0.1;
  const DiagnosisState with = with_rival(refitted.state, rival, refitted.tools);
  EXPECT_EQ(with.missing, Names{law.effect});
  EXPECT_TRUE(with.dear);
  ASSERT_EQ(with.found.size(), 1u);
  EXPECT_EQ(with.found.front().centre, 0.1);
  EXPECT_EQ(with.found.front().width, 0.05);  // half of it to either side
  EXPECT_EQ(get_number(with.setup, law.knobs.front().key, all_effects()), 0.1);
}

TEST(Search, TwoThatTheDataRejectEachAloneAreFittedTogether) {
  const SearchRound round = searched(20000, 3);
  EXPECT_TRUE(round.added);
  EXPECT_EQ(round.next.missing, (Names{"velocity_dependent_restitution", "grain_air_drag"}));
  EXPECT_GT(round.next.fit.p_value, rules::holds);
}

// Less than half of the other's first look is left.
TEST(Search, WhatSimulationsDoNotSufficeForIsSaid) {
  const SearchRound round = searched(1000);
  expect_the_law(round);
  EXPECT_EQ(round.not_tried, Names{"grain_air_drag"});
}

TEST(Search, WithoutSimulationsNothingIsAddedAndAllIsAsProbableAsBefore) {
  const SearchRound round = searched(900);
  EXPECT_FALSE(round.added);
  EXPECT_FALSE(round.promised);
  EXPECT_EQ(round.not_tried, (Names{"velocity_dependent_restitution", "grain_air_drag"}));
  const bool none_is_probable = std::all_of(round.table.begin(), round.table.end(), [](const Hypothesis& h) {
    return h.effects.empty() || h.log_odds < 0;
  });
  EXPECT_TRUE(none_is_probable);
}

// The refit took two looks of 352 simulations. The last fit is worth 352, and takes 192 more where its
// solution leaves its box. While something is kept for it no fit is hasty, nor where nothing tells what it
// costs.
TEST(LastFit, TakesWhatIsLeft) {
  const auto taken = [](const Refitted& refitted, const DiagnosisState& state) {
    return refitted.tools.affordable(state, effort::conclude, effort::conclude_in_haste).count;
  };
  constexpr int needed = 704 + 352 + 192;
  Refitted enough(needed + 1), too_little(needed - 1);
  EXPECT_EQ(taken(enough, enough.state), effort::conclude.count);
  EXPECT_EQ(taken(too_little, too_little.state), effort::conclude_in_haste.count);
  DiagnosisState other = too_little.state;
  other.missing = {"grain_cohesion"};
  EXPECT_EQ(taken(too_little, other), effort::conclude.count);
  too_little.tools.limit_to(rules::for_the_search);
  EXPECT_EQ(taken(too_little, too_little.state), effort::conclude.count);
}
