// SPDX-License-Identifier: MIT
// "An effect is one file and one line", for the diagnosis too: two effects that the library lacks, each added
// to the list and to nothing else, are hidden by the laboratory and looked for.
#include <gtest/gtest.h>

#include <algorithm>

#include "blind_case.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "engines.hpp"

using namespace shakedown;

namespace shakedown::effect {
extern const EffectRecord eddy_brake, felt_end_walls;
}

namespace {

std::vector<const EffectRecord*> every_effect() { return {all_effects().begin(), all_effects().end()}; }

/// Without those with which a run costs several times a plain one: they take most of a ranking's time.
std::vector<const EffectRecord*> cheap_effects() {
  std::vector<const EffectRecord*> list = every_effect();
  std::erase_if(list, [](const EffectRecord* one) { return one->search.cost != Search::Cost::plain; });
  return list;
}

/// The longest box of the blind suite and `beside` of its runs, by soft spheres, with `own` in the list of
/// effects.
Diagnosis diagnosis_of(const EffectRecord& own, const char* key, double strength, std::size_t beside,
                       std::vector<const EffectRecord*> known) {
  known.push_back(&own);
  const auto soft = engine_named("soft"), hard = engine_named("hard");
  TrialTools tools;
  tools.laboratory = soft.get();
  tools.model = hard.get();
  tools.known = known;
  tools.execution.threads = 2;
  tools.budget = 16000;  // of minutes: neither needs more
  tools.strength_uncertainty = &strength_uncertainty;
  Trial trial;
  const std::vector<PlannedRun> runs = full_design().runs;
  trial.runs = {runs[beside], runs.back()};
  trial.seed = 7;
  set_number(trial.hidden.truth, key, strength, known);
  return diagnose_trial(trial, tools);
}

}  // namespace

TEST(SlowOwnEffect, ABrakeOfTheBoxIsFound) {
  // A signal of 12: the suite's table has 20 at 0.27 N s/m, by the balance, which is proportional.
  const Diagnosis found = diagnosis_of(effect::eddy_brake, "eddy_brake.damping", 0.16, 2, every_effect());
  EXPECT_EQ(found.verdict, Verdict::missing) << found.sentence;
  EXPECT_EQ(found.missing, std::vector<std::string>{"eddy_brake"}) << found.sentence;
}

// Felt on the end walls takes energy as another restitution of the walls does: the answer names it or says
// that it cannot be ruled out, and names nothing else.
TEST(SlowOwnEffect, AContactEffectIsInQuestion) {
  // 40 mm: beside 65 mm restitutions take it up.
  const Diagnosis found =
      diagnosis_of(effect::felt_end_walls, "felt_end_walls.loss", 0.5, 0, cheap_effects());
  for (const std::string& effect : found.missing)
    EXPECT_EQ(effect, "felt_end_walls") << diagnosis_text(found);
  const bool in_question =
      std::any_of(found.answers.begin(), found.answers.end(), [](const Hypothesis& answer) {
        return std::find(answer.effects.begin(), answer.effects.end(), "felt_end_walls") !=
               answer.effects.end();
      });
  EXPECT_TRUE(in_question) << diagnosis_text(found);
}
