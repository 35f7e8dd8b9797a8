// SPDX-License-Identifier: MIT
// Numbers with which a diagnosis decides between hypotheses that were fitted: value, unit, source. Numbers of
// its cheap looks, and of where its effort goes, stand in effort.hpp. The README of this folder lists the
// rules of both.
#pragma once
#include <span>
#include <string_view>

#include "balance_rules.hpp"
#include "judgement.hpp"

namespace shakedown {

/// Holds a number that decides something, with its unit and where it comes from.
struct Rule {
  std::string_view name;
  double value;
  std::string_view unit, source;
  constexpr operator double() const { return value; }
};

namespace rules {

constexpr Rule adds_effect{
    "adds_effect", 0.9, "probability",
    "an effect is added when the hypotheses that something more is missing hold this much: "
    "at the edge one in ten is wrong"};
constexpr Rule answer_set{
    "answer_set", 0.95, "probability",
    "the smallest set of hypotheses that holds as much is the answer, as a 95 % interval is"};
constexpr Rule expected_effects{
    "expected_effects", shakedown::expected_effects, "effects",
    "an experiment hides half an effect beforehand: as many hide something as hide "
    "nothing, rounded down"};
constexpr Rule something_else{
    "something_else", 0.02, "probability",
    "of fifty experiments one shows physics that no list has: an assumption; the p-value of the final model "
    "weighs it"};
constexpr Rule emulator_noise{
    "emulator_noise", 12.6, "chi2",
    "rms difference of the fitted gains of two effects whose signatures agree (260 null "
    "cases): what two fits differ by for no reason"};
constexpr Rule doubtful{
    "doubtful", 0.05, "p-value",
    "a model as given above needs no refit to be accepted, a fit below is looked beside, and made with full "
    "effort before more is searched; one right model in twenty lies below"};
constexpr Rule holds_well{"holds_well", 0.3, "p-value",
                          "a model as given above is not refitted: seven right models in ten pass"};
constexpr Rule holds{"holds", features_rejected, "p-value",
                     "a model below is rejected: one right model in a hundred is"};
constexpr Rule codes_differ{
    "codes_differ", shakedown::codes_differ, "chi2 over its expectation",
    "soft contacts of 0.2 to 0.43 ms judged by hard impacts of the same parameters: 1.1 to "
    "1.33"};
constexpr Rule stands_out{
    "stands_out", 3.5, "standard errors",
    "a number of the camera that is said to explain the recording; among ten such numbers one "
    "experiment in 200 has one by chance"};
constexpr Rule explains{
    "explains", 4, "floors of noise and chaos",
    "errors that an explanation leaves at most: right answers leave up to 1.5, foreign contact "
    "laws that imitate an effect 5 to 15"};
constexpr Rule most_effects{"most_effects", 3, "effects", "what a fit of some ten parameters carries"};
constexpr Rule for_the_search{"for_the_search", 0.75, "of the budget",
                              "the rest is kept for the last fit, which takes a quarter: measured"};
constexpr Rule most_tried{"most_tried", 4, "effects", "fitted in one round: cost"};

}  // namespace rules

/// Returns all of them.
std::span<const Rule> diagnosis_rules();

}  // namespace shakedown
