// SPDX-License-Identifier: MIT
// shakedown blind-suite: the diagnosis on trial.
#include "blind_suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "data_file.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "faulty_parts.hpp"
#include "ideal_judge.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "output_file.hpp"
#include "study_commands.hpp"

namespace shakedown {

namespace {

struct BlindSuiteArguments {
  std::string setup, out, cases, strengths, variant, mutation = "none", engine = "soft";
  std::string shard;
  bool ideal = false;
  bool small = false, full = false, baselines = false, resume = false, score_only = false;
  std::vector<double> signals;
  std::uint64_t seed = 1;
  std::int64_t budget = 40000;
  int threads = 0;
  std::string ledger = state_file("ledger.csv", STUDIES_LEDGER).string();
  JsonOutput json;
};

/// Throws InputError where a folder holds no suite, before it is made: a name mistyped must not leave one
/// behind.
void expect_suite(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "plan.json"))
    throw InputError({{{folder.string(), 0, 0},
                       "--score",
                       "finds no suite there (no plan.json)",
                       "name the --out folder of a suite, or leave --score out to begin one"}});
}

/// Returns the threads of this process: a launcher starts one process a core.
int threads_of(const BlindSuiteArguments& arguments, const JobShare& share) {
  if (arguments.threads > 0) return arguments.threads;
  return share.of > 1 && share.source != "--shard" ? 1 : 0;
}

BlindSuiteOptions options_of(const BlindSuiteArguments& arguments, const JobShare& share) {
  BlindSuiteOptions options;
  options.counts = !arguments.cases.empty() ? parse_counts(arguments.cases)
                   : arguments.small        ? small_counts
                   : arguments.full         ? full_counts
                                            : lunch_counts;
  options.share = share;
  options.small = arguments.small;
  options.fault = arguments.mutation;
  options.signals = arguments.signals;
  options.variant = arguments.variant;
  options.seed = arguments.seed;
  options.baselines = arguments.baselines;
  options.resume = arguments.resume;
  options.strengths = arguments.strengths;
  options.ledger = arguments.ledger;
  options.told = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  return options;
}

int blind_suite(const BlindSuiteArguments& arguments) {
  if (arguments.score_only) expect_suite(arguments.out);
  const JobShare share =
      arguments.shard.empty() ? share_from_launcher(process_environment()) : parse_share(arguments.shard);
  const Setup believed = arguments.setup.empty() ? Setup{} : read_setup(arguments.setup, all_effects());
  const OutputFolder folder(arguments.out);
  arguments.json.check();
  const std::unique_ptr<Engine> laboratory = engine_named(arguments.engine), model = engine_named("hard");
  EnsembleCache ensembles;
  TrialTools tools{.laboratory = laboratory.get(),
                   .model = model.get(),
                   .known = all_effects(),
                   .budget = arguments.budget,
                   .execution = {threads_of(arguments, share), catch_interruption()},
                   .strength_uncertainty = &strength_uncertainty,
                   .ensembles = &ensembles};
  const FaultyParts faulty(arguments.mutation, believed, tools);
  const BlindSuiteOptions options = options_of(arguments, share);
  bool interrupted = false;
  if (!arguments.score_only) {
    try {
      run_blind_suite(folder.path(), believed, tools, options);
    } catch (const Interrupted&) {
      interrupted = true;
      fmt::print(stderr, "interrupted; go on with --resume\n");
      if (!std::filesystem::exists(folder.path() / "plan.json")) return exit_interrupted;
    }
  }
  if (share.of > 1 && !interrupted && !all_answered(folder.path())) {
    fmt::print(stderr, "share {} of {} (from {}) is answered; the last process scores, or --score\n",
               share.index + 1, share.of, share.source);
    return exit_done;
  }
  BlindScore score = score_blind_suite(folder.path(), tools, arguments.ledger);
  if (arguments.ideal)
    for (BlindFigure& figure : ideal_judge(folder.path(), believed, tools))
      score.figures.push_back(std::move(figure));
  std::string lines;
  for (const std::string& line : score.cases) lines += line + "\n";
  folder.write("score.txt", blind_score_text(score) + "\n" + lines);
  folder.write("score.json", blind_score_json(score));
  fmt::print(arguments.json.for_people(), "{}cases: {}\n", blind_score_text(score),
             (folder.path() / "score.txt").string());
  arguments.json.write(blind_score_json(score));
  return interrupted ? exit_interrupted : exit_done;
}

