// SPDX-License-Identifier: MIT
#include "bounce_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bounce_answer.hpp"
#include "page_figures.hpp"
#include "provenance.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

constexpr int points_of_a_band = 60;

/// x of a plot with points and a band: both sets of speeds, ascending.
struct Abscissa {
  std::vector<double> x;
  explicit Abscissa(const BounceAnswer& answer, const std::vector<double>& more) {
    for (int i = 0; i < points_of_a_band; ++i)
      x.push_back(answer.slowest *
                  std::pow(answer.fastest / answer.slowest, i / static_cast<double>(points_of_a_band - 1)));
    x.insert(x.end(), more.begin(), more.end());
    std::sort(x.begin(), x.end());
    x.erase(std::unique(x.begin(), x.end()), x.end());
  }
  std::vector<double> empty() const { return std::vector<double>(x.size(), std::nan("")); }
  std::size_t place(double value) const {
    return static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), value) - x.begin());
  }
};

ReportPlot restitution_plot(const BounceReading& reading) {
  const BounceAnswer& answer = reading.answer;
  const LawFit& best = answer.best();
  std::vector<double> speeds;
  for (const ImpactRow& row : best.at.rows) speeds.push_back(row.speed);
  const Abscissa at(answer, speeds);
  std::vector<double> seen = at.empty(), middle, low, high;
  for (const ImpactRow& row : best.at.rows) seen[at.place(row.speed)] = row.restitution;
  for (const double speed : at.x) {
    const Estimate value = best.restitution_at(speed);
    middle.push_back(value.value), low.push_back(value.low), high.push_back(value.high);
  }
  ReportPlot plot;
  plot.title = "Restitution against the speed of impact";
  plot.caption = fmt::format(
      "Points: each impact by the two flights beside it{}. Line and band: the law {} with its 95 % interval; "
      "single impacts lie about it by timing noise and scatter.",
      best.model.air == AirModel::none ? "" : ", less what the air takes", best.name());
  plot.x_label = "speed of impact, m/s";
  plot.y_label = "restitution";
  plot.x = at.x;
  plot.curves = band("95 %", low, high);
  plot.curves.push_back({best.name(), CurveRole::model, middle});
  plot.curves.push_back({"impacts", CurveRole::points, seen});
  return plot;
}

ReportBars laws_bars(const BounceAnswer& answer) {
  ReportBars bars{"Probability of the laws",
                  "The evidence of each law: its likelihood averaged over what was believed of its numbers.",
                  "%",
                  {"probability"},
                  {},
                  std::nan(""),
                  ""};
  for (std::size_t i = 0; i < answer.laws.size(); ++i) {
    const LawFit& law = answer.laws[i];
    bars.lines.push_back({law.name(),
                          std::isfinite(answer.tests[i].p_value)
                              ? "p = " + for_people(answer.tests[i].p_value)
                              : std::string("not tested"),
                          {100 * law.probability}});
  }
  return bars;
}

ReportSection laws_section(const BounceReading& reading) {
  const BounceAnswer& answer = reading.answer;
  ReportSection section;
  section.title = "Which law";
  section.bars = {laws_bars(answer)};
  const LawFit& best = answer.best();
  for (std::size_t k = 0; k < best.values.size(); ++k) {
    const Estimate& value = best.values[k];
    section.intervals.push_back(
        {std::string(best.parameters[k].name), "", "", value.value, value.low, value.high});
  }
  const auto spread = [&](const char* name, double SpreadNode::*of, double scale, const char* unit) {
    const Estimate value = best.posterior.spread(of);
    if (std::isfinite(value.value))
      section.intervals.push_back(
          {name, unit, "", value.value * scale, value.low * scale, value.high * scale});
  };
  spread("timing noise of an instant", &SpreadNode::timing, 1e3, "ms");
  spread("scatter from impact to impact", &SpreadNode::scatter, 1, "");
  spread("scatter from drop to drop", &SpreadNode::drop_scatter, 1, "");
  ReportTable table{"All laws",
                    fmt::format("Reference speed {:.3g} m/s.", answer.reference),
                    {"law", "formula", "probability", "p", "parameters"},
                    {},
                    true};
  for (std::size_t i = 0; i < answer.laws.size(); ++i) {
    const LawFit& law = answer.laws[i];
    std::string parameters;
    for (std::size_t k = 0; k < law.values.size(); ++k)
      parameters += fmt::format("{}{} {}", parameters.empty() ? "" : "; ", law.parameters[k].name,
                                with_interval(law.values[k].value, law.values[k].low, law.values[k].high));
    table.rows.push_back({law.name(), std::string(law_of(law.model.law).formula), for_people(law.probability),
                          for_people(answer.tests[i].p_value), parameters});
  }
  section.tables = {table};
  return section;
}

