// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "paper.hpp"
#include "text.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string readable_line(const Finding& finding) {
  if (std::isnan(finding.value)) return "none";
  const std::string unit = finding.unit.empty() ? "" : " " + finding.unit;
  if (std::isnan(finding.low) || finding.low == finding.high)
    return fmt::format("{:.4g}{}", finding.value, unit);
  return fmt::format("{:.4g}{} ({:.4g} to {:.4g})", finding.value, unit, finding.low, finding.high);
}

std::string diagnosis_markdown(const Diagnosis& diagnosis) {
  if (diagnosis.ladder.empty()) return "";
  std::string text =
      "\nDiagnosis of the model with 0.95 held fixed and no friction, from the two runs at L = 40 mm "
      "alone: " +
      diagnosis.sentence +
      "\n\n| step | error of x_box, mm | noise and spread, mm | p |\n|---|---|---|---|\n";
  for (const LadderStep& step : diagnosis.ladder)
    text += fmt::format("| {} | {:.2f} | {:.2f} | {:.3f} |\n", step.step, 1e3 * step.error_box,
                        1e3 * step.floor_box, step.p_value);
  text += "\n";
  for (const DiagnosedParameter& p : diagnosis.parameters)
    if (p.word.empty())
      text += fmt::format("- {}: {:.4g} ({:.4g} to {:.4g}) {}\n", p.name, p.value, p.low, p.high, p.unit);
  return text;
}

std::string puzzle_markdown(const Puzzle& puzzle) {
  std::string text =
      "\n## The puzzle: 0.95 or 0.75?\n\nLaboratory: soft engine, grain-grain restitution 0.95, grain-wall "
      "0.76, Coulomb friction of grains and walls, two filmed runs at L = 40 mm (noise 0.2 mm and "
      "0.5 mm). The frictionless hard model is fitted to them.\n\n| friction | grain-grain restitution, wall "
      "known (95 %) | both fitted: grain-grain | grain-wall |\n|---|---|---|---|\n";
  for (const PuzzlePoint& point : puzzle.points) {
    const auto interval = [](const FittedParameter& p) {
      return fmt::format("{:.3f} ({:.3f} to {:.3f})", p.value, p.low, p.high);
    };
    const bool has_both = point.both.parameters.size() == 2;
    text += fmt::format("| {:g} | {} | {} | {} |\n", point.friction, interval(point.one.parameters[0]),
                        has_both ? interval(point.both.parameters[0]) : "-",
                        has_both ? interval(point.both.parameters[1]) : "-");
  }
  text += fmt::format(
      "\nThe smallest of these frictions whose fit is 0.75 (95 % interval and rounding): {:g}.\n\nWith "
      "friction {:g} in the laboratory, rms error of x_box on the lengths that were not fitted, mm (spread "
      "that noise, chaos and the fit's own uncertainty make):\n\n| model |",
      friction_that_looks_like(puzzle, 0.75), puzzle.friction);
  for (const std::string& run : puzzle.models.front().runs) text += " " + run + " |";
  text += "\n|---|";
  for (std::size_t i = 0; i < puzzle.models.front().runs.size(); ++i) text += "---|";
  for (const PuzzleModel& model : puzzle.models) {
    text += "\n| " + model.name + " |";
    for (std::size_t i = 0; i < model.error.size(); ++i)
      text += fmt::format(" {:.2f} ({:.2f}) |", 1e3 * model.error[i], 1e3 * model.spread[i]);
  }
  const FittedParameter& p = puzzle.with_friction.parameters.front();
  text += fmt::format("\n\nFriction fitted to L = 40 mm with 0.95 fixed: {:.3f} ({:.3f} to {:.3f}).\n",
                      p.value, p.low, p.high);
  return text + diagnosis_markdown(puzzle.diagnosis);
}

