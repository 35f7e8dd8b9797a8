// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "execution.hpp"
#include "fit.hpp"
#include "report.hpp"

namespace shakedown {

/// Returns the options of every fit: all effects of the list.
FitOptions usual_fit_options();

/// Says what is to be fitted: keys ("restitution.grain_grain,spring.frequency"; those joined by & move
/// together), and restitution or friction as a free function of a speed, of these contacts
/// (contact_curve.hpp; empty: not).
struct FitQuestion {
  std::string free, restitution_curve{}, friction_curve{};
};

/// Throws InputError for what cannot be fitted.
void check(const FitQuestion& asked, const Setup& setup);

/// Fits what is asked and judges the fitted model: boxes without grains by their waveform, others by their
/// features and the momentum balance. A curve that falls here and rises there is fitted again as one that
/// only falls, or only rises. `recorded`: as the films show it. Throws InputError for what cannot be fitted,
/// Interrupted.
Fit fitted_and_judged(const Setup& setup, const Measurement& recorded, const FitQuestion& asked,
                      const Engine& engine, const FitOptions& options);

/// Returns the page; its curves, each run without grains from its first turn on, and what its knobs do are
/// simulated here. Throws Interrupted.
Report report_of(const Fit& fit, const Setup& given, const Measurement& recorded, const Engine& engine,
                 const Execution& execution);

}  // namespace shakedown
