// SPDX-License-Identifier: MIT
#include "strength_mapped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "answer_sections.hpp"
#include "page_figures.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

/// Returns the things that are varied, each with its lines.
std::vector<std::vector<std::size_t>> families_of(const StrengthMap& map) {
  std::vector<std::vector<std::size_t>> families;
  for (std::size_t l = 0; l < map.lines.size(); ++l) {
    const std::string& varied = map.lines[l].varied;
    if (varied.empty()) continue;
    if (families.empty() || map.lines[families.back().front()].varied != varied) families.emplace_back();
    families.back().push_back(l);
  }
  return families;
}

std::size_t as_planned(const StrengthMap& map) {
  for (std::size_t l = 0; l < map.lines.size(); ++l)
    if (map.lines[l].varied.empty()) return l;
  return 0;
}

bool is_seen(double smallest) { return std::isfinite(smallest) && smallest > 0; }

std::string cell(const MappedEffect& effect, std::size_t line) {
  const double smallest = effect.smallest[line];
  return is_seen(smallest) ? for_people(smallest / read_unit(effect.key).factor) : "–";
}

std::string with_unit(const std::string& name, const MappedEffect& effect) {
  const std::string unit = read_unit(effect.key).unit;
  return name + (unit.empty() ? "" : ", " + unit);
}
std::string name_with_unit(const MappedEffect& effect) { return with_unit(effect.key, effect); }

const char* const what_is_told =
    "The smallest strength that half of such experiments would show (more probable than 95 % beside nothing, "
    "restitutions, frequency and camera free within what is known of them); –: not even the strongest that a "
    "diagnosis looks for. Of a length (a pendulum) the longest.";

ReportTable table_of(const StrengthMap& map, const std::vector<std::size_t>& family) {
  ReportTable table{map.lines[family.front()].varied, "", {"strength"}, {}, false};
  for (const std::size_t line : family) table.columns.push_back(map.lines[line].value);
  for (const MappedEffect& effect : map.effects) {
    table.rows.push_back({with_unit(words_of_key(effect.key), effect)});
    for (const std::size_t line : family) table.rows.back().push_back(cell(effect, line));
  }
  return table;
}

/// Returns the bars of the experiment as planned, in typical strengths: what is above one is hardly found.
ReportBars planned_bars(const StrengthMap& map) {
  ReportBars bars{
      "",
      "Smallest strength that would be seen, by the typical strength of each effect. What ends left "
      "of the line is seen at its typical strength.",
      "",
      {"times the typical strength"},
      {},
      1,
      "typical"};
  const std::size_t line = as_planned(map);
  constexpr double most = 10;
  for (const MappedEffect& effect : map.effects) {
    const double smallest = effect.smallest[line];
    if (!is_seen(smallest) || !(effect.typical > 0)) continue;
    const bool length = read_unit(effect.key).unit == "mm" && effect.key.ends_with("length");
    const double times = length ? std::pow(effect.typical / smallest, 2) : smallest / effect.typical;
    bars.lines.push_back({words_of_key(effect.key),
                          cell(effect, line) + " " + read_unit(effect.key).unit,
                          {std::min(most, times)}});
  }
  std::stable_sort(bars.lines.begin(), bars.lines.end(),
                   [](const auto& a, const auto& b) { return a.values[0] < b.values[0]; });
  return bars;
}

ReportPlot plot_of(const StrengthMap& map, const MappedEffect& effect,
                   const std::vector<std::size_t>& family) {
  ReportPlot plot;
  const MapLine& first = map.lines[family.front()];
  const ReadUnit read = read_unit(effect.key);
  const char* unit = first.varied.starts_with("shutter")                                       ? ", ms"
                     : first.varied.starts_with("noise") || first.varied.starts_with("wander") ? ", mm"
                                                                                               : "";
  plot.title = "Against: " + first.varied;
  plot.group = words_of_key(effect.key);
  plot.x_label = first.varied + unit;
  plot.y_label = "smallest strength" + (read.unit.empty() ? "" : ", " + read.unit);
  std::vector<std::pair<double, double>> points;
  for (const std::size_t line : family)
    points.emplace_back(map.lines[line].number,
                        is_seen(effect.smallest[line]) ? effect.smallest[line] / read.factor : std::nan(""));
  std::sort(points.begin(), points.end());
  ReportCurve curve{"would be seen above", CurveRole::model, {}};
  for (const auto& [x, y] : points) plot.x.push_back(x), curve.y.push_back(y);
  plot.curves = {std::move(curve)};
  return plot;
}

}  // namespace

