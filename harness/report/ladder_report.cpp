// SPDX-License-Identifier: MIT
#include "ladder_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page_figures.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

ReportSection errors_section(const std::vector<Rung>& rungs, bool refitted) {
  ReportBars bars{"",
                  "rms of measured less mean of the model, position of the box, over all runs.",
                  "mm",
                  {refitted ? "fitted to" : "box"},
                  {},
                  std::nan(""),
                  "noise floor of the last"};
  if (refitted) bars.names.push_back("held out (each box length predicted from the others)");
  MoreColumn centre{"centre of the grains, mm", {}}, floor{"floor of the box, mm", {}}, p{"p", {}},
      momentum{"p of the momentum balance", {}}, verdict{"verdict", {}};
  for (const Rung& rung : rungs) {
    ReportBars::Line line{
        rung.setup, rung.effects, {rung.fit.error_box() * 1e3}, {}, rung.holds() ? Tone::good : Tone::bad};
    if (refitted) line.values.push_back(rung.fit.held_out_error_box * 1e3);
    bars.lines.push_back(std::move(line));
    centre.cells.push_back(rung.fit.floor_centre() > 0 ? for_people(rung.fit.error_centre() * 1e3) : "–");
    floor.cells.push_back(for_people(rung.fit.floor_box() * 1e3));
    p.cells.push_back(std::isfinite(rung.fit.p_value) ? for_people(rung.fit.p_value) : "–");
    momentum.cells.push_back(rung.momentum.possible ? for_people(rung.momentum.as_given.p_value) : "–");
    verdict.cells.push_back(rung.judgement().reason);
  }
  bars.floor = rungs.back().fit.floor_box() * 1e3;
  ReportSection section;
  section.title = "How the error falls";
  section.bars = {bars};
  section.tables = {numbers_of(bars, "setup", {centre, floor, p, momentum, verdict})};
  section.tables.front().folded = false;
  return section;
}

/// Makes the table of errors: a row a rung, a column a run.
ReportTable by_run(const std::vector<Rung>& rungs) {
  ReportTable table{"Error of the box by run, mm",
                    "In brackets: what noise and run-to-run spread make.",
                    {"setup"},
                    {},
                    false};
  for (const RunComparison& run : rungs.front().fit.runs) table.columns.push_back(run.run);
  for (const Rung& rung : rungs) {
    table.rows.push_back({rung.setup});
    for (const RunComparison& run : rung.fit.runs)
      table.rows.back().push_back(
          fmt::format("{} ({})", for_people(run.error_box * 1e3), for_people(run.floor_box * 1e3)));
  }
  return table;
}

ReportSection refits_section(const std::vector<Rung>& rungs) {
  ReportSection section;
  section.title = "Parameters";
  section.paragraphs = {"As refitted to all runs, with 95 % intervals."};
  for (const Rung& rung : rungs)
    for (const FittedValue& value : rung.fit.values)
      section.intervals.push_back(
          {rung.setup + ": " + value.key, "", "", value.value, value.low, value.high, std::nan("")});
  return section;
}

}  // namespace

Report report_of(const std::vector<Rung>& rungs, bool refitted, const Measurement& measurement,
                 const Setup& last) {
  Report report;
  report.kind = "ladder";
  report.title = measurement.title.empty() ? measurement.file : measurement.title;
  const auto best = std::min_element(rungs.begin(), rungs.end(), [](const Rung& a, const Rung& b) {
    return a.fit.error_box() < b.fit.error_box();
  });
  const auto holding =
      std::count_if(rungs.begin(), rungs.end(), [](const Rung& rung) { return rung.holds(); });
  report.verdict = holding == 0   ? "The data reject all"
                   : holding == 1 ? "One holds"
                                  : fmt::format("{} hold", holding);
  report.tone = holding == 0 ? Tone::bad : Tone::good;
  report.sentence = fmt::format(
      "Of {} setups {} has the smallest error of the box, {} mm, where noise and run-to-run spread make {} "
      "mm.",
      rungs.size(), best->setup, for_people(best->fit.error_box() * 1e3),
      for_people(best->fit.floor_box() * 1e3));
  report.subtitle =
      refitted ? "Both restitutions and the frequency of each refitted." : "Each as its file has it.";
  report.sections = {errors_section(rungs, refitted)};
  report.sections.front().tables.push_back(by_run(rungs));
  if (refitted) report.sections.push_back(refits_section(rungs));
  say_how_to_reproduce(report, last);
  return report;
}

}  // namespace shakedown
