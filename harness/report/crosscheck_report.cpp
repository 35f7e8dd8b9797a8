// SPDX-License-Identifier: MIT
#include "crosscheck_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "page_figures.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

ReportPlot peaks_plot(const Crosscheck& check) {
  ReportPlot plot;
  plot.title = "Peaks";
  plot.x_label = "number of the peak";
  plot.y_label = "|peak|, mm";
  plot.group = check.name;
  std::size_t most = 0;
  for (const EngineResult& engine : check.engines) most = std::max(most, engine.peaks.size());
  for (std::size_t k = 0; k < most; ++k) plot.x.push_back(static_cast<double>(k + 1));
  for (const EngineResult& engine : check.engines) {
    ReportCurve curve{engine.engine, plot.curves.empty() ? CurveRole::model : CurveRole::other,
                      std::vector<double>(most, std::nan(""))};
    for (std::size_t k = 0; k < engine.peaks.size(); ++k) curve.y[k] = std::abs(engine.peaks[k].mean) * 1e3;
    plot.curves.push_back(curve);
  }
  return plot;
}

ReportTable numbers_table(const Crosscheck& check) {
  ReportTable table{"Side by side", "Mean and standard deviation of one run.", {"number"}, {}, false};
  for (const EngineResult& engine : check.engines)
    table.columns.push_back(fmt::format("{} ({} runs)", engine.engine, engine.runs));
  const auto numbers = crosscheck_numbers();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    std::vector<std::string> row{
        fmt::format("{}{}{}", numbers[k].label, *numbers[k].unit ? ", " : "", numbers[k].unit)};
    for (const EngineResult& engine : check.engines)
      row.push_back(engine.numbers[k].n == 0
                        ? "–"
                        : fmt::format("{} ± {}", for_people(engine.numbers[k].mean * numbers[k].per_si),
                                      for_people(engine.numbers[k].sd * numbers[k].per_si)));
    table.rows.push_back(row);
  }
  return table;
}

ReportTable verdicts_table(const Crosscheck& check) {
  ReportTable table{"Verdicts",
                    "95 % interval of the difference against the margin.",
                    {"engines", "number", "difference", "interval", "margin", "verdict"},
                    {},
                    false};
  for (const Comparison& c : check.comparisons) {
    const double f = c.number->per_si;
    table.rows.push_back({c.first + ", " + c.second, c.number->label,
                          for_people(c.found.difference * f) + " " + c.number->unit,
                          for_people(c.found.low * f) + " to " + for_people(c.found.high * f),
                          for_people(c.found.margin * f), in_words(c.found)});
  }
  return table;
}

}  // namespace

Report report_of(const std::vector<Crosscheck>& crosschecks, const Setup& last_setup) {
  Report report;
  report.kind = "crosscheck";
  bool differ = false, open = false;
  int compared = 0;
  for (const Crosscheck& check : crosschecks) {
    report.title += (report.title.empty() ? "" : ", ") + check.name;
    differ = differ || check.any(Agreement::differ);
    open = open || check.any(Agreement::cannot_tell);
    compared += static_cast<int>(check.comparisons.size());
    ReportSection section;
    section.title = check.name;
    section.plots = {peaks_plot(check)};
    section.tables = {verdicts_table(check), numbers_table(check)};
    report.sections.push_back(section);
  }
  report.verdict = differ ? "The engines differ" : open ? "More runs are needed" : "The engines agree";
  report.tone = differ ? Tone::bad : open ? Tone::unsure : Tone::good;
  report.sentence =
      differ ? fmt::format("At least one of {} numbers differs between the engines by more than its margin.",
                           compared)
      : open
          ? fmt::format("No number of {} differs, but some need more runs to be called the same.", compared)
          : fmt::format("All {} numbers are the same in the engines, within their margins.", compared);
  say_how_to_reproduce(report, last_setup);
  return report;
}

}  // namespace shakedown
