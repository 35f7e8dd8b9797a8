// SPDX-License-Identifier: MIT
// shakedown hide: synthetic measurements with something hidden in them.
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "hidden_answer.hpp"
#include "hidden_question.hpp"
#include "hide_map.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "output_file.hpp"
#include "paper_values.hpp"
#include "progress_display.hpp"
#include "setup_arguments.hpp"
#include "toml_document.hpp"
#include "trial.hpp"

namespace shakedown {

namespace {

struct HideArguments {
  HiddenQuestion question;
  std::string setup, out, truth;
  bool power = false, strict = false;
  int repeats = 20;
  std::int64_t budget = 0;
  JsonOutput json;
  MapArguments map;
};

/// Returns everything that the arguments say, or throws InputError with everything that is wrong with them.
Trial asked(const HideArguments& arguments) {
  Trial trial;
  std::vector<Violation> found;
  try {
    HiddenQuestion question = arguments.question;
    question.setup_with = [&](std::span<const Override> changes) {
      return read_setup(arguments.setup, all_effects(), changes);
    };
    trial = trial_of(question);
    if (arguments.strict) refuse_paper_values(trial.hidden.believed, arguments.setup, given_by_measurements);
  } catch (const InputError& error) {
    found = error.violations;
  }
  if (!arguments.power && !arguments.map.wanted && arguments.out.empty())
    found.push_back({{"--out", 0, 0},
                     "",
                     "is missing (where shall the measurements go?)",
                     "name a folder, or ask for the --power of a diagnosis, or for the --map"});
  if (!found.empty()) throw InputError(std::move(found));
  return trial;
}

/// Returns the files of the case that an earlier `hide` left in the folder; empty where there is none. Throws
/// InputError where somebody else's experiment is there.
std::vector<std::filesystem::path> earlier_case(const OutputFolder& folder) {
  const std::filesystem::path experiment = folder.path() / "experiment.toml",
                              setup = folder.path() / "setup.toml";
  if (!std::filesystem::exists(experiment)) return {};
  if (!std::filesystem::exists(setup) || !read_text_file(setup).starts_with(first_line_of_case))
    throw InputError({{{experiment.string(), 0, 0},
                       "",
                       "is an experiment that this command did not make",
                       "name another folder with --out"}});
  std::vector<std::filesystem::path> files{"experiment.toml", "truth.json"};
  const TomlValue read = parse_toml(read_text_file(experiment), experiment.string());
  if (const TomlValue* runs = read.find("run"))
    for (const TomlValue& run : runs->items)
      if (const TomlValue* file = run.find("file"))
        files.push_back(std::filesystem::path(file->text).filename());
  return files;
}

int hide(const HideArguments& arguments, const Trial& trial) {
  arguments.json.check();
  const OutputFolder folder(arguments.out, OutputFolder::Use::alone);
  const std::vector<std::filesystem::path> earlier = earlier_case(folder);
  const std::filesystem::path truth =
      arguments.truth.empty() ? folder.path() / "truth.json" : std::filesystem::path(arguments.truth);
  for (const std::filesystem::path& file :
       {truth, folder.path() / "setup.toml", folder.path() / "experiment.toml"})
    expect_writable(file);
  Experiment experiment;
  {
    ProgressDisplay display(
        fmt::format("{}: measuring with engine {}", arguments.setup, arguments.question.engine));
    experiment = measured(arguments.question, trial, catch_interruption(),
                          [&](double fraction) { display.show(fraction); });
  }
  folder.remove(earlier);
  write_case(folder.path(), truth, arguments.question, trial, experiment);
  fmt::print(arguments.json.for_people(), "{}", case_text(folder.path(), truth, experiment));
  const PaperValues taken(trial.hidden.believed, given_by_measurements);
  taken.print(arguments.json.for_people());
  arguments.json.write(taken.added_to(case_json(folder.path(), truth, experiment)));
  return exit_done;
}

/// Measures whether a diagnosis would see what is hidden. Nothing is written.
int measure_power(const HideArguments& arguments, const Trial& trial) {
  const std::unique_ptr<Engine> laboratory = engine_named(arguments.question.engine),
                                model = engine_named("hard");
  arguments.json.check();
  const TrialTools tools{laboratory.get(),
                         model.get(),
                         all_effects(),
                         arguments.budget,
                         {arguments.question.threads, catch_interruption()},
                         &strength_uncertainty};
  const Power power = power_of(trial, arguments.repeats, tools, [&](int done, const std::string& answer) {
    fmt::print(stderr, "{:>3} of {}: {}\n", done, arguments.repeats, answer);
  });
  fmt::print(arguments.json.for_people(), "{}", power_text(trial.hidden, power));
  arguments.json.write(power_json(trial.hidden, power));
  return exit_done;
}

int hide_or_measure_power(const HideArguments& arguments) {
  const Trial trial = asked(arguments);
  if (arguments.map.wanted)
    return map_strengths(arguments.map, arguments.question, trial, arguments.out, arguments.json);
  return arguments.power ? measure_power(arguments, trial) : hide(arguments, trial);
}

void add_map_options(CLI::App& command, MapArguments& map) {
  CLI::Option* asked = command.add_flag(
      "--map", map.wanted,
      "hide nothing; how good must the camera be? The smallest strength of each effect (or of those "
      "named with --effect) that would be seen, against noise, wander, shutter, films and what is "
      "known of the restitutions");
  command.add_option("--seconds", map.seconds, "with --map: time at most; what was not mapped is said")
      ->capture_default_str()
      ->check(positive_number())
      ->needs(asked);
  command
      .add_flag("--resume", map.resume,
                "with --map: go on with an interrupted one in --out DIR: what was simulated is not simulated "
                "again")
      ->needs(asked);
  add_report_option(command, map.report);
  command.get_option("--report")->needs(asked);
}

void add_power_options(CLI::App& command, HideArguments& a) {
  command.add_flag(
      "--power", a.power,
      "write nothing; repeat measurement and diagnosis: how often is the effect seen, how often named?");
  command.add_option("--repeats", a.repeats, "with --power")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command
      .add_option("--budget", a.budget,
                  "with --power: simulations of one diagnosis at most; default: as `shakedown diagnose`")
      ->check(positive_number())
      ->type_name("RUNS");
}

}  // namespace

Command add_hide_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "hide", "make measurements in which an effect is hidden, to try a diagnosis on");
  const auto a = std::make_shared<HideArguments>();
  const auto many = [&](const char* name, std::vector<std::string>& values, const char* sentence,
                        const char* type) {
    command.add_option(name, values, sentence)->type_name(type)->allow_extra_args(false);
  };
  command.add_option("SETUP", a->setup, "setup file (TOML): what the user believes")
      ->required()
      ->type_name("");
  many("--effect", a->question.effects,
       "hide this effect (at its typical strength when no parameter is given); may be repeated",
       "NAME[=k:v,...]");
  many("--set", a->question.parameters,
       "what else is different in the laboratory, e.g. restitution.grain_grain=0.8; may be repeated",
       "KEY=VALUE");
  command.add_option("--out", a->out, "folder for setup.toml, experiment.toml, the tables and truth.json")
      ->type_name("DIR");
  command.add_option("--truth", a->truth, "put the answer there instead of DIR/truth.json")
      ->type_name("FILE");
  command.add_option("--lengths", a->question.lengths, "box length of each run; \"\" for none")
      ->type_name("L,L,...")
      ->capture_default_str();
  many("--run", a->question.runs,
       "one more run with keys of its own, e.g. box.length=40mm,grains.count=0; may be repeated",
       "KEY=VALUE,...");
  command
      .add_option("--engine", a->question.engine,
                  "the laboratory's; lammps or command:PROGRAM: other people's codes")
      ->type_name("NAME")
      ->capture_default_str();
  add_keep_option(command);
  many("--camera", a->question.camera,
       "noise.box, noise.centre (0.2 mm, 0.5 mm), fps (500), missing, outliers (0), jump (20 mm), "
       "centre=false; a camera as it is: lens=0.5%, shutter=1ms, near=0.5%, wander=20um/0.3s, and by run "
       "trigger=1ms, release=0.3mm; a table as it is: rounding=0.1mm, edge=1mm, jitter=1ms, stamped=true, "
       "start=0.2s, "
       "origin=2mm, declared=false",
       "KEY=VALUE,...");
  many("--known", a->question.known,
       "what its experimenter knows, e.g. \"box.mass=434 g +- 2 g\", in the place of or beside the usual "
       "errors of masses, release, scale and trigger; may be repeated",
       "KEY=VALUE +- ERROR");
  command.add_option("--duration", a->question.duration, "of each run, e.g. \"20 s\"; default: the setup's")
      ->type_name("TIME");
  command.add_option("--title", a->question.title, "of the experiment");
  add_seed_option(command, a->question.seed, "of initial states and noise");
  add_strict_option(command, a->strict);
  add_threads_option(command, a->question.threads);
  add_power_options(command, *a);
  add_map_options(command, a->map);
  add_json_option(command, a->json);
  return {&command, [a] { return hide_or_measure_power(*a); }};
}

}  // namespace shakedown
