// SPDX-License-Identifier: MIT
// shakedown paper: the paper's table, figures and statements.
#include "paper.hpp"

#include <fmt/format.h>

#include <memory>

#include "ensemble_options.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "output_file.hpp"
#include "paper_report.hpp"
#include "progress_display.hpp"
#include "report_output.hpp"
#include "study_commands.hpp"

namespace shakedown {

namespace {

struct PaperArguments {
  std::string folder;
  JsonOutput json;
  ReportOutput report;
  bool quick = false;
  int threads = 0;
};

int paper(const PaperArguments& arguments) {
  arguments.json.check();
  arguments.report.check();
  const OutputFolder folder(arguments.folder);
  Paper found;
  {
    ProgressDisplay display("the paper");
    PaperOptions options{arguments.quick, {arguments.threads, catch_interruption()}, {}};
    options.progress = [&](const std::string& stage, double fraction) {
      display.rename(stage);
      display.show(fraction);
    };
    found = reproduce_paper(options);
  }
  for (const Chart& chart : found.charts) {
    folder.write(chart.name + ".svg", svg_of(chart));
    folder.write(chart.name + ".csv", csv_of(chart));
  }
  folder.write("table_1.csv", table_1_csv());
  folder.write("statements.csv", statements_csv(found.statements));
  folder.write("paper.json", paper_json(found));
  folder.write("paper.md", paper_markdown(found));
  for (const Statement& s : found.statements)
    fmt::print(arguments.json.for_people(), "  {:<15} {:<26} (paper: {})\n{:18}holds when {}\n",
               name_of(s.judgement), s.name, s.paper, "", s.rule);
  fmt::print(arguments.json.for_people(), "{:.0f} s; read {}\n", found.seconds,
             (folder.path() / "paper.md").string());
  fmt::print(arguments.json.for_people(), "{}", arguments.report.write(report_of(found), arguments.folder));
  arguments.json.write(paper_json(found));
  return exit_done;
}

}  // namespace

Command add_paper_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("paper", "the paper's table, figures and statements, judged");
  const auto arguments = std::make_shared<PaperArguments>();
  command
      .add_option("--out", arguments->folder,
                  "folder for figures (CSV and SVG) and statements (Markdown, JSON, CSV)")
      ->required()
      ->type_name("DIR");
  command.add_flag("--quick", arguments->quick, "few runs: two minutes of processor time instead of five");
  add_threads_option(command, arguments->threads);
  add_report_option(command, arguments->report);
  add_json_option(command, arguments->json);
  return {&command, [arguments] { return paper(*arguments); }};
}

}  // namespace shakedown
