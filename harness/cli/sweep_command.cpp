// SPDX-License-Identifier: MIT
// shakedown sweep: one or two keys of a setup over ranges; shakedown merge: results of several processes into
// one file.
#include "sweep.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "command.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "in_order.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "kept_files.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "provenance.hpp"
#include "report_output.hpp"
#include "setup_arguments.hpp"
#include "sweep_report.hpp"
#include "swept.hpp"

namespace shakedown {

namespace {

/// The places where the results go.
struct Presentation {
  JsonOutput json;
  ReportOutput report;
  std::string table;

  /// Makes sure that the results can be written, and do not replace the files that the runs go into or come
  /// from.
  void check(const std::vector<std::string>& results) const {
    for (const std::string& file : results) keep_unchanged(file);
    json.check();
    report.check();
    if (!table.empty()) expect_writable(table);
  }
};

struct SweepArguments {
  SetupArguments setup;
  Presentation results;
  std::vector<std::string> vary;
  std::string engine = "hard", out = "sweep.sqlite", shard;
  int runs = 1, threads = 0;
  bool resume = false, estimate = false;
};

/// Returns the threads of this process: a launcher starts one process a core; a sweep alone takes all cores.
int threads_of(const SweepArguments& arguments, const JobShare& share) {
  if (arguments.threads > 0) return arguments.threads;
  return share.of > 1 && share.source != "--shard" ? 1 : threads_or_all(0);
}

/// Presents what is in the file at the end, for people and as table and JSON.
void present(const ResultFile& file, const std::string& name, const Presentation& how, bool complete,
             std::size_t jobs = 0, const PaperValues* taken = nullptr) {
  const Swept found = swept(file);
  if (!how.table.empty()) write_file(how.table, summary_csv(found.identity, found.points));
  fmt::print(how.json.for_people(), "{}", swept_text(found, name, jobs));
  if (how.report.wanted(""))
    fmt::print(how.json.for_people(), "{}", how.report.write(report_of(file, name), ""));
  const std::string document = swept_json(found, complete);
  how.json.write(taken != nullptr ? taken->added_to(document) : document);
}

/// Returns how the file is opened: processes that share it must not refuse what the others have begun.
ResultFile::Opening opening_of(const SweepArguments& arguments, const JobShare& share) {
  return arguments.resume || share.of > 1 ? ResultFile::Opening::resume : ResultFile::Opening::fresh;
}

/// Prints what the sweep will cost. Its pilot runs go into a file in memory beside what the real one holds,
/// so that nothing is left behind.
int print_estimate(const SweepArguments& arguments, const SweepPlan& plan, const Engine& engine,
                   const JobShare& share) {
  const SweepIdentity identity = identity_of(plan, engine);
  ResultFile file(":memory:", identity, ResultFile::Opening::fresh);
  if (std::filesystem::exists(arguments.out))
    file.add(ResultFile(arguments.out, identity, opening_of(arguments, share)).rows());
  SweepOptions options;
  options.execution = {threads_of(arguments, share), catch_interruption()};
  options.share = share;
  options.announce = [](const SweepCost&) { return false; };
  const SweepOutcome outcome = run_sweep(engine, plan, file, options);
  if (options.execution.stopped()) throw Interrupted("nothing was to be kept");
  SweepCost cost = outcome.cost;
  cost.seconds = cost.seconds_a_run * static_cast<double>(cost.here - cost.done) / options.execution.threads;
  fmt::print(arguments.results.json.for_people(), "{}", cost_text(cost, share, options.execution.threads));
  if (outcome.failed > 0)
    fmt::print(stderr, "{} of {} runs that were tried failed; the first: {}\n", outcome.failed, outcome.added,
               outcome.first_failure);
  arguments.results.json.write(cost_json(cost, options.execution.threads));
  return outcome.failed > 0 ? exit_promise_broken : exit_done;
}

std::vector<std::string_view> keys_of(const std::vector<SweepAxis>& axes) {
  std::vector<std::string_view> keys;
  for (const SweepAxis& axis : axes) keys.push_back(axis.key);
  return keys;
}

int sweep(const SweepArguments& arguments) {
  const JobShare share =
      arguments.shard.empty() ? share_from_launcher(process_environment()) : parse_share(arguments.shard);
  const std::vector<SweepAxis> axes = parse_axes(arguments.vary, all_effects());
  const std::vector<std::string_view> varied = keys_of(axes);
  const Setup setup = arguments.setup.read(varied);
  const PaperValues taken(setup, varied);
  const std::unique_ptr<Engine> engine = engine_named(arguments.engine);
  const SweepPlan plan = plan_sweep(setup, axes, arguments.runs, *engine, all_effects());
  if (!arguments.estimate) expect_writable(arguments.out);
  arguments.results.check({arguments.out});
  for (const std::string& note : plan.notes) fmt::print(stderr, "note: {}\n", note);
  taken.print(arguments.results.json.for_people());
  if (arguments.estimate) return print_estimate(arguments, plan, *engine, share);
  ResultFile file(arguments.out, identity_of(plan, *engine), opening_of(arguments, share));
  for (const std::string& other : file.begin_session(version_line()))
    fmt::print(stderr,
               "note: some results in {} are of another build ({}): means agree, single runs need not\n",
               arguments.out, other);

  SweepOptions options;
  options.execution = {threads_of(arguments, share), catch_interruption()};
  options.share = share;
  std::unique_ptr<ProgressDisplay> display;
  options.announce = [&](const SweepCost& cost) {
    fmt::print(stderr, "{}", cost_text(cost, share, options.execution.threads));
    display = std::make_unique<ProgressDisplay>("sweeping");
    return true;
  };
  options.progress = [&](double fraction) {
    if (display) display->show(fraction);
  };
  const SweepOutcome outcome = run_sweep(*engine, plan, file, options);
  display.reset();
  present(file, arguments.out, arguments.results, !outcome.interrupted,
          plan.points.size() * static_cast<std::size_t>(plan.runs), &taken);
  if (outcome.failed > 0)
    fmt::print(stderr, "{} runs failed and are kept as such; the first: {}\n", outcome.failed,
               outcome.first_failure);
  if (outcome.interrupted) {
    fmt::print(stderr, "interrupted; --resume goes on\n");
    return exit_interrupted;
  }
  return outcome.failed > 0 ? exit_promise_broken : exit_done;
}

struct MergeArguments {
  std::string out;
  std::vector<std::string> files;
  Presentation results;
};

void add_presentation(CLI::App& command, Presentation& results) {
  command.add_option("--table", results.table, "write mean and spread of every point as CSV")
      ->type_name("FILE");
  add_report_option(command, results.report);
  add_json_option(command, results.json);
}

int merge(const MergeArguments& arguments) {
  expect_writable(arguments.out);
  std::vector<std::string> all = arguments.files;
  all.push_back(arguments.out);
  arguments.results.check(all);
  const std::vector<std::filesystem::path> files(arguments.files.begin(), arguments.files.end());
  present(merge_results(arguments.out, files), arguments.out, arguments.results, true);
  return exit_done;
}

}  // namespace

Command add_sweep_command(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("sweep", "one or two keys of a setup over ranges, results into an SQLite file");
  const auto arguments = std::make_shared<SweepArguments>();
  add_setup_arguments(command, arguments->setup);
  command
      .add_option("--vary", arguments->vary,
                  "e.g. box.length=25mm:600mm:5mm or box.length=40mm,65mm; given once or twice")
      ->required()
      ->allow_extra_args(false)
      ->type_name("KEY=FROM:TO:STEP");
  command.add_option("--runs", arguments->runs, "runs of each point")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--engine", arguments->engine, "hard, soft, bullet, lammps or command:PROGRAM")
      ->type_name("NAME")
      ->capture_default_str();
  add_keep_option(command);
  command
      .add_option("--out", arguments->out, "file of the results, a row a run; several processes may share it")
      ->type_name("FILE")
      ->capture_default_str();
  command.add_flag("--resume", arguments->resume, "go on with the file: what it holds is not done again");
  command.add_flag("--estimate", arguments->estimate,
                   "say what the sweep would cost, and stop; nothing is kept");
  command
      .add_option("--shard", arguments->shard,
                  "do the i-th of n shares only; without it the launcher's environment says (mpirun, srun, "
                  "job arrays)")
      ->type_name("i/n");
  add_threads_option(command, arguments->threads,
                     "0: one for each core, one under a launcher; the numbers do not depend on it");
  add_presentation(command, arguments->results);
  for (const char* option : {"--table", "--report"})  // nothing is there to be shown
    command.get_option("--estimate")->excludes(command.get_option(option));
  return {&command, [arguments] { return sweep(*arguments); }};
}

Command add_merge_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("merge", "results of a sweep from several files into one");
  const auto arguments = std::make_shared<MergeArguments>();
  command.add_option("OUT", arguments->out, "file to put them into (made when missing)")
      ->required()
      ->type_name("");
  command.add_option("FILES", arguments->files, "files that `shakedown sweep` wrote")
      ->required()
      ->type_name("");
  add_presentation(command, arguments->results);
  return {&command, [arguments] { return merge(*arguments); }};
}

}  // namespace shakedown
