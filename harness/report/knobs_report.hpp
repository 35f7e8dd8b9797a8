// SPDX-License-Identifier: MIT
#pragma once
#include "last_fit.hpp"
#include "report_knobs.hpp"
#include "turned_numbers.hpp"

namespace shakedown {

/// Make the knobs of a page from what was made for them; empty numbers: none.
ReportKnobs knobs_of(const TurnedModel& model, const LastFit& fit, const Setup& amended);
ReportKnobs knobs_of(const std::vector<TurnedNumber>& numbers, const LastFit& fit, const Setup& amended);

}  // namespace shakedown
