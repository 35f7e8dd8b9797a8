// SPDX-License-Identifier: MIT
#pragma once
#include "report.hpp"
#include "restitution_curve.hpp"

namespace shakedown {

/// Restitution against closing speed of no assumed form, a plot of grains and one of walls with their bands.
ReportSection restitution_section(const RestitutionCurve& curve);

}  // namespace shakedown
