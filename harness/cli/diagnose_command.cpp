// SPDX-License-Identifier: MIT
// shakedown diagnose: which effect is missing in the model, how strong is it, and does the error fall when it
// is added.
#include "diagnosis.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "comma_list.hpp"
#include "command.hpp"
#include "diagnosed.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "experiment.hpp"
#include "in_order.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "kept_simulations.hpp"
#include "measured_data.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "provenance.hpp"
#include "report_output.hpp"
#include "setup_arguments.hpp"
#include "simulation_journal.hpp"
#include "unlisted_force.hpp"

namespace shakedown {

namespace {

struct DiagnoseArguments {
  SetupArguments setup;
  JsonOutput json;
  ReportOutput report;
  std::string data, out, effects, fixed, engine = "hard";
  std::int64_t budget = 0;
  double seconds = 300;
  int threads = 0;
  bool resume = false;
};

/// Writes the amended setup, what is to be tried where nothing of the list explains the data, and all of it
/// as JSON.
void write_answer(OutputFolder& folder, const Diagnosis& diagnosis, const std::string& document) {
  folder.write("setup.toml", amended_setup(diagnosis));
  std::error_code none;
  if (std::filesystem::exists(folder.path() / "diagnosis.json", none)) {  // of an earlier diagnosis
    if (!diagnosis.momentum.unlisted) folder.remove({"force.csv"});
    if (!diagnosis.free_restitution) folder.remove({"free_restitution.toml"});
  }
  if (diagnosis.momentum.unlisted) folder.write("force.csv", points_of_force(diagnosis.momentum.curves));
  if (diagnosis.free_restitution)
    folder.write("free_restitution.toml",
                 "# A restitution that depends on the closing speed, of no assumed form, in place of what no "
                 "known effect explains\n" +
                     write_setup(diagnosis.free_restitution->setup));
  folder.write("diagnosis.json", document);
}

int diagnose_data(const DiagnoseArguments& arguments) {
  Setup setup = arguments.setup.read(given_by_measurements);
  const Experiment experiment = read_measured(arguments.data, setup);
  const Measurement measurement = measurement_of(setup, experiment, all_effects());
  check_diagnosed_names(names_in(arguments.effects), names_in(arguments.fixed));
  arguments.json.check();
  arguments.report.check();
  std::unique_ptr<OutputFolder> folder;
  if (!arguments.out.empty()) {
    folder = std::make_unique<OutputFolder>(arguments.out, OutputFolder::Use::alone);
    expect_writable(folder->path() / "setup.toml");
  }
  const std::unique_ptr<Engine> engine = engine_named(arguments.engine);
  const std::int64_t budget = arguments.budget > 0 ? arguments.budget : usual_budget(measurement);
  const std::unique_ptr<SimulationJournal> journal =
      journal_in(folder.get(), "diagnosis", experiment, arguments.resume);
  Diagnosis diagnosis;
  try {
    ProgressDisplay display(fmt::format("{}: diagnosing, at most {} simulations and {:g} s", arguments.data,
                                        budget, arguments.seconds));
    display.count_limits();
    DiagnoseOptions options = usual_diagnose_options();
    options.effects = names_in(arguments.effects);
    options.budget = budget;
    options.execution = {arguments.threads, catch_interruption()};
    options.seconds = arguments.seconds;
    options.fixed = names_in(arguments.fixed);
    options.progress = [&](const std::string& stage, double fraction) {
      display.rename(stage);
      display.show(fraction);
    };
    options.journal = journal.get();
    diagnosis = diagnose(setup, measurement, *engine, options);
  } catch (const Interrupted&) {
    throw Interrupted(what_is_kept(journal.get()));
  }
  const PaperValues taken(setup, given_by_measurements);
  const std::string document = taken.added_to(diagnosis_json(diagnosis));
  taken.print(arguments.json.for_people());
  fmt::print(arguments.json.for_people(), "{}", diagnosis_text(diagnosis));
  if (folder) {
    write_answer(*folder, diagnosis, document);
    std::filesystem::remove(journal->file());
    fmt::print(arguments.json.for_people(), "amended setup: {}\n", (folder->path() / "setup.toml").string());
  }
  if (arguments.report.wanted(arguments.out))
    fmt::print(
        arguments.json.for_people(), "{}",
        arguments.report.write(report_of(diagnosis, measurement, setup,
                                         {{arguments.threads, catch_interruption()}, arguments.seconds}),
                               arguments.out));
  arguments.json.write(document);
  return diagnosis.verdict == Verdict::adequate && diagnosis.judgement.holds() ? exit_done
                                                                               : exit_model_rejected;
}

}  // namespace

Command add_diagnose_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("diagnose", "which physical effect is missing in the model");
  const auto arguments = std::make_shared<DiagnoseArguments>();
  add_setup_arguments(command, arguments->setup);
  command.add_option("--data", arguments->data, "experiment file")->type_name("EXPERIMENT")->required();
  command.add_option("--out", arguments->out, "write the amended setup and the diagnosis into this folder")
      ->type_name("DIR");
  command.add_option("--effects", arguments->effects, "only these may be added")->type_name("a,b,...");
  command
      .add_option("--engine", arguments->engine,
                  "hard, or soft for contacts that last (soft.contact_time of the setup), five times dearer")
      ->check(CLI::IsMember({"hard", "soft"}))
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--fixed", arguments->fixed,
                  "not refitted, because known otherwise: restitution.grain_grain, restitution.grain_wall, "
                  "spring.frequency")
      ->type_name("KEY,KEY,...");
  command
      .add_option(
          "--budget", arguments->budget,
          "simulations at most; default: 10000 for each different setup among the runs, for four at least")
      ->check(positive_number())
      ->type_name("RUNS");
  command
      .add_option("--seconds", arguments->seconds,
                  "time at most, up to 1.6 times that beside other work; what was not tried is said. Where "
                  "it is never reached the answer is the same "
                  "for any number of threads")
      ->capture_default_str()
      ->check(positive_number());
  command.add_flag(
      "--resume", arguments->resume,
      "go on with an interrupted diagnosis in --out DIR: what was simulated is not simulated again");
  add_threads_option(command, arguments->threads);
  add_report_option(command, arguments->report);
  add_json_option(command, arguments->json);
  command.footer(
      "Exit code 0: the verdict is adequate and the setup as given holds by the rule of compare. 1: any "
      "other\n"
      "verdict (refit, measurement, missing, unknown), or undecided.");
  return {&command, [arguments] { return diagnose_data(*arguments); }};
}

}  // namespace shakedown
