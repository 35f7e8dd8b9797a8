// SPDX-License-Identifier: MIT
#pragma once
#include "contact_curve.hpp"
#include "report.hpp"

namespace shakedown {

/// Shows a coefficient of the contacts against its speed, of no assumed form: a plot of grains and one of
/// walls with their bands.
ReportSection contact_curve_section(const ContactCurve& curve);

}  // namespace shakedown
