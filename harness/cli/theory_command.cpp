// SPDX-License-Identifier: MIT
// shakedown theory: the paper's closed-form estimates for a setup, and the friction-damped oscillator fitted
// to a run.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "command.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "estimated.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "setup_arguments.hpp"

namespace shakedown {

namespace {

struct TheoryArguments {
  SetupArguments setup;
  JsonOutput json;
  std::string engine = "hard", curve;
};

/// Reads the oscillator off a run; nothing when the run has fewer than three peaks.
std::optional<FrictionOfRun> friction_from_a_run(const TheoryArguments& arguments, const Theory& theory,
                                                 const Setup& setup) {
  const std::unique_ptr<Engine> engine = engine_named(arguments.engine);
  ProgressDisplay display(
      fmt::format("{}: a run of {:g} s for its third peak", arguments.setup.file, setup.run.duration));
  return friction_of_run(theory, setup, *engine, catch_interruption(),
                         [&](double fraction) { display.show(fraction); });
}

int print_theory(const TheoryArguments& arguments) {
  const Setup setup = arguments.setup.read();
  Estimated estimated{theory_of(setup), std::nullopt, arguments.engine};
  arguments.json.check();
  if (!arguments.curve.empty()) expect_writable(arguments.curve);
  estimated.friction = friction_from_a_run(arguments, estimated.theory, setup);
  if (!arguments.curve.empty()) {
    if (!estimated.friction)
      throw InputError(
          {{setup.places.contains("run.duration") ? setup.places.at("run.duration") : SourcePlace{},
            "run.duration", "there is no curve (the run has fewer than three peaks)", "run longer"}});
    write_file(arguments.curve, friction_csv(estimated.friction->oscillator, setup));
  }
  const PaperValues taken(setup);
  taken.print(arguments.json.for_people());
  fmt::print(arguments.json.for_people(), "{}", estimated_text(estimated));
  arguments.json.write(taken.added_to(estimated_json(estimated)));
  return exit_done;
}

}  // namespace

Command add_theory_command(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("theory", "closed-form estimates, and the friction-damped oscillator of a run");
  const auto arguments = std::make_shared<TheoryArguments>();
  add_setup_arguments(command, arguments->setup);
  command.add_option("--engine", arguments->engine, "engine of the run whose third peak is used")
      ->type_name("NAME")
      ->capture_default_str();
  add_keep_option(command);
  command
      .add_option("--out", arguments->curve,
                  "write the friction-damped oscillator as t_s,x_box_m,v_box_m_per_s")
      ->type_name("FILE");
  add_json_option(command, arguments->json);
  return {&command, [arguments] { return print_theory(*arguments); }};
}

}  // namespace shakedown
