// SPDX-License-Identifier: MIT
#include "paper_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hard_engine.hpp"
#include "page_figures.hpp"
#include "replay_tracks.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

constexpr std::size_t most_points_of_plot = 700;  // of a curve; a plot is about that many pixels wide

double at(const Curve& curve, double x) {
  const auto after = std::lower_bound(curve.x.begin(), curve.x.end(), x);
  if (after == curve.x.end()) return std::nan("");
  const auto i = static_cast<std::size_t>(after - curve.x.begin());
  if (curve.x[i] == x) return curve.y[i];
  if (i == 0 || curve.points) return std::nan("");
  return curve.y[i - 1] +
         (curve.y[i] - curve.y[i - 1]) * (x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
}

/// Returns one x for all curves: those of the longest, thinned, and marks where they are.
std::vector<double> common_x(const Panel& panel) {
  const auto longest =
      std::max_element(panel.curves.begin(), panel.curves.end(),
                       [](const Curve& a, const Curve& b) { return a.x.size() < b.x.size(); });
  if (longest == panel.curves.end()) return {};
  std::vector<double> x;
  const std::size_t step = std::max<std::size_t>(1, longest->x.size() / most_points_of_plot);
  for (std::size_t i = 0; i < longest->x.size(); i += step) x.push_back(longest->x[i]);
  for (const Curve& curve : panel.curves)
    if (curve.points) x.insert(x.end(), curve.x.begin(), curve.x.end());
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
  return x;
}

std::string title_of(const Chart& chart, const Panel& panel, const std::string& group) {
  if (!group.empty()) return panel.y_label.substr(0, panel.y_label.find(','));
  return &panel == &chart.panels.front()
             ? chart.title
             : chart.title + " (" + panel.y_label.substr(0, panel.y_label.find(',')) + ")";
}

ReportPlot plot_of(const Chart& chart, const Panel& panel, const std::string& group) {
  ReportPlot plot;
  plot.title = title_of(chart, panel, group);
  plot.x_label = panel.x_label == "t, s" ? "time since release, s" : panel.x_label;
  plot.y_label = panel.y_label;
  plot.group = group;
  plot.over_time = !group.empty() && panel.x_label == "t, s";
  plot.x = common_x(panel);
  bool first = true;
  for (const Curve& curve : panel.curves) {
    ReportCurve drawn{curve.name,
                      curve.points   ? CurveRole::points
                      : curve.dashed ? CurveRole::as_given
                      : first        ? CurveRole::model
                                     : CurveRole::other,
                      {}};
    for (const double x : plot.x) drawn.y.push_back(at(curve, x));
    first = false;
    plot.curves.push_back(std::move(drawn));
  }
  // Dashed ones first, so that they lie under the others.
  std::stable_partition(plot.curves.begin(), plot.curves.end(),
                        [](const ReportCurve& curve) { return curve.role == CurveRole::as_given; });
  for (const Panel::Vertical& line : panel.verticals) plot.marks.push_back({line.x, line.label});
  return plot;
}

std::string group_of(const Chart& chart) {
  if (chart.name == "optimised") return "311 mm";
  const std::size_t length = chart.name.find("_L");
  return chart.name.starts_with("comp") ? chart.name.substr(length + 2) + " mm" : "";
}

ReportSection figures_section(const Paper& paper, const std::string& title, bool motion) {
  ReportSection section;
  section.title = title;
  for (const Chart& chart : paper.charts) {
    if (chart.name == "puzzle" || group_of(chart).empty() == motion) continue;
    for (const Panel& panel : chart.panels) section.plots.push_back(plot_of(chart, panel, group_of(chart)));
  }
  return section;
}

std::string readable_value(const Finding& f) {
  const std::string unit = f.unit.empty() ? "" : " " + f.unit;
  if (std::isnan(f.low) || f.low == f.high) return for_people(f.value) + unit;
  return fmt::format("{}{} ({} to {})", for_people(f.value), unit, for_people(f.low), for_people(f.high));
}

std::string mark_of(Judgement judgement) {
  return judgement == Judgement::holds ? "\u2713 " : judgement == Judgement::fails ? "\u2715 " : "? ";
}

ReportSection statements_section(const Paper& paper) {
  ReportSection section;
  section.title = "Statement by statement";
  section.paragraphs = {
      "Numbers are means with 95 % intervals of the mean. Where the paper gives no number the rule says how "
      "its words were taken."};
  ReportTable verdicts{"", "", {"statement", "paper", "verdict", "it holds when"}, {}, false},
      findings{"What was found", "", {"statement", "finding", "value (95 %)"}, {}, true};
  for (const Statement& s : paper.statements) {
    verdicts.rows.push_back(
        {s.text, s.paper, mark_of(s.judgement) + std::string(name_of(s.judgement)), s.rule});
    for (const Finding& f : s.findings) findings.rows.push_back({s.name, f.what, readable_value(f)});
  }
  section.tables = {verdicts, findings};
  for (const Statement& s : paper.statements)
    if (s.judgement != Judgement::holds && !s.remark.empty())
      section.list.push_back(s.name + ": " + s.remark);
  return section;
}

ReportPlot friction_plot(const Puzzle& puzzle) {
  ReportPlot plot;
  plot.title = "Grains of 0.95 that rub, fitted without friction";
  plot.x_label = "friction in the laboratory";
  plot.y_label = "fitted restitution";
  std::vector<double> low, high, paper;
  ReportCurve fitted{"grain-grain, fitted to L = 40 mm", CurveRole::model, {}};
  for (const PuzzlePoint& point : puzzle.points) {
    const FittedParameter& p = point.one.parameters.front();
    plot.x.push_back(point.friction);
    low.push_back(p.low), high.push_back(p.high), fitted.y.push_back(p.value), paper.push_back(0.75);
  }
  plot.curves = band("95 %", low, high);
  plot.curves.push_back({"the paper's fit", CurveRole::as_given, paper});
  plot.curves.push_back(fitted);
  return plot;
}

ReportSection puzzle_section(const Paper& paper) {
  const Puzzle& puzzle = paper.runs.puzzle;
  ReportSection section;
  section.title = "The puzzle: 0.95 or 0.75?";
  section.paragraphs = {
      "A drop test says that two grains keep 0.95 of their closing speed, the paper's fit says 0.75. Here "
      "grains of 0.95 that rub were filmed in the soft engine and fitted without friction, as the paper did.",
      "Then the other way round, with " + fmt::format("friction {:g}", puzzle.friction) +
          " in the laboratory and L = 40 mm alone fitted: error on the lengths left out."};
  section.plots = {friction_plot(puzzle)};
  ReportTable models{"Error of the box, mm",
                     "In brackets: the spread that noise, chaos and the fit's uncertainty make.",
                     {"model"},
                     {},
                     false};
  if (!puzzle.models.empty())
    for (const std::string& run : puzzle.models.front().runs) models.columns.push_back(run);
  for (const PuzzleModel& model : puzzle.models) {
    models.rows.push_back({model.name});
    for (std::size_t i = 0; i < model.error.size(); ++i)
      models.rows.back().push_back(
          fmt::format("{} ({})", for_people(1e3 * model.error[i]), for_people(1e3 * model.spread[i])));
  }
  section.tables = {models};
  if (puzzle.diagnosis.ladder.empty()) return section;
  ReportBars bars{"Diagnosis of L = 40 mm with 0.95 held fixed",
                  puzzle.diagnosis.sentence,
                  "mm",
                  {"error of the box"},
                  {},
                  1e3 * puzzle.diagnosis.ladder.back().floor_box,
                  "noise floor"};
  for (const LadderStep& step : puzzle.diagnosis.ladder)
    bars.lines.push_back(
        {step.step, fmt::format("p = {}", for_people(step.p_value)), {1e3 * step.error_box}});
  section.bars = {bars};
  for (const DiagnosedParameter& p : puzzle.diagnosis.parameters)
    if (p.word.empty())
      section.intervals.push_back({p.name, p.unit, "", p.value, p.low, p.high, std::nan("")});
  return section;
}

std::vector<ReportReplay> replays(const PaperRuns& runs) {
  std::vector<ReportReplay> found;
  for (const DamperRuns& r : runs.hard) {
    Setup setup = r.setup;
    setup.run.duration = 8;
    RunOptions options;
    options.log_collisions = true;
    const Trajectory trajectory = make_hard_engine()->run(setup, options);
    const double landing = 0.25 / setup.spring.frequency;
    found.push_back(replay_of({"", setup, 0, *trajectory.collision_log},
                              {fmt::format("{:g} mm", 1e3 * setup.box.length), "The grains", landing,
                               landing + 0.5, 8, 120'000, 2e-5}));
  }
  return found;
}

}  // namespace

Report report_of(const Paper& paper) {
  Report report;
  report.kind = "paper";
  report.title = "Movers and shakers: Granular damping in microgravity";
  const auto count = [&](Judgement judgement) {
    return std::count_if(paper.statements.begin(), paper.statements.end(),
                         [&](const Statement& s) { return s.judgement == judgement; });
  };
  report.sentence = fmt::format("Of {} statements of the paper {} hold, {} fail and {} cannot be told.",
                                paper.statements.size(), count(Judgement::holds), count(Judgement::fails),
                                count(Judgement::cannot_tell));
  report.subtitle =
      "Bannerman, Kollmer, Sack, Heckel, Müller and Pöschel; every table, figure and statement simulated "
      "anew with two engines.";
  for (const Judgement judgement : {Judgement::holds, Judgement::fails, Judgement::cannot_tell})
    report.facts.push_back(
        {std::string(name_of(judgement)), fmt::format("{}", count(judgement)), "", Tone::plain});
  report.facts.push_back({"Time", fmt::format("{:.0f} s", paper.seconds), "", Tone::plain});
  report.replays = replays(paper.runs);
  report.sections = {figures_section(paper, "Box and grains", true), statements_section(paper),
                     puzzle_section(paper), figures_section(paper, "Energy and the best length", false)};
  say_how_to_reproduce(report, paper.runs.hard.front().setup);
  return report;
}

}  // namespace shakedown
