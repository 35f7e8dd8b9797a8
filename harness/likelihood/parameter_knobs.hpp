// SPDX-License-Identifier: MIT
// Makes knobs of the parameters that every comparison varies: the two restitutions and the spring's
// frequency.
#pragma once
#include <vector>

#include "emulator.hpp"
#include "known_effects.hpp"
#include "known_value.hpp"

namespace shakedown {

/// How far restitutions (absolute) and the spring's frequency (relative) of two codes of the same physics may
/// lie apart before their motions do: contacts of 0.3 ms instead of none move the slope of the decay by 0.7
/// %, as much as 0.004 in both restitutions. (What matches the whole motion best, grain_grain less by 0.007
/// and grain_wall more by 0.015, lies along the valley of the two.)
constexpr double code_restitution = 0.004, code_frequency = 1e-4;

/// Returns a knob for a number that is known to an error and whose columns are known (Knob::exact), about
/// what was said of it.
Knob exact_knob(const std::string& key, double value, double deviation);

/// Standard deviation of the user's restitutions beforehand: it decides only along valleys that the data
/// leave open. Restitutions of .42 and .94 imitate friction of .3 between grains of .75 and .76 to within 3 %
/// of chi2.
constexpr double believed_restitution = 0.1;

/// Returns knobs for the parameters as given. They may be off by what two codes of the same physics disagree
/// on their meaning and, where [known] gives an error, by that too. In a box with grains numbers of `effects`
/// that [known] gives with an error are among them.
std::vector<Knob> as_given(const Setup& setup, const std::vector<KnownValue>& known = {},
                           KnownEffects effects = {});

/// Returns knobs for what a user may refit, about the setup's values; the spring's about `frequency` (Hz),
/// which the momentum balance may know better, within +- width (Hz). The second takes the setup's own
/// frequency and 1 % of it.
std::vector<Knob> free_parameters(const Setup& setup, double frequency, double width);
std::vector<Knob> free_parameters(const Setup& setup);

/// Returns the knobs with what [known] says of them as what is believed; what it knows exactly is no knob any
/// more. Numbers of `effects` that it gives with an error are added.
std::vector<Knob> believed(std::vector<Knob> knobs, const std::vector<KnownValue>& known,
                           KnownEffects effects = {});

}  // namespace shakedown
