// SPDX-License-Identifier: MIT
// shakedown-studies ring-downs: the diagnosis on recordings of empty boxes.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "data_file.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "in_order.hpp"
#include "interruption.hpp"
#include "ledger.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "provenance.hpp"
#include "ring_down.hpp"
#include "setup_file.hpp"
#include "study_commands.hpp"

namespace shakedown {

namespace {

struct RingDownArguments {
  std::string out, cases_to, engine = "hard", ledger = state_file("ledger.csv", STUDIES_LEDGER).string();
  std::vector<int> only;
  int cases = 200, threads = 0;
  std::uint64_t seed = 1;
};

/// Returns the answer that an earlier call left in the folder, or finds it now and leaves it there.
RingDownAnswer kept_or_found(const RingDown& drawn, const TrialTools& tools,
                             const RingDownArguments& arguments) {
  if (arguments.out.empty()) return answer_of(drawn, tools);
  const std::string name = fmt::format("answers/seed_{}_case_{:04}.json", arguments.seed, drawn.number);
  const std::filesystem::path file = std::filesystem::path(arguments.out) / name;
  if (std::filesystem::exists(file)) return read_answer(file, version_line());
  RingDownAnswer answer = answer_of(drawn, tools);
  write_file(file, answer_json(answer, version_line()));
  return answer;
}

/// Writes the case as files that any program can be asked with, and its truth beside them.
void write_case(const RingDown& drawn, const TrialTools& tools, const RingDownArguments& arguments) {
  const std::string name =
      fmt::format("{}/seed_{}_case_{:04}", arguments.cases_to, arguments.seed, drawn.number);
  const OutputFolder folder(name);
  folder.write("setup.toml", write_setup(drawn.trial.hidden.believed));
  folder.write("truth.toml", write_setup(drawn.trial.hidden.truth));
  write_measurements(name, measured_in(drawn.trial, tools));
}

/// Answers several cases at a time, each on one thread.
std::vector<RingDownResult> results_of(const RingDownArguments& arguments) {
  if (!arguments.out.empty()) const OutputFolder answers(arguments.out + "/answers");
  const std::unique_ptr<Engine> laboratory = engine_named(arguments.engine), model = engine_named("hard");
  const TrialTools tools{.laboratory = laboratory.get(),
                         .model = model.get(),
                         .known = all_effects(),
                         .execution = {1, catch_interruption()},
                         .strength_uncertainty = &strength_uncertainty};
  std::vector<int> numbers = arguments.only;
  for (int number = 0; arguments.only.empty() && number < arguments.cases; ++number)
    numbers.push_back(number);
  std::vector<RingDownResult> results;
  ProgressDisplay display("ring-downs");
  const int count = static_cast<int>(numbers.size());
  work_in_parallel_deliver_in_order(
      count, threads_or_all(arguments.threads), [&](int i) -> std::function<void()> {
        if (tools.execution.stopped()) throw Interrupted("stopped before the last case");
        RingDown drawn =
            draw_ring_down(arguments.seed, numbers[static_cast<std::size_t>(i)], *model, all_effects());
        if (!arguments.cases_to.empty()) write_case(drawn, tools, arguments);
        RingDownAnswer answer = kept_or_found(drawn, tools, arguments);
        auto result =
            std::make_shared<RingDownResult>(judged(std::move(drawn), std::move(answer), all_effects()));
        return [&, result] {
          results.push_back(std::move(*result));
          display.show(static_cast<double>(results.size()) / count);
        };
      });
  return results;
}

int ring_downs(const RingDownArguments& arguments) {
  std::optional<OutputFolder> folder;
  if (!arguments.out.empty()) folder.emplace(arguments.out, OutputFolder::Use::alone);
  SeedLedger ledger(arguments.ledger);
  const LedgerKey key = ledger.begin("ring-downs", arguments.seed, version_line());
  const std::vector<RingDownResult> results = results_of(arguments);
  ledger.answered(key);
  ledger.opened(key);
  const std::string table =
      (ledger.seen(key) ? "SEEN: this seed had been opened before\n" : "") + ring_down_table(results);
  if (folder) {
    folder->write("ring_downs.csv", ring_down_csv(results));
    folder->write("ring_downs.txt", table);
  }
  fmt::print("{}", table);
  return exit_done;
}

}  // namespace

Command add_ring_down_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "ring-downs", "the diagnosis on recordings of empty boxes, drawn at random, as people make them");
  const auto a = std::make_shared<RingDownArguments>();
  command.add_option("--cases", a->cases, "how many")->check(CLI::Range(1, 100000))->capture_default_str();
  command.add_option("--only", a->only, "these numbers alone, e.g. 3,17")->delimiter(',')->type_name("N,...");
  command.add_option("--seed", a->seed, "of the draw")->capture_default_str();
  command
      .add_option("--laboratory,--engine", a->engine,
                  "the engine that makes what is hidden; lammps or command:PROGRAM: other people's codes")
      ->type_name("NAME")
      ->capture_default_str();
  add_keep_option(command);
  command
      .add_option("--out", a->out,
                  "folder for ring_downs.csv (a line a case), ring_downs.txt and every answer as it comes; "
                  "a second call with it goes on where the first stopped")
      ->type_name("DIR");
  command
      .add_option("--cases-to", a->cases_to,
                  "folder for the cases themselves: setup, experiment, tables, truth")
      ->type_name("DIR");
  command.add_option("--ledger", a->ledger, "table of seeds drawn, answered and opened (CSV); \"\": none")
      ->type_name("FILE");
  add_threads_option(command, a->threads);
  return {&command, [a] { return ring_downs(*a); }};
}

}  // namespace shakedown
