// SPDX-License-Identifier: MIT
#include "diagnose_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "answer_sections.hpp"
#include "contact_curve_section.hpp"
#include "effects.hpp"
#include "known_effects.hpp"
#include "measured_sections.hpp"
#include "noise_section.hpp"
#include "page_figures.hpp"
#include "report_parts.hpp"
#include "text.hpp"

namespace shakedown {

namespace {

Tone tone_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate: return Tone::good;
    case Verdict::refit:
    case Verdict::measurement: return Tone::unsure;
    case Verdict::missing: return Tone::bad;
    case Verdict::unknown: break;
  }
  return Tone::bad;
}

std::string verdict_in_words(const Diagnosis& diagnosis) {
  switch (diagnosis.verdict) {
    case Verdict::adequate: return "The model holds";
    case Verdict::refit: return "Other parameters suffice";
    case Verdict::measurement: return "The measurement explains it";
    case Verdict::missing:
      return diagnosis.missing.size() == 1 ? "An effect is missing" : "Effects are missing";
    case Verdict::unknown: break;
  }
  return "None of the known effects";
}

std::string readable_mm(double metres) { return for_people(metres * 1e3) + " mm"; }

std::vector<ReportFact> facts_of(const Diagnosis& diagnosis) {
  std::vector<ReportFact> facts;
  if (!diagnosis.ladder.empty()) {
    const LadderStep &first = diagnosis.ladder.front(), &last = diagnosis.ladder.back();
    facts.push_back(
        {"Error of the box, as given", readable_mm(first.error_box), "rms over all runs", Tone::plain});
    if (diagnosis.ladder.size() > 1)
      facts.push_back({"Error, final model", readable_mm(last.error_box),
                       last.error_box < 1.2 * last.floor_box ? "at the noise floor" : "above the noise floor",
                       last.error_box < 1.2 * last.floor_box ? Tone::good : Tone::unsure});
    facts.push_back(
        {"Noise floor", readable_mm(last.floor_box), "camera and run-to-run spread", Tone::plain});
    if (std::isfinite(last.p_value))
      facts.push_back({"Fit of the final model", fmt::format("p = {}", for_people(last.p_value)),
                       fmt::format("{} times the misfit of its own runs", for_people(last.scatter)),
                       Tone::plain});
  }
  if (diagnosis.runs_simulated > 0)
    facts.push_back({"Simulations", fmt::format("{}", diagnosis.runs_simulated),
                     fmt::format("in {:.0f} s", diagnosis.seconds), Tone::plain});
  else
    facts.push_back(
        {"Time", fmt::format("{:.1f} s", diagnosis.seconds), "no simulation was needed", Tone::plain});
  return facts;
}

ReportSection ladder_section(const Diagnosis& diagnosis) {
  ReportSection section;
  section.title = "How the error fell";
  const std::vector<LadderStep>& steps = diagnosis.ladder;
  const auto any = [&](auto&& number) {
    return std::any_of(steps.begin(), steps.end(),
                       [&](const LadderStep& step) { return std::isfinite(number(step)); });
  };
  const bool held_out = any([](const LadderStep& step) { return step.held_out_error_box; });
  const bool judged = any([](const LadderStep& step) { return step.p_value; });
  ReportBars bars{"",           "rms of measured less mean of the model, position of the box, over all runs.",
                  "mm",         {"fitted to"},
                  {},           std::nan(""),
                  "noise floor"};
  if (held_out) bars.names.push_back("held out (each box length predicted from the others)");
  MoreColumn centre{"centre of the grains, mm", {}}, floor{"floor of the box, mm", {}}, p{"p", {}};
  bool has_centre = false;
  for (const LadderStep& step : steps) {
    const std::string note =
        std::isfinite(step.p_value) ? fmt::format("p = {}", for_people(step.p_value)) : "";
    bars.lines.push_back({step.step, note, {step.error_box * 1e3}});
    if (held_out) bars.lines.back().values.push_back(step.held_out_error_box * 1e3);
    has_centre = has_centre || step.floor_centre > 0;
    centre.cells.push_back(step.floor_centre > 0 ? for_people(step.error_centre * 1e3) : "–");
    floor.cells.push_back(for_people(step.floor_box * 1e3));
    p.cells.push_back(for_people(step.p_value));
  }
  if (!steps.empty()) bars.floor = steps.back().floor_box * 1e3;
  section.bars = {bars};
  std::vector<MoreColumn> more{floor};
  if (has_centre) more.insert(more.begin(), centre);
  if (judged) more.push_back(p);
  section.tables = {numbers_of(bars, "step", more)};
  return section;
}

/// Returns the sentence that says what an effect is; empty for a name of none.
std::string sentence_of(const std::string& effect) {
  const EffectRecord* record = find_effect(effect);
  return record == nullptr ? "" : std::string(record->sentence);
}

