// SPDX-License-Identifier: MIT
// shakedown run: a setup through an engine.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "command.hpp"
#include "engines.hpp"
#include "ensemble.hpp"
#include "ensemble_options.hpp"
#include "in_order.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "progress_display.hpp"
#include "readable_summary.hpp"
#include "report_output.hpp"
#include "run_report.hpp"
#include "run_results.hpp"
#include "setup_arguments.hpp"
#include "summary_file.hpp"

namespace shakedown {

namespace {

struct RunArguments {
  SetupArguments setup;
  JsonOutput json;
  ReportOutput report;
  std::string engine = "hard", folder;
  int runs = 1, threads = 0;
  bool every_series = false, log = false;
};

Provenance provenance_of(const RunArguments& arguments, const Setup& setup) {
  Provenance provenance = provenance_of_this_program();
  provenance.engine = arguments.engine;
  provenance.seed = setup.run.seed;
  provenance.runs = arguments.runs;
  provenance.threads = threads_or_all(arguments.threads);
  return provenance;
}

Ensemble ensemble_of(const RunArguments& arguments, const Engine& engine, const Setup& setup,
                     std::optional<RunResults>& results, RunCurves& curves) {
  const std::atomic<bool>* stop = catch_interruption();
  ProgressDisplay display(fmt::format("{}: engine {}, {} run{} of {:g} s", arguments.setup.file,
                                      engine.name(), arguments.runs, arguments.runs == 1 ? "" : "s",
                                      setup.run.duration));
  EnsembleOptions options;
  options.runs = arguments.runs;
  options.execution = {arguments.threads, stop};
  options.progress = [&](double fraction) { display.show(fraction); };
  const bool shown = arguments.report.wanted(arguments.folder);
  options.log_collisions = arguments.log || (!arguments.report.file.empty() && arguments.runs == 1);
  options.each = [&, shown](int run, const Trajectory& trajectory, const Observables& observables) {
    if (results) results->add(run, trajectory, observables);
    if (shown) curves.add(trajectory);
  };
  return run_ensemble(engine, setup, options);
}

void refuse_what_cannot_be_written(const RunArguments& arguments, const Setup& setup) {
  std::vector<Violation> found;
  for (const auto& [option, wanted] :
       {std::pair{"--every-series", arguments.every_series}, std::pair{"--log", arguments.log}})
    if (wanted && arguments.folder.empty())
      found.push_back({{}, option, "has nowhere to be written", "add --out DIR"});
  if (arguments.log && arguments.engine != "hard")
    found.push_back({{},
                     "--log",
                     "the engine " + arguments.engine + " has contacts that last, not collisions",
                     "take --engine hard"});
  if (arguments.log && setup.domain == Domain::periodic)
    found.push_back(
        {{}, "--log", "a periodic cell has no log", "take domain.kind = \"damper\" or \"closed\""});
  if (!found.empty()) throw InputError(std::move(found));
}

int run_setup(const RunArguments& arguments) {
  const Setup setup = arguments.setup.read();
  const std::unique_ptr<Engine> engine = engine_named(arguments.engine);
  refuse_what_is_not_modelled(*engine, setup);
  refuse_what_cannot_be_written(arguments, setup);
  arguments.json.check();
  arguments.report.check();
  std::optional<RunResults> results;
  if (!arguments.folder.empty())
    results.emplace(OutputFolder(arguments.folder, OutputFolder::Use::alone), arguments.every_series);
  if (results && arguments.log) results->keep_collisions_of(setup);
  const Provenance provenance = provenance_of(arguments, setup);

  RunCurves curves;
  const Ensemble ensemble = ensemble_of(arguments, *engine, setup, results, curves);
  if (ensemble.runs.empty()) throw Interrupted("no run had finished, nothing was kept");
  if (results) results->finish(ensemble, setup, provenance);
  PaperValues(setup).print(arguments.json.for_people());
  fmt::print(arguments.json.for_people(), "{}", readable_summary(ensemble, setup));
  if (results)
    fmt::print(arguments.json.for_people(), "  results in {}\n", results->folder().path().string());
  if (arguments.report.wanted(arguments.folder))
    fmt::print(
        arguments.json.for_people(), "{}",
        arguments.report.write(curves.report(ensemble, setup, arguments.setup.file), arguments.folder));
  if (arguments.json.wanted)
    arguments.json.write(summary_json(ensemble, setup));  // long runs have millions of peaks
  return ensemble.interrupted ? exit_interrupted : exit_done;
}

}  // namespace

Command add_run_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("run", "run a setup through an engine");
  const auto arguments = std::make_shared<RunArguments>();
  add_setup_arguments(command, arguments->setup);
  std::string names;
  for (const std::string& name : engine_names()) names += (names.empty() ? "" : ", ") + name;
  command.add_option("--engine", arguments->engine, "one of " + names + ", or command:PROGRAM")
      ->type_name("NAME")
      ->capture_default_str();
  add_keep_option(command);
  command
      .add_option("--out", arguments->folder,
                  "write series, summary, setup as used and provenance into this folder")
      ->type_name("DIR");
  command
      .add_option("--runs", arguments->runs,
                  "runs that differ by their random numbers only; results as mean and spread")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N")
      ->capture_default_str();
  add_threads_option(command, arguments->threads);
  command.add_flag("--every-series", arguments->every_series,
                   "with --out: the series of every run, not only of the first");
  add_report_option(command, arguments->report);
  command.add_flag("--log", arguments->log,
                   "with --out: the collision log, from which `shakedown export` and reports rebuild the "
                   "motion at any time");
  add_json_option(command, arguments->json);
  return {&command, [arguments] { return run_setup(*arguments); }};
}

}  // namespace shakedown
