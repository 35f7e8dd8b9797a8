// SPDX-License-Identifier: MIT
// Says where the simulations and the time of a diagnosis go, and what its cheap looks are wrong by. What
// decides between hypotheses that were fitted stands in rules.hpp.
#pragma once
#include <span>

#include "refit.hpp"
#include "rules.hpp"
#include "screen_effort.hpp"

namespace shakedown {

/// Says how closely to look: re-centrings, simulations of each different setup in a fit's last round and at
/// its solution.
struct Effort {
  int rounds, count, confirming;
  bool beside = false;  ///< a poor one looks on both sides along what is known least
  bool once = false;    ///< does not follow a solution that leaves the box
  bool whole = false;   ///< not cut where runs are dear: its intervals are the answer's
  int looks = 2;        ///< more, where the first was misled or is poor
};
/// Counts the simulations of each different setup in a fit of this effort.
constexpr int simulations_of(const Effort& effort) {
  return (effort.rounds - 1) * simulations_on_the_way(effort.count) + effort.count + effort.confirming;
}

namespace effort {
constexpr Effort look{1, 128, 0}, refit{2, 160, 128}, beside{2, 160, 128, true},
    attempt{.rounds = 2, .count = 128, .confirming = 96, .looks = 1},
    attempt_when_dear{.rounds = 1, .count = 72, .confirming = 48, .looks = 1},
    conclude{1, 192, 160, false, false, true},
    conclude_in_haste{.rounds = 1, .count = 96, .confirming = 64, .whole = true, .looks = 1},
    apart{2, 160, 128, true, false, true}, least{1, 64, 0, false, true};
constexpr int most_when_dear = 80;
constexpr std::size_t most_pairs = 2;
/// Fits whatever the odds where p is below `holds` and the misfit is no more than codes differ by: half of
/// most_tried, an assumption that spares time.
constexpr int fitted_where_poor = 2;
constexpr ScreenEffort rank{}, rank_when_dear{32, 48, 0, {8, 8, 8}, {12, 12, 12}, {24, 24, 24}};
/// Returns the same effort at the middle levels alone, where signatures say little but at which strength a
/// short fit begins.
constexpr ScreenEffort at_the_middle(ScreenEffort effort) {
  effort.middle_alone = true;
  effort.nothing_more = 0;
  return effort;
}

constexpr Rule far_off{
    "far_off", 2, "times the misfit of own runs",
    "a model as given beyond is not simulated again: 64 simulations have shown 1.8 where 128 show 1.3"};
constexpr Rule glance_sees{"glance_sees", 0.5, "of ln evidence",
                           "a glance may see half of what a second look sees: 200 where 226 was to beat"};
constexpr Rule glance_tells{
    "glance_tells", 0.25, "of the gain",
    "what a glance shows at least of a signal that decides: 12 simulations leave a noise of 35 to 45 in the "
    "square of a signature, of which even odds need 15"};
constexpr Rule well_seen{
    "well_seen", 0.8, "of the gain",
    "a signature of which the simulations' noise leaves as much is not simulated again: more would add a "
    "quarter of its gain at most"};
constexpr Rule signature_errs{
    "signature_errs", 0.1, "of ln odds",
    "what a signature is wrong by far from nothing: 456 where three times the simulations saw 476, 2557 for "
    "dry friction where that of Dahl, the same on that film, had 2608"};
constexpr Rule hopeless{
    "hopeless", 100, "ln likelihood below nothing's",
    "a stronger level of the same sign would have to turn by more than 60 degrees to explain what this one "
    "does not"};
constexpr Rule moves_along{
    "moves_along", 0.5, "widths of the fit's box",
    "parameters that a level moves farther are moved there: slopes err by the square of it, a quarter of "
    "what they err by at the edge (an assumption); 12 simulations move them by 0.2 by chance"};
constexpr Rule short_fits_differ{
    "short_fits_differ", 0.07, "of what they left",
    "64 simulations about one strength and about another left 693 and 730, 3405 and 3730: by 5 and 9 %"};
constexpr Rule short_fits_err{"short_fits_err", 1.3, "times what the best of them left",
                              "more than three times what they differ by for no reason: a short fit may have "
                              "missed the best strength"};
constexpr Rule astray{
    "astray", 2, "errors of what is believed",
    "the restitutions of a doubtful model beyond are not where effects are looked for: what a 95 % interval "
    "leaves out"};
}  // namespace effort

/// Shares of simulations and time that may be spent up to the end of a step: the search for effects is to
/// have its part though the model without them is dear (its restitutions take up what is missing, and low
/// ones cost several times a plain run). What decides that nothing is left for it is rules::for_the_search.
namespace share {
constexpr double model_as_given = 0.2, first_refit = 0.45;
/// For what release and masses are uncertain by, whatever came before: without it effects take that up. An
/// assumption: five films took 2 to 8 % of 300 s of two busy cores.
constexpr double errors_of_the_damper = 0.05;
/// For the choice of the engine: with the wrong one all that follows is in vain. An assumption: 20 % of 240 s
/// of a core were too little for five films of seventeen grains.
constexpr double engine_choice = 0.35;
/// Leaves the fit a part of the round, since a signature alone names nothing.
constexpr double ranking_of_a_round = 0.5;
/// Where signatures say little, they leave time for short fits of each effect, and these for the fits that
/// they choose (assumptions).
constexpr double ranking_when_far_off = 0.3, short_fits_of_the_rest = 0.5, short_fits_while_none_holds = 0.8;
}  // namespace share

/// Returns the rules of namespace effort, in this order.
std::span<const Rule> effort_rules();

}  // namespace shakedown
