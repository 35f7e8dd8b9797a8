// SPDX-License-Identifier: MIT
#include "report_joined.hpp"

#include <algorithm>

#include "errors.hpp"

namespace shakedown {

namespace {

void put_before(std::string& group, const std::string& name) {
  group = group.empty() ? name : name + ": " + group;
}

void rename_groups(Report& report, const std::string& name) {
  for (ReportReplay& replay : report.replays) put_before(replay.group, name);
  for (ReportSection& section : report.opening) section.title = name + ": " + section.title;
  for (ReportSection& section : report.sections) {
    section.title = name + ": " + section.title;
    for (ReportPlot& plot : section.plots) put_before(plot.group, name);
    for (ReportStrip& strip : section.strips)
      for (ReportStrip::Row& row : strip.rows) put_before(row.group, name);
  }
}

template <class T>
void move_to_end(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

Report joined(std::vector<NamedReport> reports) {
  EXPECT(!reports.empty());
  if (reports.size() == 1) return std::move(reports.front().report);
  Report all;
  all.kind = "report";
  ReportTable verdicts{"Results", "", {"result", "command", "verdict", "in a sentence"}, {}, false};
  ReportSection first;
  first.title = "Side by side";
  for (auto& [name, report] : reports) {
    rename_groups(report, name);
    all.title += (all.title.empty() ? "" : ", ") + name;
    verdicts.rows.push_back({name, report.kind, report.verdict, report.sentence});
    all.command += report.command + "\n";
    all.setup += "# " + name + "\n" + report.setup + "\n";
    all.program = report.program;
    move_to_end(all.replays, report.replays);
    move_to_end(all.sections, report.opening);
    move_to_end(all.sections, report.sections);
    for (std::string& line : report.health) line = name + ": " + line;
    move_to_end(all.health, report.health);
    for (std::string& line : report.citations)
      if (std::find(all.citations.begin(), all.citations.end(), line) == all.citations.end())
        all.citations.push_back(line);
  }
  all.sentence = std::to_string(reports.size()) + " results side by side";
  first.tables = {verdicts};
  all.sections.insert(all.sections.begin(), first);
  return all;
}

}  // namespace shakedown
