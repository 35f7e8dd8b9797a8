// SPDX-License-Identifier: MIT
// Fills in what a diagnosis says in the end: verdict, sentence, parameters, the formula of an unknown force,
// and the experiment to do next.
#pragma once
#include "known_effects.hpp"
#include "state.hpp"
#include "verdict.hpp"

namespace shakedown {

/// Fills in all of the diagnosis that follows from its last state. `given`: the model as the user gave it,
/// fitted within what two codes differ by; `refitted`: the parameters of `final` were free and mean
/// something.
void conclude(const Setup& user, const DiagnosisState& given, const DiagnosisState& final, bool refitted,
              DiagnosisTools& tools, Diagnosis& diagnosis);

/// Fills in the formula of a force that no list has, ready for a setup, and notes what it could be as well.
void set_formula(Diagnosis& diagnosis);

/// Adds what the momentum balance asks for to the ranking of what was simulated, and sorts it: what was found
/// first, then by gain.
void complete_ranking(Diagnosis& diagnosis);

/// Gives something in no list its probability, and keeps the hypotheses that hold 99 %, and the fewest that
/// hold 95 % as the answers.
void settle_hypotheses(Diagnosis& diagnosis, const Findings& findings);

/// Names a hypothesis that there was no time to fit, as the verdict `missing`, where nothing that was fitted
/// explains the measurements, the balance of momentum (if there is one) is in order, and the settled table
/// holds that hypothesis for as probable as an effect must be to be added. It is what was `found` and one
/// effect more. The effect gets the strength that its signature asks for, the restitutions stay as given.
/// Where no hypothesis is named nothing is promised any more.
void name_promised(const Setup& user, const std::vector<std::string>& found, Diagnosis& diagnosis,
                   KnownEffects known);

/// Fills in where the model of this fit fails: twelve cells at most, of p below rules::doubtful.
void note_failures(const Refit& fit, Diagnosis& diagnosis);

}  // namespace shakedown