Json puzzle_json(const Puzzle& puzzle) {
  Json points = Json::array(), models = Json::array();
  const auto fit = [](const Fit& found) {
    Json list = Json::array();
    for (const FittedParameter& p : found.parameters)
      list.push_back(
          {{"key", p.key}, {"value", p.value}, {"low", p.low}, {"high", p.high}, {"told", p.told}});
    return list;
  };
  for (const PuzzlePoint& point : puzzle.points)
    points.push_back(
        {{"friction", point.friction}, {"wall_known", fit(point.one)}, {"both", fit(point.both)}});
  for (const PuzzleModel& model : puzzle.models) {
    Json runs = Json::array();
    for (std::size_t i = 0; i < model.runs.size(); ++i)
      runs.push_back({{"run", model.runs[i]},
                      {"error_box_mm", 1e3 * model.error[i]},
                      {"spread_box_mm", 1e3 * model.spread[i]}});
    models.push_back({{"model", model.name}, {"runs", runs}});
  }
  return {{"points", points},
          {"friction_that_looks_like_0.75", number(friction_that_looks_like(puzzle, 0.75))},
          {"laboratory_friction", puzzle.friction},
          {"models", models},
          {"friction_fitted", fit(puzzle.with_friction)},
          {"diagnosis",
           puzzle.diagnosis.ladder.empty() ? Json(nullptr) : Json::parse(diagnosis_json(puzzle.diagnosis))}};
}

}  // namespace

std::string table_1_csv() {
  const Setup setup;
  return fmt::format(
      "sigma_mm,m_g,N,Delta0_mm,frequency_hz,M_g,eps_pp,eps_pw\n{:g},{:g},{},{:g},{:g},{:g},{:g},{:g}\n",
      1e3 * setup.grains.diameter, 1e3 * setup.grains.mass, setup.grains.count,
      1e3 * setup.release.displacement, setup.spring.frequency, 1e3 * setup.box.mass,
      setup.restitution.grain_grain, setup.restitution.grain_wall);
}

std::string statements_csv(const std::vector<Statement>& statements) {
  std::string text = "statement,paper,judgement,rule,finding,value,low,high,unit\n";
  for (const Statement& s : statements)
    for (const Finding& f : s.findings)
      text += fmt::format("{},{},{},{},{},{:.6g},{:.6g},{:.6g},{}\n", csv_cell(s.name), csv_cell(s.paper),
                          name_of(s.judgement), csv_cell(s.rule), csv_cell(f.what), f.value, f.low, f.high,
                          csv_cell(f.unit));
  return text;
}

std::string paper_json(const Paper& paper) {
  Json statements = Json::array();
  for (const Statement& s : paper.statements) {
    Json findings = Json::array();
    for (const Finding& f : s.findings)
      findings.push_back({{"what", f.what},
                          {"value", number(f.value)},
                          {"low", number(f.low)},
                          {"high", number(f.high)},
                          {"unit", f.unit}});
    statements.push_back({{"name", s.name},
                          {"text", s.text},
                          {"paper", s.paper},
                          {"rule", s.rule},
                          {"judgement", name_of(s.judgement)},
                          {"findings", findings},
                          {"remark", s.remark}});
  }
  return Json{{"schema_version", 1}, {"statements", statements}, {"puzzle", puzzle_json(paper.runs.puzzle)}}
             .dump(2) +
         "\n";
}

std::string paper_markdown(const Paper& paper) {
  std::string text =
      "# Movers and shakers, on trial\n\nNumbers are means with 95 % intervals of the mean. Every figure is "
      "a CSV and an SVG beside this file; Table I is table_1.csv.\n\n| statement | paper | verdict | it "
      "holds when |\n|---|---|---|---|\n";
  for (const Statement& s : paper.statements)
    text += fmt::format("| {} | {} | **{}** | {} |\n", s.text, s.paper, name_of(s.judgement), s.rule);
  for (const Statement& s : paper.statements) {
    text += fmt::format("\n## {}: {}\n\n{} Paper: {}.\nIt holds when: {}.\n\n", s.name, name_of(s.judgement),
                        s.text, s.paper, s.rule);
    for (const Finding& f : s.findings) text += "- " + f.what + ": " + readable_line(f) + "\n";
    if (!s.remark.empty()) text += "\n" + s.remark + "\n";
  }
  text += puzzle_markdown(paper.runs.puzzle);
  text +=
      "\n## Misprints\n\n- Largest second derivative of f: printed Delta omega^2, is Delta (2 pi "
      "omega)^2.\n- New phase of the box: printed with Delta p_Box + v_Box and prefactor 1/omega, is v_Box + "
      "Delta p_Box / M and 1/(2 pi omega).\n"
      "- Elastic limit: without magnitude.\n- n + 1/4 > omega t_g,peak > n + 1: the signs are the wrong way "
      "round.\n- 2n + 1 - (-1)^(2n) is 2n.\n- Caption of Fig. comp2: L = 65 mm, not 40 mm.\n";
  for (const Chart& chart : paper.charts) text += fmt::format("\n![{}]({}.svg)\n", chart.title, chart.name);
  return text;
}

}  // namespace shakedown
