// SPDX-License-Identifier: MIT
#include "measured_sections.hpp"

#include <fmt/format.h>

#include <cmath>

#include "answer_sections.hpp"
#include "distributions.hpp"
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

ReportSection nuisances_section(const std::vector<NuisanceFound>& found) {
  ReportSection section;
  section.title = "Camera and weights";
  section.paragraphs = {
      "What the data say (95 %) of what was known to an error only, counted from what was stated; pale: what "
      "was known."};
  for (const NuisanceFound& n : found) {
    const ReadUnit read = read_unit(n.name.substr(0, n.name.find(' ')));
    const double value = n.value / read.factor, error = normal_95 * n.error / read.factor,
                 known = normal_95 * n.deviation / read.factor;
    ReportInterval interval{words_of_key(n.name), read.unit, "", value, value - error, value + error};
    if (known > 0) interval.known_low = -known, interval.known_high = known;
    section.intervals.push_back(interval);
  }
  return section;
}

ReportSection momentum_section(const MomentumAudit& momentum) {
  ReportSection section;
  section.title = "Forces from outside";
  if (!momentum.possible) {
    section.paragraphs = {"The momentum balance needs a run with both positions measured. " +
                          momentum.why_not};
    return section;
  }
  if (!std::isfinite(momentum.as_given.p_value) && !std::isfinite(momentum.final_fit.p_value))
    section.paragraphs = {"The balance of momentum gave no p-value."};
  else
    section.paragraphs = {fmt::format(
        "Whatever happens in the contacts, box and grains together obey one balance of momentum; "
        "no simulation is needed. As given it closes with "
        "chi squared {} a degree of freedom (p = {}), with the terms below {} (p = {}).",
        for_people(momentum.as_given.chi2_per_degree()), for_people(momentum.as_given.p_value),
        for_people(momentum.final_fit.chi2_per_degree()), for_people(momentum.final_fit.p_value))};
  for (const FoundTerm& term : momentum.terms)
    section.intervals.push_back(
        {term.effect + "." + term.parameter, term.unit, "", term.value, term.low, term.high, std::nan("")});
  for (std::size_t i = 0; i < momentum.curves.size() && i < 2; ++i) {
    const ForceCurve& curve = momentum.curves[i];
    ReportPlot plot;
    plot.title = "The force that is left";
    plot.caption = "No form assumed. Band: two standard errors.";
    plot.x_label = argument_of(curve.of);
    plot.y_label = value_of(curve.of);
    plot.x = curve.argument;
    std::vector<double> low, high;
    for (std::size_t k = 0; k < curve.value.size(); ++k)
      low.push_back(curve.value[k] - 2 * curve.error[k]), high.push_back(curve.value[k] + 2 * curve.error[k]);
    plot.curves = band("two standard errors", low, high);
    plot.curves.push_back({"force", CurveRole::model, curve.value});
    section.plots.push_back(plot);
  }
  ReportTable runs{"By run",
                   "",
                   {"run", "chi squared a degree of freedom", "force that the model lacks, mN rms",
                    "noise of one window, mN"},
                   {},
                   false};
  for (const RunBalance& run : momentum.runs)
    runs.rows.push_back({run.run, for_people(run.as_given.chi2_per_degree()),
                         for_people(run.missing_force * 1e3), for_people(run.missing_force_noise * 1e3)});
  section.tables = {runs};
  return section;
}

}  // namespace shakedown
