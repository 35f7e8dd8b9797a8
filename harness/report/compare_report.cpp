// SPDX-License-Identifier: MIT
#include "compare_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "effects.hpp"
#include "known_to_errors.hpp"
#include "measured_sections.hpp"
#include "page_figures.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

/// Shows what the layer does at each landing, a run at a time.
ReportSection landings_section(const std::vector<DecayComparison>& decays) {
  ReportSection section;
  section.title = "Landings of the layer";
  for (const DecayComparison& run : decays)
    for (const LandingRow& row : landing_rows()) {
      ReportPlot plot;
      plot.title = fmt::format("{}: {}", run.run, row.name);
      plot.x_label = "time, s";
      plot.y_label = *row.unit ? fmt::format("{}, {}", row.name, row.unit) : row.name;
      plot.group = run.run;
      ReportCurve measured{"measured", CurveRole::points, {}}, model{"model", CurveRole::model, {}};
      std::vector<double> low, high;
      for (const LandingComparison& landing : run.landings) {
        const MeasuredNumber& number = landing.*row.number;
        plot.x.push_back(landing.time);
        measured.y.push_back(number.measured * row.scale);
        model.y.push_back(number.model * row.scale);
        low.push_back((number.model - 2 * number.spread) * row.scale);
        high.push_back((number.model + 2 * number.spread) * row.scale);
      }
      if (plot.x.size() < 2) continue;
      plot.curves = band("two spreads, from run to run and of the camera", low, high);
      plot.curves.push_back(std::move(model));
      plot.curves.push_back(std::move(measured));
      section.plots.push_back(std::move(plot));
    }
  if (!section.plots.empty())
    section.paragraphs = {
        "What the grains give to an end wall from one flight to the next, how fast they come, how they "
        "rebound, how long it takes from 90 % to 10 % of the speed and how thick they then lie. Told with "
        "the same frames and noise of film and model."};
  return section;
}

}  // namespace

Report report_of(const ComparedModel& found, const Measurement& measurement, const Setup& setup,
                 const std::vector<MeasuredAgainstModel>& curves, ReportKnobs knobs) {
  const auto& [fit, momentum, judgement, decays] = found;
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
  if (ReportSection landings = landings_section(decays); !landings.plots.empty())
    report.sections.push_back(std::move(landings));
  if (const std::vector<NuisanceFound> found = nuisances_of(fit, all_effects()); !found.empty())
    report.sections.push_back(nuisances_section(found));
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
