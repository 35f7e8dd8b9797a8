// SPDX-License-Identifier: MIT
// What is known to within an error only is not the model's mistake, whichever command judges it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "climbed.hpp"
#include "compared.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "fitted.hpp"
#include "measurements.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

/// The paper's damper, let go 0.8 mm farther out than its owner says (a hand's usual error is half a
/// millimetre), with a box 0.6 % heavier than was weighed (usually 0.3 %).
struct LetGoFartherOut {
  std::unique_ptr<Engine> engine = engine_named("hard");
  shakedown::Setup believed = parse_setup("[run]\nduration = \"3 s\"\n", "believed", all_effects());
  Measurement measurement = [&] {
    const auto truly = with_overrides(
        believed,
        std::vector<Override>{{"release.displacement", "\"108.3 mm\""}, {"box.mass", "\"436.6 g\""}},
        all_effects());
    return measurement_of(believed,
                          make_measurements(truly, runs_of_lengths({0.065, 0.104}), {},
                                            {engine.get(), all_effects(), 5, 2, nullptr}),
                          all_effects());
  }();
};

}  // namespace

TEST(SlowJudgedWithinErrors, AComparisonAllowsForWeighingAndForTheHandThatLetsGo) {
  const LetGoFartherOut film;
  const Compared compared = compared_with(film.believed, film.measurement, *film.engine, {64, {2}, {}});
  EXPECT_NE(compared.judgement.standing, Standing::fails) << compared.judgement.reason;
  EXPECT_GT(compared.fit.p_value, 0.01);
  EXPECT_NE(compared_text(compared).find("box.mass"), std::string::npos);
  EXPECT_NE(compared_json(compared).find("\"known_to\""), std::string::npos);
}

TEST(SlowJudgedWithinErrors, SoDoesALadder) {
  const LetGoFartherOut film;
  const std::vector<Rung> rungs =
      climbed({{"believed", film.believed}}, film.measurement, *film.engine, {64, false, {2}, {}});
  ASSERT_EQ(rungs.size(), 1u);
  EXPECT_GT(rungs[0].fit.p_value, 0.01);
}

TEST(SlowJudgedWithinErrors, SoDoesAFit) {
  const LetGoFartherOut film;
  FitOptions options = usual_fit_options();
  options.count = 80;
  options.execution.threads = 2;
  const Fit fit =
      fitted_and_judged(film.believed, film.measurement, {"restitution.grain_grain"}, *film.engine, options);
  EXPECT_GT(fit.p_value, 0.01);
  // A release that is not free is told as a scale of the camera that is nine standard errors off.
  const auto scale = std::find_if(fit.beside.begin(), fit.beside.end(),
                                  [](const NuisanceFound& one) { return one.name == "camera_scale.scale"; });
  ASSERT_NE(scale, fit.beside.end());
  EXPECT_LT(std::abs(scale->value), 3 * scale->error);
  ASSERT_EQ(fit.parameters.size(), 1u);
  EXPECT_LT(fit.parameters[0].low, 0.75);
  EXPECT_GT(fit.parameters[0].high, 0.75);
}
