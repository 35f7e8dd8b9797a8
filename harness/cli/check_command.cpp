// SPDX-License-Identifier: MIT
// shakedown check: regression checks for continuous integration, one line each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "decay_baselines.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "in_order.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "provenance.hpp"

namespace shakedown {

namespace {

struct LinearDecayArguments {
  std::vector<std::string> engines{"hard", "soft"};
  std::vector<double> lengths_mm{40, 65, 85, 104};
  int runs = fewest_runs, threads = 0;
  std::uint64_t seed = 1;
  std::string baselines = default_decay_baselines().string();
  bool update = false;
  JsonOutput json;
};

DecayMeasurement measured(const LinearDecayArguments& arguments, const Engine& engine, double length) {
  ProgressDisplay display(fmt::format("linear decay, L = {:g} mm: {} runs with engine {}", 1e3 * length,
                                      arguments.runs, engine.name()));
  EnsembleOptions options;
  options.runs = arguments.runs;
  options.execution = {threads_or_all(arguments.threads), catch_interruption()};
  options.progress = [&](double fraction) { display.show(fraction); };
  return measure_decay(engine, length, arguments.seed, options);
}

/// Returns the stored baselines; none when there is no file yet and one is to be written.
std::vector<DecayBaseline> stored(const LinearDecayArguments& arguments) {
  if (arguments.update) {
    expect_writable(arguments.baselines);
    if (!std::filesystem::exists(arguments.baselines)) return {};
  }
  return read_decay_baselines(arguments.baselines);
}

DecayBaseline fresh_baseline(const DecayMeasurement& found) {
  const Provenance program = provenance_of_this_program();
  return baseline_of(found, program.version, program.commit);
}

int check_linear_decay(const LinearDecayArguments& arguments) {
  std::vector<std::unique_ptr<Engine>> engines;
  for (const std::string& name : arguments.engines) engines.push_back(engine_named(name));
  arguments.json.check();
  std::vector<DecayBaseline> baselines = stored(arguments);
  std::vector<DecayCheck> checks;
  for (const auto& engine : engines)
    for (const double length_mm : arguments.lengths_mm) {
      const DecayMeasurement found = measured(arguments, *engine, length_mm / 1e3);
      if (arguments.update) {
        baselines = updated(std::move(baselines), {fresh_baseline(found)});
        write_decay_baselines(arguments.baselines, baselines);
      }
      for (const DecayCheck& check : checks_of(found, find_baseline(baselines, found.engine, found.length))) {
        fmt::print(arguments.json.for_people(), "{}\n", readable(check));
        checks.push_back(check);
      }
    }
  arguments.json.write(decay_checks_json(checks));
  return std::ranges::all_of(checks, &DecayCheck::passed) ? exit_done : exit_model_rejected;
}

void add_decay_options(CLI::App& command, LinearDecayArguments& arguments) {
  command.add_option("--engines", arguments.engines, "engines, separated by commas")
      ->delimiter(',')
      ->type_name("NAMES")
      ->default_str("hard,soft");
  add_keep_option(command);
  command.add_option("--lengths", arguments.lengths_mm, "lengths of the box, separated by commas")
      ->delimiter(',')
      ->check(positive_number())
      ->type_name("MM")
      ->default_str("40,65,85,104");
  command
      .add_option("--runs", arguments.runs,
                  "runs of each; the stored intervals are made for means over 8 or more")
      ->check(CLI::Range(fewest_runs, 1000000))
      ->type_name("N")
      ->capture_default_str();
  add_threads_option(command, arguments.threads);
  add_seed_option(command, arguments.seed, "seed of the random numbers");
}

Command add_linear_decay_check(CLI::App& check) {
  CLI::App& command = *check.add_subcommand(
      "linear-decay", "the paper's damper loses amplitude along a nearly straight line, at the stored slope");
  const auto arguments = std::make_shared<LinearDecayArguments>();
  add_decay_options(command, *arguments);
  command
      .add_option("--baselines", arguments->baselines,
                  "file of the stored intervals; default: that of the program")
      ->type_name("FILE");
  command.add_flag("--update", arguments->update, "measure the stored intervals anew and write them");
  add_json_option(command, arguments->json);
  command.footer("Exit code 1: a check failed.");
  return {&command, [arguments] { return check_linear_decay(*arguments); }};
}

}  // namespace

Command add_check_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("check", "regression checks, for continuous integration");
  command.require_subcommand(1);
  return add_linear_decay_check(command);
}

}  // namespace shakedown
