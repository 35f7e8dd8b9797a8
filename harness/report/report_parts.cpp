// SPDX-License-Identifier: MIT
#include "report_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page_figures.hpp"
#include "provenance.hpp"
#include "setup_file.hpp"

namespace shakedown {

std::vector<std::string> citations_of(const Setup& setup) {
  std::vector<std::string> lines;
  for (const EffectChoice& choice : setup.effects)
    lines.push_back(std::string(choice.record->name) + ": " + std::string(choice.record->source));
  return lines;
}

std::string this_command() {
  std::string line;
  for (const std::string& word : provenance_of_this_program().command) {
    const bool plain = word.find_first_of(" \t'\"$&|;<>()*?") == std::string::npos && !word.empty();
    line += line.empty() ? "shakedown" : plain ? " " + word : " '" + word + "'";
  }
  return line;
}

ReportPlot time_plot(std::string title, std::string y_label, std::string group, std::vector<double> time) {
  ReportPlot plot;
  plot.title = std::move(title);
  plot.x_label = "time since release, s";
  plot.y_label = std::move(y_label);
  plot.group = std::move(group);
  plot.over_time = true;
  plot.x = std::move(time);
  return plot;
}

std::vector<ReportCurve> band(std::string name, std::vector<double> low, std::vector<double> high) {
  return {{"", CurveRole::band_low, std::move(low)},
          {std::move(name), CurveRole::band_high, std::move(high)}};
}

namespace {

bool is_nothing(const std::vector<double>& values) {
  return std::none_of(values.begin(), values.end(), [](double v) { return std::isfinite(v) && v != 0; });
}

/// Returns what the other curves leave of the energy at the beginning: effects took it, or put it in where it
/// is less than nothing.
std::vector<double> taken_by_effects(const std::vector<double>& left,
                                     const std::array<std::vector<double>, contact_classes>& lost) {
  double whole = std::nan("");
  std::vector<double> taken;
  for (std::size_t i = 0; i < left.size(); ++i) {
    double sum = left[i];
    for (const std::vector<double>& of_class : lost) sum += of_class[i];
    if (!std::isfinite(whole)) whole = sum;
    taken.push_back(whole - sum);
  }
  constexpr double shown = 1e-3;  // of the whole: less is what the ledgers of the engines leave open at most
  const bool some =
      std::any_of(taken.begin(), taken.end(), [&](double e) { return std::abs(e) > shown * whole; });
  return some ? taken : std::vector<double>{};
}

}  // namespace

ReportPlot energy_plot(std::string group, std::vector<double> time, std::vector<double> left,
                       const std::array<std::vector<double>, contact_classes>& lost) {
  ReportPlot plot = time_plot("Energy", "energy, mJ", std::move(group), std::move(time));
  std::vector<double> taken = taken_by_effects(left, lost);
  plot.curves = {{"left", CurveRole::model, std::move(left)}};
  const std::array<const char*, contact_classes> names{"lost between grains", "lost at end walls",
                                                       "lost at side walls"};
  for (std::size_t c = 0; c < contact_classes; ++c)
    if (!is_nothing(lost[c])) plot.curves.push_back({names[c], CurveRole::other, lost[c]});
  if (!taken.empty()) plot.curves.push_back({"taken by effects", CurveRole::other, std::move(taken)});
  return plot;
}

ReportTable numbers_of(const ReportBars& bars, std::string first_column,
                       const std::vector<MoreColumn>& more) {
  ReportTable table{"The same as numbers", "", {std::move(first_column)}, {}, true};
  for (const std::string& name : bars.names)
    table.columns.push_back(bars.unit.empty() ? name : name + ", " + bars.unit);
  for (const MoreColumn& column : more) table.columns.push_back(column.title);
  for (std::size_t i = 0; i < bars.lines.size(); ++i) {
    std::vector<std::string> row{bars.lines[i].label};
    for (const double value : bars.lines[i].values) row.push_back(for_people(value));
    for (const MoreColumn& column : more) row.push_back(column.cells[i]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Health worse_of(Health a, const Health& b) {
  a.ledger_error = std::max(a.ledger_error, b.ledger_error);
  a.momentum_error = std::max(a.momentum_error, b.momentum_error);
  a.deepest_overlap = std::max(a.deepest_overlap, b.deepest_overlap);
  a.elastic_rescues += b.elastic_rescues;
  a.refused_events += b.refused_events;
  for (const std::string& note : b.notes)
    if (std::find(a.notes.begin(), a.notes.end(), note) == a.notes.end()) a.notes.push_back(note);
  return a;
}

std::vector<std::string> health_in_words(const Health& worst, const std::string& of) {
  std::vector<std::string> lines{
      fmt::format("{}: energy ledger open by {:.1e} of the initial energy, momentum off by {:.1e}, deepest "
                  "overlap {:.1e} m.",
                  of, worst.ledger_error, worst.momentum_error, worst.deepest_overlap)};
  lines.insert(lines.end(), worst.notes.begin(), worst.notes.end());
  return lines;
}

void say_how_to_reproduce(Report& report, const Setup& setup) {
  report.command = this_command();
  report.setup = write_setup(setup);
  report.program = version_line();
  report.citations = citations_of(setup);
}

}  // namespace shakedown