ReportTable speeds_table(const BounceReading& reading) {
  ReportTable table{"Restitution at some speeds",
                    "As timed: the ratio of flights without any law, what the air takes in it.",
                    {"speed, m/s", "by the law", "averaged over the laws", "as timed"},
                    {},
                    false};
  const auto cell = [](const Estimate& e) { return with_interval(e.value, e.low, e.high); };
  for (const double speed : speeds_told(reading.answer))
    table.rows.push_back({for_people(speed), cell(reading.answer.best().restitution_at(speed)),
                          cell(reading.answer.averaged_at(speed)),
                          cell(reading.as_timed.restitution_at(speed))});
  return table;
}

ReportSection outliers_section(const BounceReading& reading) {
  ReportSection section;
  section.title = "Left out";
  if (reading.answer.outliers.empty()) section.paragraphs = {"No impact stands out."};
  ReportTable table{"", "", {"file", "drop", "impact", "why", "sigma"}, {}, false};
  for (const Outlier& outlier : reading.answer.outliers) {
    const Drop& drop = reading.read.drops[outlier.drop];
    table.rows.push_back({drop.file, drop.name, std::to_string(outlier.impact), outlier.reason,
                          outlier.sigmas != 0 ? for_people(std::abs(outlier.sigmas)) : "gross"});
  }
  if (!table.rows.empty()) section.tables = {table};
  return section;
}

ReportPlot sound_plot(const SoundShown& sound) {
  ReportPlot plot;
  plot.title = sound.file;
  plot.caption =
      "Highest level in each interval. Points: impacts of the drop. Dashed lines: other sudden sounds.";
  plot.x_label = "time in the recording, s";
  plot.y_label = "level, dB of full scale";
  plot.x = sound.time;
  std::vector<double> impacts(plot.x.size(), std::nan(""));
  for (const double t : sound.impacts) {
    const auto after = std::lower_bound(plot.x.begin(), plot.x.end(), t);
    const std::size_t i = std::min(static_cast<std::size_t>(after - plot.x.begin()), plot.x.size() - 1);
    impacts[i] = sound.level[i];
  }
  plot.curves = {{"level", CurveRole::other, sound.level},
                 {"impacts of the drop", CurveRole::points, impacts}};
  for (const double t : sound.others) plot.marks.push_back({t, ""});
  return plot;
}

}  // namespace

Report report_of(const BounceReading& reading) {
  const BounceAnswer& answer = reading.answer;
  const LawFit& best = answer.best();
  Report report;
  report.kind = "bounce";
  report.title = reading.read.drops.front().file;
  report.verdict = answer.holds() ? "The law " + best.name() + " holds" : "No law of the list holds";
  report.tone = answer.holds() ? Tone::good : Tone::bad;
  report.sentence = sentence_of(reading);
  const Estimate at = best.restitution_at(answer.reference);
  const Estimate scatter = best.posterior.spread(&SpreadNode::scatter);
  report.facts = {{fmt::format("Restitution at {:.3g} m/s", answer.reference), for_people(at.value),
                   for_people(at.low) + " to " + for_people(at.high), Tone::plain},
                  {"Law", best.name(), fmt::format("{:.1f} %", 100 * best.probability), Tone::plain},
                  {"Impacts", std::to_string(best.at.rows.size()),
                   fmt::format("of {} drops, {} left out", reading.read.drops.size(), answer.outliers.size()),
                   Tone::plain},
                  {"Scatter", for_people(scatter.value),
                   fmt::format("there is any: {:.1f} %", 100 * answer.scatter_odds), Tone::plain}};
  ReportSection first;
  first.title = "Restitution";
  first.plots = {restitution_plot(reading)};
  first.tables = {speeds_table(reading)};
  report.sections = {first, laws_section(reading), outliers_section(reading)};
  if (!reading.read.sounds.empty()) {
    ReportSection sounds;
    sounds.title = "Sound";
    for (const SoundShown& sound : reading.read.sounds) sounds.plots.push_back(sound_plot(sound));
    report.sections.push_back(sounds);
  }
  ReportSection notes;
  notes.title = "How the files were read";
  notes.list = reading.read.notes;
  report.sections.push_back(notes);
  report.command = this_command();
  report.setup = effect_lines(reading);
  report.program = version_line();
  for (const LawFit& law : answer.laws)
    if (const RestitutionLaw& of = law_of(law.model.law);
        law.model.air != AirModel::free && !of.source.empty())
      report.citations.push_back(std::string(of.name) + ": " + std::string(of.source));
  return report;
}

}  // namespace shakedown
