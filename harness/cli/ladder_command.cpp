// SPDX-License-Identifier: MIT
// shakedown ladder: several setups beside each other, judged by the same measurements.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "climbed.hpp"
#include "command.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "experiment.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "known_setup.hpp"
#include "measured_data.hpp"
#include "output_file.hpp"
#include "paper_values.hpp"
#include "progress_display.hpp"
#include "report_output.hpp"
#include "setup_arguments.hpp"

namespace shakedown {

namespace {

struct LadderArguments {
  std::vector<std::string> setups;
  std::string data;
  int runs = 128, threads = 0;
  bool refit = false, strict = false;
  JsonOutput json;
  ReportOutput report;
  std::string out;
};

/// Reads the setups, or throws InputError with everything that is wrong with them.
std::vector<SetupOfFile> setups_of(const LadderArguments& arguments) {
  std::vector<SetupOfFile> setups;
  std::vector<Violation> wrong;
  for (const std::string& file : arguments.setups) {
    try {
      setups.push_back({file, read_setup(file, all_effects())});
      if (arguments.strict) refuse_paper_values(setups.back().setup, file, given_by_measurements);
    } catch (const InputError& error) {
      wrong.insert(wrong.end(), error.violations.begin(), error.violations.end());
    }
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return setups;
}

int ladder(const LadderArguments& arguments) {
  std::vector<SetupOfFile> setups = setups_of(arguments);
  Setup& first = setups.front().setup;
  const Measurement measurement = measurement_of(first, read_measured(arguments.data, first), all_effects());
  for (SetupOfFile& one : setups) one.setup = with_known(one.setup, measurement.known, all_effects());
  arguments.json.check();
  arguments.report.check();
  std::unique_ptr<OutputFolder> folder;
  if (!arguments.out.empty())
    folder = std::make_unique<OutputFolder>(arguments.out, OutputFolder::Use::alone);
  const std::unique_ptr<Engine> engine = engine_named("hard");
  std::vector<Rung> rungs;
  {
    ProgressDisplay display(fmt::format("{}: {} setups", arguments.data, setups.size()));
    rungs = climbed(
        setups, measurement, *engine,
        {arguments.runs, arguments.refit, {arguments.threads, catch_interruption()}, [&](double fraction) {
           display.show(fraction);
         }});
  }
  PaperValues taken(first, given_by_measurements);
  for (const SetupOfFile& one : setups) taken.join(PaperValues(one.setup, given_by_measurements));
  taken.print(arguments.json.for_people());
  fmt::print(arguments.json.for_people(), "{}", climbed_text(rungs, arguments.refit));
  const std::string document = taken.added_to(climbed_json(rungs, arguments.refit));
  if (folder) folder->write("ladder.json", document);
  if (arguments.report.wanted(arguments.out))
    fmt::print(arguments.json.for_people(), "{}",
               arguments.report.write(report_of(rungs, arguments.refit, measurement, setups.back().setup),
                                      arguments.out));
  arguments.json.write(document);
  const bool any = std::any_of(rungs.begin(), rungs.end(), [](const Rung& rung) { return rung.holds(); });
  return any ? exit_done : exit_model_rejected;
}

}  // namespace

Command add_ladder_command(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("ladder", "setups beside each other, judged by the same measurements");
  const auto arguments = std::make_shared<LadderArguments>();
  command.add_option("SETUP", arguments->setups, "setup files (TOML)")->required()->type_name("...");
  command.add_option("--data", arguments->data, "experiment file")->type_name("EXPERIMENT")->required();
  command.add_flag(
      "--refit", arguments->refit,
      "refit both restitutions and the frequency of each, and predict each box length from the others");
  add_strict_option(command, arguments->strict);
  add_simulations_option(command, arguments->runs);
  add_threads_option(command, arguments->threads);
  command
      .add_option("--out", arguments->out,
                  "write ladder.json and what `shakedown report` needs into this folder")
      ->type_name("DIR");
  add_report_option(command, arguments->report);
  add_json_option(command, arguments->json);
  command.footer("Exit code 0: one of the setups holds. 1: none does.");
  return {&command, [arguments] { return ladder(*arguments); }};
}

}  // namespace shakedown
