// SPDX-License-Identifier: MIT
// A law of restitution that no list has, in films of soft contacts: what the model foretells of a box that it
// was not fitted to, without and with a curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "effects.hpp"
#include "engines.hpp"
#include "fitted.hpp"
#include "measurements.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

constexpr const char* rising = "0.85-0.35*exp(-v/0.15)";

double truth(double speed) { return 0.85 - 0.35 * std::exp(-speed / 0.15); }

}  // namespace

TEST(SlowFreeRestitution, ForetellsALengthThatItWasNotFittedTo) {
  const std::unique_ptr<Engine> soft = engine_named("soft"), hard = engine_named("hard");
  const auto believed = parse_setup("[run]\nduration = \"6 s\"\n", "believed", all_effects());
  const auto truly = with_overrides(
      believed, std::vector<Override>{{"user_restitution.restitution", "\"" + std::string(rising) + "\""}},
      all_effects());
  const Measurement films = measurement_of(believed,
                                           make_measurements(truly, runs_of_lengths({0.040, 0.065, 0.085}),
                                                             {}, {soft.get(), all_effects(), 3, 2, nullptr}),
                                           all_effects());
  FitOptions options = usual_fit_options();
  options.on = {"L040", "L085"};
  options.execution.threads = 2;
  options.count = 120;  // four times the terms of the regression
  const std::string free = "restitution.grain_grain&restitution.grain_wall,spring.frequency";
  const Fit without = fitted_and_judged(believed, films, {free}, *hard, options),
            with = fitted_and_judged(believed, films, {free, "all"}, *hard, options);
  ASSERT_EQ(with.left_out.size(), 1u);
  EXPECT_LT(with.left_out[0].error_box, without.left_out[0].error_box / 2);
  EXPECT_LT(with.left_out[0].error_box, 2 * with.left_out[0].floor_box);
  EXPECT_LT(with.scatter, 0.7 * without.scatter);
  ASSERT_EQ(with.curves.size(), 1u);
  // Where most of the energy goes the band is to have the truth; three standard errors.
  const ContactCurve& curve = with.curves[0];
  for (std::size_t i = 0; i < curve.speed.size(); ++i) {
    if (curve.speed[i] < 0.05 || curve.speed[i] > 0.6) continue;
    EXPECT_LT(std::abs(curve.grains.value[i] - truth(curve.speed[i])), 3 * curve.grains.error[i])
        << curve.speed[i];
  }
  EXPECT_NE(fit_json(with).find("\"restitution_curve\""), std::string::npos);
  const Report page = report_of(with, believed, films, *hard, {2, nullptr});
  EXPECT_TRUE(std::any_of(page.sections.begin(), page.sections.end(), [](const ReportSection& section) {
    return section.title == "Restitution against closing speed" && section.plots.size() == 2;
  }));
  EXPECT_NE(fit_text(with).find("restitution rises from"), std::string::npos);
  EXPECT_NE(fit_text(with).find(
                "the measurements tell that restitution depends on the closing speed: a constant fails"),
            std::string::npos);
}
