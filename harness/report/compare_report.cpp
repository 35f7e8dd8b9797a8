// SPDX-License-Identifier: MIT
#include "compare_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "diagnose_report.hpp"
#include "page_figures.hpp"
#include "report_parts.hpp"

namespace shakedown {

ReportSection errors_section(const std::string& title, const std::vector<RunComparison>& runs) {
  ReportSection section;
  section.title = title;
  ReportBars bars{"",   "rms of measured less mean of the model.",
                  "mm", {"box", "what noise and run-to-run spread make"},
                  {},   std::nan(""),
                  ""};
  MoreColumn centre{"centre of the grains, mm", {}}, spread{"its noise and spread, mm", {}};
  for (const RunComparison& run : runs) {
    bars.lines.push_back({run.run,
                          fmt::format("{} times the floor", for_people(run.error_box / run.floor_box)),
                          {run.error_box * 1e3, run.floor_box * 1e3}});
    centre.cells.push_back(run.floor_centre > 0 ? for_people(run.error_centre * 1e3) : "–");
    spread.cells.push_back(run.floor_centre > 0 ? for_people(run.floor_centre * 1e3) : "–");
  }
  section.bars = {bars};
  section.tables = {numbers_of(bars, "run", {centre, spread})};
  return section;
}

ReportTable validation_table(const std::vector<Validation>& rows) {
  ReportTable table{"Comparison error and its uncertainty (ASME V&V 20), mm",
                    "E: simulation less data; u_num: run-to-run scatter and codes of one physics; u_input: "
                    "parameters, release and clock; u_D: camera; u_val: all three. The model's error lies "
                    "within E +- u_val.",
                    {"run", "observable", "E", "u_num", "u_input", "u_D", "u_val", "error of the model"},
                    {},
                    false};
  for (const Validation& row : rows) {
    const double left = row.model_error() * 1e3;
    table.rows.push_back({row.run, row.observable, for_people(row.error * 1e3),
                          for_people(row.numerical * 1e3), for_people(row.input * 1e3),
                          for_people(row.data * 1e3), for_people(row.uncertainty() * 1e3),
                          !std::isfinite(left) ? "could not be computed"
                          : left == 0          ? "within u_val"
                                               : "about " + for_people(left)});
  }
  return table;
}

Report report_of(const ComparedModel& found, const Measurement& measurement, const Setup& setup,
                 const std::vector<MeasuredAgainstModel>& curves, ReportKnobs knobs) {
  const auto& [fit, momentum, judgement] = found;
  const bool holds = judgement.holds();
  Report report;
  report.kind = "compare";
  report.title = measurement.title.empty() ? measurement.file : measurement.title;
  report.verdict = holds                                   ? "The model holds"
                   : judgement.standing == Standing::fails ? "The data reject the model"
                                                           : "Undecided";
  report.tone = holds ? Tone::good : judgement.standing == Standing::fails ? Tone::bad : Tone::unsure;
  report.subtitle = judgement.reason;
  report.sentence =
      holds ? fmt::format("What the model leaves of {} is camera noise and the spread from run to run.",
                          report.title)
            : fmt::format("The model misses {} by {} mm, where noise and run-to-run spread allow {} mm.",
                          report.title, for_people(fit.error_box() * 1e3), for_people(fit.floor_box() * 1e3));
  report.facts = {
      {"Error of the box", for_people(fit.error_box() * 1e3) + " mm", "rms over all runs", Tone::plain},
      {"Noise floor", for_people(fit.floor_box() * 1e3) + " mm", "camera and run-to-run spread",
       Tone::plain}};
  if (std::isfinite(fit.p_value))
    report.facts.push_back({"Fit", "p = " + for_people(fit.p_value),
                            for_people(fit.scatter) + " times the misfit of the model's own runs",
                            Tone::plain});
  if (momentum.possible)
    report.facts.push_back({"Momentum balance", "p = " + for_people(momentum.as_given.p_value),
                            "forces from outside, no simulation", Tone::plain});
  report.knobs = std::move(knobs);
  if (!curves.empty()) {
    report.replays = replays_of(curves);
    report.sections = {curves_section(curves, "Measured against model"), failure_section(curves)};
  }
  report.sections.push_back(errors_section("Error by run", fit.runs));
  report.sections.back().tables.push_back(validation_table(fit.validation()));
  report.sections.push_back(momentum_section(momentum));
  if (!curves.empty()) report.sections.push_back(energy_section(curves));
  if (const std::vector<std::string> notes = all_notes(measurement); !notes.empty()) {
    ReportSection section;
    section.title = "Notes";
    section.list = notes;
    report.sections.push_back(section);
  }
  say_how_to_reproduce(report, setup);
  if (!curves.empty()) report.health = health_lines(curves);
  return report;
}

}  // namespace shakedown
