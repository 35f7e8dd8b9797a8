// SPDX-License-Identifier: MIT
// What a diagnosis says in the end: verdict, sentence, parameters, the formula of an unknown force, and the
// experiment to do next.
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

/// The formula of a force that no list has, ready for a setup.
void set_formula(Diagnosis& diagnosis);

/// What the momentum balance asks for joins what was simulated; what was found first, then by gain.
void complete_ranking(Diagnosis& diagnosis);

/// Gives something in no list its probability, and keeps the hypotheses that hold 99 %, and the fewest that
/// hold 95 % as the answers.
void settle_hypotheses(Diagnosis& diagnosis, const Findings& findings);

/// Where nothing that was fitted explains the measurements, the balance of momentum (if there is one) is in
/// order, and the settled table holds one hypothesis for as probable as an effect must be to be added: what
/// was `found` and an effect that there was no time to fit. Names that hypothesis, as the verdict `missing`,
/// the effect at the strength that its signature asks for and the restitutions as given. Else nothing is
/// promised any more.
void name_promised(const Setup& user, const std::vector<std::string>& found, Diagnosis& diagnosis,
                   KnownEffects known);

/// Where the model of this fit fails.
void note_failures(const Refit& fit, Diagnosis& diagnosis);

}  // namespace shakedown
