// SPDX-License-Identifier: MIT
// shakedown compare: is the model acceptable, and where does it fail? Nothing is fitted.
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "compared.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "experiment.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "knobs_report.hpp"
#include "measured_data.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "report_output.hpp"
#include "setup_arguments.hpp"

namespace shakedown {

namespace {

struct CompareArguments {
  std::string engine = "hard";
  SetupArguments setup;
  JsonOutput json;
  ReportOutput report;
  std::string data, out;
  int runs = 128, threads = 0;
};

int compare(const CompareArguments& arguments) {
  Setup setup = arguments.setup.read(given_by_measurements);
  const Measurement recorded = measurement_of(setup, read_measured(arguments.data, setup), all_effects());
  arguments.json.check();
  arguments.report.check();
  std::unique_ptr<OutputFolder> folder;
  if (!arguments.out.empty())
    folder = std::make_unique<OutputFolder>(arguments.out, OutputFolder::Use::alone);
  const std::unique_ptr<Engine> engine = engine_named(arguments.engine);
  Compared compared;
  {
    ProgressDisplay display(
        fmt::format("{}: comparing with {} runs of each setup", arguments.data, arguments.runs));
    compared =
        compared_with(setup, recorded, *engine,
                      {arguments.runs, {arguments.threads, catch_interruption()}, [&](double fraction) {
                         display.show(fraction);
                       }});
  }
  const PaperValues taken(setup, given_by_measurements);
  const std::string document = taken.added_to(compared_json(compared));
  taken.print(arguments.json.for_people());
  fmt::print(arguments.json.for_people(), "{}", compared_text(compared));
  if (folder) folder->write("compare.json", document);
  if (arguments.report.wanted(arguments.out))
    fmt::print(
        arguments.json.for_people(), "{}",
        arguments.report.write(report_of(compared, setup, *engine, {arguments.threads, catch_interruption()}),
                               arguments.out));
  arguments.json.write(document);
  return compared.judgement.holds() ? exit_done : exit_model_rejected;
}

}  // namespace

Command add_compare_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "compare", "is the model acceptable for these measurements, and where does it fail");
  const auto arguments = std::make_shared<CompareArguments>();
  add_setup_arguments(command, arguments->setup);
  command.add_option("--data", arguments->data, "experiment file")->type_name("EXPERIMENT")->required();
  add_simulations_option(command, arguments->runs);
  add_threads_option(command, arguments->threads);
  command
      .add_option("--out", arguments->out,
                  "write compare.json and what `shakedown report` needs into this folder")
      ->type_name("DIR");
  add_report_option(command, arguments->report);
  command.add_option("--engine", arguments->engine, "hard, soft, bullet, lammps or command:PROGRAM")
      ->type_name("NAME")
      ->capture_default_str();
  add_keep_option(command);
  add_json_option(command, arguments->json);
  command.footer(
      "Exit code 0: the model holds. 1: it fails, or that is undecided. The rule, the same for compare, "
      "ladder,\n"
      "fit and diagnose: a model fails where the momentum balance has p <= 0.001, or the features p <= 0.01 "
      "with a\n"
      "misfit of 1.4 times that of the model's own runs or more, or where more than 2.5 times noise and "
      "spread from\n"
      "run to run remain; with a smaller misfit it is undecided, for two codes of one physics differ by as "
      "much, and\n"
      "so it is where a p-value could not be computed.");
  return {&command, [arguments] { return compare(*arguments); }};
}

}  // namespace shakedown
