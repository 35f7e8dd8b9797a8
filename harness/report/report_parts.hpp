// SPDX-License-Identifier: MIT
// The parts with which every report ends.
#pragma once
#include <array>

#include "report.hpp"
#include "setup.hpp"
#include "trajectory.hpp"

namespace shakedown {

/// Returns the effects of a setup with their sources.
std::vector<std::string> citations_of(const Setup& setup);

/// Returns the command that is running, as one would type it.
std::string this_command();

/// Makes an empty plot over the time of a run.
ReportPlot time_plot(std::string title, std::string y_label, std::string group, std::vector<double> time);

/// Makes the curves of a band; the second carries the name.
std::vector<ReportCurve> band(std::string name, std::vector<double> low, std::vector<double> high);

/// Plots the energy of box and grains over time, mJ: what is left, what each class of contact took, and what
/// effects took, so that all of it adds up to what there was at the beginning. Classes that took nothing are
/// left out.
ReportPlot energy_plot(std::string group, std::vector<double> time, std::vector<double> left,
                       const std::array<std::vector<double>, contact_classes>& lost);

/// The numbers of bars as a table opened by a click; `more` columns follow, a cell a line.
struct MoreColumn {
  std::string title;
  std::vector<std::string> cells;
};
/// Returns the table, a row a line of the bars. Each of `more` must have a cell for every line.
ReportTable numbers_of(const ReportBars& bars, std::string first_column, const std::vector<MoreColumn>& more);

/// Returns the larger errors and overlap of both, the sums of their rescues and refused events, and every
/// note once.
Health worse_of(Health a, const Health& b);

/// Says how well the engines kept their promises; `of` says of what.
std::vector<std::string> health_in_words(const Health& worst, const std::string& of);

/// Fills in command, setup, program and citations.
void say_how_to_reproduce(Report& report, const Setup& setup);

}  // namespace shakedown