std::string map_text(const StrengthMap& map) {
  std::string text = std::string(what_is_told) + "\n";
  std::size_t widest = 10;
  for (const MappedEffect& effect : map.effects) widest = std::max(widest, name_with_unit(effect).size());
  for (const std::vector<std::size_t>& family : families_of(map)) {
    text += fmt::format("\n{:<{}}", map.lines[family.front()].varied, widest + 2);
    for (const std::size_t line : family) text += fmt::format("{:>10}", map.lines[line].value);
    text += "\n";
    for (const MappedEffect& effect : map.effects) {
      text += fmt::format("  {:<{}}", name_with_unit(effect), widest);
      for (const std::size_t line : family) text += fmt::format("{:>10}", cell(effect, line));
      text += "\n";
    }
  }
  for (const StrengthMap::LeftOut& one : map.left_out)
    text += fmt::format("left out: {} ({})\n", one.key, one.reason);
  return text + fmt::format("{} simulations in {:.0f} s\n", map.simulations, map.seconds);
}

std::string map_json(const StrengthMap& map) {
  nlohmann::ordered_json lines = nlohmann::ordered_json::array(), effects = lines, left_out = lines;
  for (const MapLine& line : map.lines)
    lines.push_back({{"varied", line.varied.empty() ? "as planned" : line.varied},
                     {"value", line.value},
                     {"number", line.number}});
  for (const MappedEffect& effect : map.effects) {
    nlohmann::ordered_json smallest = nlohmann::ordered_json::array();
    for (const double one : effect.smallest)
      smallest.push_back(is_seen(one) ? nlohmann::ordered_json(one) : nlohmann::ordered_json(nullptr));
    effects.push_back({{"effect", effect.effect},
                       {"key", effect.key},
                       {"unit", effect.unit},
                       {"typical", effect.typical},
                       {"smallest", smallest}});
  }
  for (const StrengthMap::LeftOut& one : map.left_out)
    left_out.push_back({{"key", one.key}, {"reason", one.reason}});
  return nlohmann::ordered_json{{"schema_version", 1},
                                {"lines", lines},
                                {"effects", effects},
                                {"left_out", left_out},
                                {"simulations", map.simulations},
                                {"seconds", map.seconds}}
             .dump(2) +
         "\n";
}

Report report_of(const StrengthMap& map, const Setup& setup, const std::string& design) {
  Report report;
  report.kind = "hide --map";
  report.title = design;
  report.sentence = "How good must the camera be? The smallest strength of each effect that would be seen.";
  report.subtitle = design;
  ReportSection planned;
  planned.title = "As planned";
  planned.paragraphs = {what_is_told};
  planned.bars = {planned_bars(map)};
  ReportSection plots, tables;
  plots.title = "Effect by effect";
  tables.title = "Tables";
  for (const std::vector<std::size_t>& family : families_of(map)) {
    tables.tables.push_back(table_of(map, family));
    for (const MappedEffect& effect : map.effects) plots.plots.push_back(plot_of(map, effect, family));
  }
  report.opening = {planned};
  report.sections = {plots, tables};
  if (!map.left_out.empty()) {
    ReportSection left_out;
    left_out.title = "Left out";
    for (const StrengthMap::LeftOut& one : map.left_out) left_out.list.push_back(one.key + ": " + one.reason);
    report.sections.push_back(left_out);
  }
  say_how_to_reproduce(report, setup);
  return report;
}

}  // namespace shakedown
