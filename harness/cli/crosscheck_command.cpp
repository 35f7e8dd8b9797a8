// SPDX-License-Identifier: MIT
// shakedown crosscheck: the same setups through several engines.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "comma_list.hpp"
#include "command.hpp"
#include "crosscheck_file.hpp"
#include "crosscheck_report.hpp"
#include "ensemble_options.hpp"
#include "in_order.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "report_output.hpp"
#include "setup_arguments.hpp"

namespace shakedown {

namespace {

struct CrosscheckArguments {
  std::vector<std::string> files, variations;
  SetupArguments changes;  ///< of every setup; its file is not used
  JsonOutput json;
  ReportOutput report;
  std::string folder;
  CrosscheckOptions options;
  double slope_margin_mm_per_s = 0;
  bool limit = false;
};

struct Case {
  std::string name;
  Setup setup;
};

/// Splits "box.length=40mm,65mm" into {"box.length=40mm", "box.length=65mm"}. Throws InputError.
std::vector<std::string> values_of(const std::string& variation) {
  const std::size_t equals = variation.find('=');
  if (equals == std::string::npos || equals + 1 == variation.size())
    throw InputError({{{"--vary"}, variation, "this names no values", "write e.g. box.length=40mm,65mm"}});
  std::vector<std::string> values;
  for (const std::string& value : split_at_commas(variation.substr(equals + 1)))
    values.push_back(variation.substr(0, equals + 1) + value);
  return values;
}

/// Returns every combination of the variations; one empty combination when there are none.
std::vector<std::vector<std::string>> combinations_of(const std::vector<std::string>& variations) {
  std::vector<std::vector<std::string>> combinations{{}};
  for (const std::string& variation : variations) {
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& combination : combinations)
      for (const std::string& value : values_of(variation)) {
        longer.push_back(combination);
        longer.back().push_back(value);
      }
    combinations = std::move(longer);
  }
  return combinations;
}

std::vector<Case> cases_of(const CrosscheckArguments& arguments) {
  std::vector<Case> cases;
  for (const std::string& file : arguments.files)
    for (const std::vector<std::string>& combination : combinations_of(arguments.variations)) {
      SetupArguments one = arguments.changes;
      one.file = file;
      one.overrides.insert(one.overrides.end(), combination.begin(), combination.end());
      cases.push_back({std::filesystem::path(file).filename().string(), one.read()});
      for (const std::string& value : combination) cases.back().name += " " + value;
    }
  return cases;
}

CrosscheckOptions options_of(const CrosscheckArguments& arguments) {
  CrosscheckOptions options = arguments.options;
  options.execution = {threads_or_all(options.execution.threads), catch_interruption()};
  if (arguments.slope_margin_mm_per_s > 0) options.margins.slope = 1e-3 * arguments.slope_margin_mm_per_s;
  if (arguments.limit) options.contact_times = {3e-3, 1e-3, 3e-4, 1e-4};
  return options;
}

void write_folder(const OutputFolder& folder, const std::vector<Crosscheck>& found, bool limit) {
  folder.write("numbers.csv", crosscheck_numbers_csv(found));
  folder.write("verdicts.csv", crosscheck_verdicts_csv(found));
  if (limit) folder.write("contact_time_limit.csv", crosscheck_limit_csv(found));
  folder.write("summary.json", crosscheck_json(found));
}

int run_crosscheck(const CrosscheckArguments& arguments) {
  const std::vector<Case> cases = cases_of(arguments);
  arguments.json.check();
  arguments.report.check();
  std::optional<OutputFolder> folder;
  if (!arguments.folder.empty()) folder.emplace(arguments.folder, OutputFolder::Use::alone);
  CrosscheckOptions options = options_of(arguments);

  PaperValues taken(cases.front().setup);
  for (const Case& one : cases) taken.join(PaperValues(one.setup));
  taken.print(arguments.json.for_people());
  std::vector<Crosscheck> found;
  bool differ = false, cannot_tell = false;
  for (const Case& one : cases) {
    {
      ProgressDisplay display(fmt::format("{}: {} runs an engine", one.name, options.runs));
      options.progress = [&](double fraction) { display.show(fraction); };
      found.push_back(crosscheck(one.name, one.setup, options));
    }
    fmt::print(arguments.json.for_people(), "{}\n", readable_crosscheck(found.back()));
    if (folder) write_folder(*folder, found, arguments.limit);
    differ = differ || found.back().any(Agreement::differ);
    cannot_tell = cannot_tell || found.back().any(Agreement::cannot_tell);
  }
  if (options.engines.size() > 1)
    fmt::print(arguments.json.for_people(), "{}\n",
               differ        ? "the engines differ beyond the margins"
               : cannot_tell ? "no difference beyond the margins, but not everything can be told: more runs"
                             : "the engines are equivalent within the margins");
  if (folder) fmt::print(arguments.json.for_people(), "results in {}\n", folder->path().string());
  if (arguments.report.wanted(arguments.folder))
    fmt::print(arguments.json.for_people(), "{}",
               arguments.report.write(report_of(found, cases.back().setup), arguments.folder));
  arguments.json.write(taken.added_to(crosscheck_json(found)));
  return differ ? exit_model_rejected : exit_done;
}

void add_margin_options(CLI::App& command, CrosscheckArguments& arguments) {
  command
      .add_option(
          "--slope-margin", arguments.slope_margin_mm_per_s,
          "difference of slopes that counts as none; without it 0.10, 0.5, 0.6, 0.8 mm/s for boxes of "
          "40, 65, 85, 104 mm and 3 % of the slope for others")
      ->check(positive_number())
      ->type_name("MM/S");
  command.add_option("--frequency-margin", arguments.options.margins.frequency, "the same of frequencies")
      ->check(positive_number())
      ->type_name("HZ")
      ->capture_default_str();
  command
      .add_option("--share-margin", arguments.options.margins.share,
                  "the same of the shares of the initial energy that each class of contact takes")
      ->check(positive_number())
      ->type_name("FRACTION")
      ->capture_default_str();
}

void add_ensemble_options(CLI::App& command, CrosscheckArguments& arguments) {
  command.add_option("--runs", arguments.options.runs, "runs of each engine; at least 2 for a verdict")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N")
      ->capture_default_str();
  arguments.options.execution.threads = 0;
  add_threads_option(command, arguments.options.execution.threads,
                     "threads for the runs, 0: one a core; only wall times depend on it");
  command.add_option("--engines", arguments.options.engines, "engines, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES")
      ->default_str("hard,soft");
  add_keep_option(command);
}

void add_setup_options(CLI::App& command, CrosscheckArguments& arguments) {
  command.add_option("SETUP", arguments.files, "setup files (TOML)")->required()->type_name("");
  command.add_option("--set", arguments.changes.overrides, "change a key of every setup; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--vary", arguments.variations,
                  "every setup once with each value, e.g. box.length=40mm,65mm; may be repeated")
      ->type_name("KEY=V1,V2...")
      ->allow_extra_args(false);
  add_strict_option(command, arguments.changes.strict);
  command.add_option("--rate", arguments.changes.rate, "samples per second (run.sample_rate)")
      ->type_name("HZ");
  command.add_option("--seed", arguments.changes.seed, "seed of the random numbers (run.seed)")
      ->type_name("N");
}

}  // namespace

Command add_crosscheck_command(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("crosscheck", "the same setups through several engines: do they agree?");
  const auto arguments = std::make_shared<CrosscheckArguments>();
  add_setup_options(command, *arguments);
  add_ensemble_options(command, *arguments);
  add_margin_options(command, *arguments);
  command.add_flag("--limit", arguments->limit,
                   "the soft engine at contact times of 3, 1, 0.3 and 0.1 ms, extrapolated to 0");
  command.add_option("--out", arguments->folder, "write CSV and summary.json into this folder")
      ->type_name("DIR");
  add_report_option(command, arguments->report);
  add_json_option(command, arguments->json);
  command.footer(
      "Exit code 1: an observable differs beyond its margin (its 95 % interval lies outside). \"Cannot "
      "tell\" "
      "is\nno failure.");
  return {&command, [arguments] { return run_crosscheck(*arguments); }};
}

}  // namespace shakedown
