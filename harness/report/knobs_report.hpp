// SPDX-License-Identifier: MIT
#pragma once
#include "last_fit.hpp"
#include "report_knobs.hpp"
#include "turned_model.hpp"

namespace shakedown {

/// The knobs of a page from what was made for them; empty numbers: none.
ReportKnobs knobs_of(const TurnedModel& model, const LastFit& fit, const Setup& amended);
ReportKnobs knobs_of(const std::vector<TurnedNumber>& numbers, const LastFit& fit, const Setup& amended);

}  // namespace shakedown
