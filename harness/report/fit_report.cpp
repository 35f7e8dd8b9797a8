// SPDX-License-Identifier: MIT
#include "fit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_curve_section.hpp"
#include "measured_sections.hpp"
#include "page_figures.hpp"
#include "quantity.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

std::string value_with_interval(const FittedParameter& p, double si) {
  const std::string text = with_interval(p.value / si, p.low / si, p.high / si);
  return p.unit.empty() ? text : text + " " + p.unit;
}

double si_of(const FittedParameter& p) { return std::get<Unit>(parse_unit(p.unit)).si; }

ReportSection fitted_section(const Fit& fit) {
  ReportSection section;
  section.title = "Parameters";
  section.paragraphs = {"Best values with 95 % intervals; dashed: where the fit started."};
  for (const FittedParameter& p : fit.parameters) {
    const double si = si_of(p);
    section.intervals.push_back({p.key, p.unit, "", p.value / si, p.low / si, p.high / si, p.start / si});
    if (!p.remark.empty()) section.list.push_back(p.key + ": " + p.remark);
  }
  if (fit.parameters.size() < 2) return section;
  ReportTable table{
      "Correlation of the estimates", "Near 1 or -1: only a combination is known.", {""}, {}, false};
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    table.columns.push_back(fit.parameters[i].key);
    table.rows.push_back({fit.parameters[i].key});
    for (std::size_t j = 0; j < fit.parameters.size(); ++j)
      table.rows.back().push_back(
          for_people(fit.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
  }
  section.tables = {table};
  return section;
}

std::string headline(const Fit& fit) {
  const bool left_out = !fit.left_out.empty();
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const RunComparison& run : left_out ? fit.left_out : fit.used) {
    least = std::min(least, run.error_box / run.floor_box);
    most = std::max(most, run.error_box / run.floor_box);
  }
  return fmt::format("The fit {} with errors of {} to {} times noise and run-to-run spread.",
                     left_out ? "foretells the runs left out" : "follows its runs", for_people(least),
                     for_people(most));
}

std::vector<ReportFact> facts_of_fit(const Fit& fit) {
  std::vector<ReportFact> facts;
  for (const FittedParameter& p : fit.parameters) {
    const std::string text = with_interval(p.value / si_of(p), p.low / si_of(p), p.high / si_of(p));
    const std::size_t interval = std::min(text.find(" ("), text.size());
    facts.push_back({p.key, text.substr(0, interval) + (p.unit.empty() ? "" : " " + p.unit),
                     p.told ? "95 %:" + text.substr(interval) : "not told by these data",
                     p.told ? Tone::plain : Tone::unsure});
  }
  facts.push_back({"Fit", std::isfinite(fit.p_value) ? "p = " + for_people(fit.p_value) : "waveform",
                   fit.judgement.reason, fit.judgement.holds() ? Tone::good : Tone::bad});
  if (fit.runs > 0)
    facts.push_back(
        {"Simulations", fmt::format("{}", fit.runs), fmt::format("in {:.0f} s", fit.seconds), Tone::plain});
  return facts;
}

}  // namespace

Report report_of(const Fit& fit, const Measurement& measurement,
                 const std::vector<MeasuredAgainstModel>& curves, ReportKnobs knobs) {
  Report report;
  report.knobs = std::move(knobs);
  report.kind = "fit";
  report.title = measurement.title.empty() ? measurement.file : measurement.title;
  const auto untold = std::count_if(fit.parameters.begin(), fit.parameters.end(),
                                    [](const FittedParameter& p) { return !p.told; });
  const Standing standing = fit.judgement.standing;
  report.verdict = standing == Standing::fails       ? "No values fit"
                   : standing == Standing::undecided ? "Whether the values fit is undecided"
                   : untold > 0                      ? "Not all is told"
                                                     : "Fitted";
  report.tone = standing == Standing::fails                     ? Tone::bad
                : standing == Standing::undecided || untold > 0 ? Tone::unsure
                                                                : Tone::good;
  report.sentence = headline(fit) + " Values: ";
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    report.sentence += (i > 0 ? "; " : "") + fit.parameters[i].key + " " +
                       value_with_interval(fit.parameters[i], si_of(fit.parameters[i]));
  report.subtitle = fmt::format("Fitted to {} run{}, {} left out.", fit.used.size(),
                                fit.used.size() == 1 ? "" : "s", fit.left_out.size());
  report.facts = facts_of_fit(fit);
  report.replays = replays_of(curves);
  report.sections = {curves_section(curves, "Measured against model"), fitted_section(fit)};
  for (const ContactCurve& curve : fit.curves) report.sections.push_back(contact_curve_section(curve));
  if (fit.constant)
    report.sections.back().paragraphs.push_back("Without a curve: " + words_of_constant(fit) + ".");
  report.sections.push_back(errors_section("Runs fitted", fit.used));
  if (!fit.left_out.empty())
    report.sections.push_back(errors_section("Runs left out, foretold", fit.left_out));
  report.sections.push_back(failure_section(curves));
  report.sections.push_back(energy_section(curves));
  say_how_to_reproduce(report, fit.fitted);
  report.health = health_lines(curves);
  return report;
}

}  // namespace shakedown
