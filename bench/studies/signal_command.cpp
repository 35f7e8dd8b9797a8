// SPDX-License-Identifier: MIT
// shakedown-studies signal: how strong the trace of an effect is for a judge who knows its form.
#include <fmt/format.h>

#include <memory>

#include "comma_list.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "hideable.hpp"
#include "ideal_signal.hpp"
#include "interruption.hpp"
#include "study_commands.hpp"

namespace shakedown {

namespace {

struct SignalArguments {
  std::string setup;
  std::vector<std::string> effects, parameters, camera;
  std::vector<std::string> runs{"box.length=40mm", "box.length=40mm", "box.length=65mm", "box.length=85mm",
                                "box.length=104mm"};
  int count = 24, threads = 0;
  std::uint64_t seed = 1;
};

int signal(const SignalArguments& arguments) {
  std::vector<Override> common, hidden;
  for (const std::string& text : arguments.parameters) common.push_back(parse_override(text));
  const Setup without = read_setup(arguments.setup, all_effects(), common);
  for (const std::string& text : arguments.effects)
    for (Override& override : overrides_of_effect(text, "--effect", without))
      hidden.push_back(std::move(override));
  IdealSettings settings;
  settings.count = arguments.count;
  settings.seed = arguments.seed;
  std::vector<std::string> parts;
  for (const std::string& text : arguments.camera)
    for (std::string& part : split_at_commas(text)) parts.push_back(std::move(part));
  settings.recording = parse_recording(parts);
  for (const std::string& text : arguments.runs) {
    PlannedRun& run = settings.runs.emplace_back();
    for (const std::string& part : split_at_commas(text))
      run.overrides.push_back(parse_override(part, "--run"));
  }
  const std::unique_ptr<Engine> model = engine_named("hard");
  const TrialTools tools{.laboratory = model.get(),
                         .model = model.get(),
                         .known = all_effects(),
                         .execution = {arguments.threads, catch_interruption()}};
  fmt::print("{:.2f}\n", ideal_signal(without, changed(without, hidden, all_effects()), settings, tools));
  return exit_done;
}

}  // namespace

Command add_signal_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "signal",
      "how many standard deviations an effect moves box and grains, for a judge who knows its form");
  const auto a = std::make_shared<SignalArguments>();
  command.add_option("SETUP", a->setup, "setup file (TOML)")->required()->type_name("");
  command.add_option("--effect", a->effects, "what is hidden, as `shakedown hide` takes it; may be repeated")
      ->type_name("NAME[=k:v,...]")
      ->allow_extra_args(false);
  command.add_option("--set", a->parameters, "keys of the setup, with the effect and without")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--run", a->runs, "keys of one run; may be repeated; default: five of the paper's boxes")
      ->type_name("KEY=VALUE,...")
      ->allow_extra_args(false);
  command.add_option("--camera", a->camera, "noise and frame rate, as `shakedown hide` takes them")
      ->type_name("KEY=VALUE,...")
      ->allow_extra_args(false);
  command.add_option("--count", a->count, "simulations of each run and half")
      ->check(CLI::Range(8, 1000))
      ->capture_default_str();
  command.add_option("--seed", a->seed, "of the simulations")->capture_default_str();
  add_threads_option(command, a->threads);
  return {&command, [a] { return signal(*a); }};
}

}  // namespace shakedown