/// Adds the options that say what is hidden and what the diagnosis has to bear.
void add_design_options(CLI::App& command, BlindSuiteArguments& a) {
  command
      .add_option(
          "--signals", a.signals,
          "signal to noise of what is hidden, in turn; default: log-uniform from 2 to 40 (--small: 25)")
      ->delimiter(',')
      ->check(CLI::Range(0.1, 1000.0))
      ->type_name("RATIO,...");
  command.add_flag("--full", a.full,
                   "all 464: nulls=60,parameters=60,singles=120,camera=30,pairs=30,unlisted=24,twins=20,"
                   "films=60,dampers=60; some four hours of two cores");
  command.add_flag("--small", a.small, "a few cases, two short runs each, strong signals");
  command
      .add_option(
          "--variant", a.variant,
          "a worse experiment: one-repeat, two-lengths, half-duration, 250fps, missing, outliers, no-centre")
      ->type_name("NAME");
  command.add_flag(
      "--baselines", a.baselines,
      "ask simpler methods the same: smallest error, Akaike's criterion with white noise, one seed");
  command
      .add_option("--mutation", a.mutation,
                  "a faulty part given to the diagnosis, to see which figures notice: no-refit, no-centre, "
                  "wrong-sign, smoothed")
      ->check(CLI::IsMember(std::vector<std::string>(fault_names.begin(), fault_names.end())))
      ->type_name("NAME");
  command
      .add_option(
          "--shard", a.shard,
          "answer the i-th of n shares only; without it the launcher's environment says (mpirun, srun, "
          "job arrays). Processes share the folder")
      ->type_name("i/n");
}

}  // namespace

Command add_blind_suite_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "blind-suite",
      "the diagnosis on trial: hundreds of hidden cases, answers sealed until they are scored");
  const auto a = std::make_shared<BlindSuiteArguments>();
  command.add_option("SETUP", a->setup, "what the user believes; default: the paper's damper")->type_name("");
  command.add_option("--out", a->out, "folder for plan, sealed answers, diagnoses and score")
      ->type_name("DIR")
      ->required();
  command
      .add_option("--cases", a->cases,
                  "how many of each kind: "
                  "nulls=8,parameters=8,singles=20,camera=6,pairs=6,unlisted=6,films=12,dampers=12")
      ->type_name("KIND=N,...");
  add_design_options(command, *a);
  command.add_flag("--resume", a->resume, "go on where an interrupted suite stopped");
  command.add_flag(
      "--ideal", a->ideal,
      "score beside an ideal judge, who knows signatures and covariance (some minutes the first time)");
  command.add_flag("--score", a->score_only, "only open and score what is there");
  command
      .add_option("--strengths", a->strengths,
                  "strengths.json of an earlier suite of the same design, instead of measuring")
      ->type_name("FILE");
  command
      .add_option("--ledger", a->ledger,
                  "table of seeds drawn, answered and opened (CSV), kept by the suite; \"\": none")
      ->type_name("FILE");
  command
      .add_option("--laboratory,--engine", a->engine,
                  "the engine that makes what is hidden; lammps or command:PROGRAM: other people's codes")
      ->type_name("NAME")
      ->capture_default_str();
  add_keep_option(command);
  command.add_option("--seed", a->seed, "of the draw")->capture_default_str();
  command.add_option("--budget", a->budget, "simulations of one diagnosis at most")
      ->type_name("RUNS")
      ->capture_default_str();
  add_threads_option(command, a->threads);
  add_json_option(command, a->json);
  return {&command, [a] { return blind_suite(*a); }};
}

}  // namespace shakedown
