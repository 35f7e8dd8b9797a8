// SPDX-License-Identifier: MIT
// shakedown fit: parameters of the model from some runs of an experiment, and how well it foretells the
// others.
#include "fit.hpp"

#include <fmt/format.h>

#include <memory>

#include "comma_list.hpp"
#include "command.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "experiment.hpp"
#include "fitted.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "measured_data.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "report_output.hpp"
#include "setup_arguments.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

struct FitArguments {
  SetupArguments setup;
  JsonOutput json;
  ReportOutput report;
  std::string data, on, out;
  FitQuestion question;
  int count = 160, threads = 0;
};

int fit(const FitArguments& arguments) {
  Setup setup = arguments.setup.read(given_by_measurements);
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const Measurement measurement = measurement_of(setup, read_measured(arguments.data, setup), all_effects());
  check(arguments.question, setup);  // throws before long work
  arguments.json.check();
  arguments.report.check();
  std::unique_ptr<OutputFolder> folder;
  if (!arguments.out.empty())
    folder = std::make_unique<OutputFolder>(arguments.out, OutputFolder::Use::alone);
  FitOptions options = usual_fit_options();
  options.on = names_in(arguments.on);
  options.count = arguments.count;
  options.execution = {arguments.threads, catch_interruption()};
  Fit found;
  {
    ProgressDisplay display(fmt::format("{}: fitting", arguments.data));
    const double about = 12.0 * options.count;  // rounds; more when the start is far off
    options.progress = [&](const std::string& stage, std::int64_t runs) {
      display.rename(stage);
      display.show(std::min(0.99, static_cast<double>(runs) / about));
    };
    found = fitted_and_judged(setup, measurement, arguments.question, *engine, options);
  }
  const PaperValues taken(setup, given_by_measurements);
  const std::string document = taken.added_to(fit_json(found));
  taken.print(arguments.json.for_people());
  fmt::print(arguments.json.for_people(), "{}", fit_text(found));
  if (folder) {
    folder->write("setup.toml",
                  "# Fitted by `shakedown fit` to " + arguments.data + "\n" + write_setup(found.fitted));
    folder->write("fit.json", document);
  }
  if (arguments.report.wanted(arguments.out))
    fmt::print(arguments.json.for_people(), "{}",
               arguments.report.write(
                   report_of(found, setup, measurement, *engine, {arguments.threads, catch_interruption()}),
                   arguments.out));
  arguments.json.write(document);
  return found.judgement.holds() ? exit_done : exit_model_rejected;
}

}  // namespace

Command add_fit_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "fit", "parameters of the model from measurements, and the error on runs left out");
  const auto arguments = std::make_shared<FitArguments>();
  add_setup_arguments(command, arguments->setup);
  command.add_option("--data", arguments->data, "experiment file")->type_name("EXPERIMENT")->required();
  command
      .add_option("--free", arguments->question.free,
                  "keys to fit, starting at the setup's values; keys joined by & move together")
      ->type_name("KEY,KEY,...")
      ->required();
  command
      .add_option("--restitution-curve", arguments->question.restitution_curve,
                  "fit restitution as a free function of the closing speed too, for all contacts, those of "
                  "grains, or those of walls, and say whether a constant would do as well")
      ->type_name("all|grains|walls");
  command
      .add_option("--friction-curve", arguments->question.friction_curve,
                  "fit friction as a free function of the slip speed too, in a setup with friction whose "
                  "coefficients are free, and say whether a constant would do as well")
      ->type_name("all|grains|walls");
  command.add_option("--on", arguments->on, "fit these runs only, foretell the others")
      ->type_name("RUN,RUN,...");
  command
      .add_option("--out", arguments->out,
                  "write the fitted setup, fit.json and what `shakedown report` needs into this folder")
      ->type_name("DIR");
  add_report_option(command, arguments->report);
  add_simulations_option(command, arguments->count, 32, "simulations of each different setup in a round");
  add_threads_option(command, arguments->threads);
  add_json_option(command, arguments->json);
  command.footer(
      "Exit code 0: the fitted model holds by the rule of compare. 1: it fails, or that is undecided.");
  return {&command, [arguments] { return fit(*arguments); }};
}

}  // namespace shakedown