ReportSection suspects_section(const Diagnosis& diagnosis) {
  ReportSection section;
  section.title = "Suspects, by what each would explain";
  section.folded = true;
  section.paragraphs = {
      "What each effect would explain if it were added and everything else refitted: fall of the misfit, on "
      "the runs fitted to and on box lengths left out. Of what the momentum balance asks for, which needs no "
      "simulation, it is the misfit of the balance."};
  ReportBars bars;
  bars.names = {"fall of the misfit"};
  const auto was_held_out = [](const RankedEffect& r) { return std::isfinite(r.held_out_gain); };
  const bool any_held_out = std::any_of(diagnosis.ranking.begin(), diagnosis.ranking.end(), was_held_out);
  if (any_held_out) bars.names.push_back("of held-out lengths");
  for (const RankedEffect& r : diagnosis.ranking) {
    if (bars.lines.size() == 10) break;
    const bool held_out = was_held_out(r);
    ReportBars::Line line{
        r.effect,
        r.look_alikes.empty() ? sentence_of(r.effect) : "looks like " + joined(r.look_alikes),
        {std::max(0.0, r.gain)},
        {std::nan("")},
        Tone::plain};
    if (held_out)
      line.values.push_back(std::max(0.0, r.held_out_gain)), line.errors.push_back(r.standard_error);
    bars.lines.push_back(line);
  }
  bars.caption = "In units of chi squared.";
  if (any_held_out)
    bars.caption += " Effects without a second bar were judged by their signatures or by the balance only.";
  if (!bars.lines.empty()) section.bars = {bars};
  ReportTable table{"All suspects as numbers", "", {"effect", "fall of misfit"}, {}, true};
  if (any_held_out) table.columns.insert(table.columns.end(), {"held out", "standard error"});
  table.columns.insert(table.columns.end(), {"strength, SI", "looks like"});
  for (const RankedEffect& r : diagnosis.ranking) {
    std::vector<std::string> row{r.effect, for_people(r.gain)};
    if (any_held_out) row.insert(row.end(), {for_people(r.held_out_gain), for_people(r.standard_error)});
    row.insert(row.end(), {for_people(r.value), joined(r.look_alikes)});
    table.rows.push_back(std::move(row));
  }
  section.tables = {table};
  return section;
}

const char* argument_of(ShapeOf of) {
  switch (of) {
    case ShapeOf::position:
    case ShapeOf::damping_at_x:
    case ShapeOf::friction_at_x: return "position of the box, m";
    case ShapeOf::velocity: return "speed of the box, m/s";
    case ShapeOf::damping_at_t:
    case ShapeOf::stiffness_at_t:
    case ShapeOf::time: break;
  }
  return "time, s";
}

const char* value_of(ShapeOf of) {
  switch (of) {
    case ShapeOf::damping_at_x:
    case ShapeOf::damping_at_t: return "damping, N s/m";
    case ShapeOf::stiffness_at_t: return "stiffness, N/m";
    case ShapeOf::friction_at_x: return "friction, N";
    case ShapeOf::position:
    case ShapeOf::velocity:
    case ShapeOf::time: break;
  }
  return "force, N";
}

ReportSection failing_cells(const Diagnosis& diagnosis, ReportSection section) {
  if (diagnosis.where.empty()) return section;
  ReportTable table{diagnosis.missing.empty() ? "The refitted model fails most at"
                                              : "Without the effects found the model fails most at",
                    "Worst first, after allowing for the number of places looked at.",
                    {"run", "observable", "where", "from, s", "to, s", "error, mm", "times its spread"},
                    {},
                    false};
  for (const FailureCell& cell : diagnosis.where) {
    if (table.rows.size() == 12) break;
    const bool timed = cell.to > cell.from;
    table.rows.push_back({cell.run.empty() ? "all" : cell.run, cell.observable, cell.what,
                          timed ? for_people(cell.from) : "–", timed ? for_people(cell.to) : "–",
                          for_people(cell.error * 1e3), for_people(cell.sigmas)});
  }
  section.tables.push_back(table);
  return section;
}

}  // namespace

Report report_of(const Diagnosis& diagnosis, const Measurement& measurement, const Setup& given,
                 const std::vector<MeasuredAgainstModel>& curves, ReportKnobs knobs) {
  Report report;
  report.kind = "diagnose";
  report.title = measurement.title.empty() ? measurement.file : measurement.title;
  report.verdict = verdict_in_words(diagnosis);
  report.sentence = diagnosis.sentence;
  report.tone = tone_of(diagnosis.verdict);
  report.facts = facts_of(diagnosis);
  if (!diagnosis.force_formula.empty())
    report.subtitle = "A force ready to try as user_force: " + diagnosis.force_formula;
  report.opening = answer_of(diagnosis, given);
  if (!diagnosis.next_experiments.empty()) {
    report.opening.emplace_back();
    report.opening.back().title = "What to measure next";
    report.opening.back().list = diagnosis.next_experiments;
  }
  report.knobs = std::move(knobs);
  if (!curves.empty()) {
    report.replays = replays_of(curves);
    report.sections.push_back(curves_section(curves, "Measured against model"));
  }
  report.sections.push_back(ladder_section(diagnosis));
  if (!diagnosis.validation.empty())
    report.sections.back().tables.push_back(validation_table(diagnosis.validation));
  if (!curves.empty()) report.sections.push_back(failing_cells(diagnosis, failure_section(curves)));
  if (!diagnosis.ranking.empty()) report.sections.push_back(suspects_section(diagnosis));
  if (diagnosis.free_restitution) {
    report.sections.push_back(contact_curve_section(diagnosis.free_restitution->curve));
    report.sections.back().list = {
        "Ready for the setup: " +
        curve_as_toml(restitution_against_speed(), diagnosis.free_restitution->setup)};
  }
  report.sections.push_back(momentum_section(diagnosis.momentum));
  if (!curves.empty()) report.sections.push_back(energy_section(curves));
  report.sections.push_back(noise_section(measurement));
  if (!diagnosis.notes.empty()) {
    ReportSection notes;
    notes.title = "Notes";
    notes.list = diagnosis.notes;
    report.sections.push_back(notes);
  }
  say_how_to_reproduce(report, diagnosis.amended);
  if (!curves.empty()) report.health = health_lines(curves);
  return report;
}

}  // namespace shakedown
