// SPDX-License-Identifier: MIT
// shakedown hide: synthetic measurements with something hidden in them.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "comma_list.hpp"
#include "command.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "hidden_case.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "output_file.hpp"
#include "paper_values.hpp"
#include "progress_display.hpp"
#include "setup_arguments.hpp"
#include "toml_document.hpp"
#include "trial.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

struct HideArguments {
  std::string setup, out, truth, engine = "soft", lengths = "40mm,40mm,65mm,85mm,104mm", duration, title;
  std::vector<std::string> effects, parameters, camera, runs, known;
  std::uint64_t seed = 1;
  int threads = 0;
  bool power = false, strict = false;
  int repeats = 20;
  std::int64_t budget = 0;
  JsonOutput json;
};

/// Collects violations of several arguments, so that all are reported at once.
template <class Read>
void collect(std::vector<Violation>& found, Read read) {
  try {
    read();
  } catch (const InputError& error) {
    found.insert(found.end(), error.violations.begin(), error.violations.end());
  }
}

template <class Read>
void read_each(const std::vector<std::string>& texts, std::vector<Violation>& found, Read read) {
  for (const std::string& text : texts) collect(found, [&] { read(text); });
}

HiddenCase hidden_case(const HideArguments& arguments) {
  std::vector<Override> common, truth;
  std::vector<Violation> found;
  if (!arguments.duration.empty()) common.push_back({"run.duration", arguments.duration, "--duration"});
  const Setup believed = read_setup(arguments.setup, all_effects(), common);
  read_each(arguments.effects, found, [&](const std::string& text) {
    for (Override& override : overrides_of_effect(text, "--effect", believed))
      truth.push_back(std::move(override));
  });
  read_each(arguments.parameters, found,
            [&](const std::string& text) { truth.push_back(parse_override(text)); });
  if (!found.empty()) throw InputError(std::move(found));
  truth.insert(truth.begin(), common.begin(), common.end());
  if (arguments.strict) refuse_paper_values(believed, arguments.setup, given_by_measurements);
  return {believed, read_setup(arguments.setup, all_effects(), truth)};
}

std::vector<PlannedRun> planned_runs(const HideArguments& arguments) {
  std::vector<double> lengths;
  std::vector<Violation> found;
  for (const std::string& text : names_in(arguments.lengths)) {
    TomlValue value;
    value.kind = TomlValue::Kind::text;
    value.text = text;
    const ValueOrProblem<double> length = number_in(value, "mm");
    if (const Problem* wrong = std::get_if<Problem>(&length))
      found.push_back({{"--lengths", 0, 0}, "", wrong->problem, wrong->remedy});
    else
      lengths.push_back(std::get<double>(length));
  }
  std::vector<PlannedRun> runs = runs_of_lengths(lengths);
  int number = 0;
  read_each(arguments.runs, found, [&](const std::string& text) {
    PlannedRun run{fmt::format("run_{}", ++number), {}};
    for (const std::string& part : split_at_commas(text))
      run.overrides.push_back(parse_override(part, "--run"));
    runs.push_back(std::move(run));
  });
  if (found.empty() && runs.empty())
    found.push_back({{"--lengths", 0, 0}, "", "names no run", "give at least one length, or --run"});
  if (!found.empty()) throw InputError(std::move(found));
  return runs;
}

RecordingSettings recording_of(const HideArguments& arguments) {
  std::vector<std::string> parts;
  for (const std::string& text : arguments.camera)
    for (std::string& part : split_at_commas(text)) parts.push_back(std::move(part));
  return parse_recording(parts);
}

/// Everything that the arguments say, or everything that is wrong with them.
Trial trial_of(const HideArguments& arguments) {
  Trial trial;
  std::vector<Violation> found;
  collect(found, [&] { trial.hidden = hidden_case(arguments); });
  collect(found, [&] { trial.runs = planned_runs(arguments); });
  collect(found, [&] { trial.recording = recording_of(arguments); });
  collect(found, [&] {
    trial.known = with_known(usually_known(trial.hidden.believed, trial.recording), arguments.known);
  });
  if (!arguments.power && arguments.out.empty())
    found.push_back({{"--out", 0, 0},
                     "",
                     "is missing (where shall the measurements go?)",
                     "name a folder, or ask for the --power of a diagnosis"});
  if (!found.empty()) throw InputError(std::move(found));
  trial.seed = arguments.seed;
  return trial;
}

Experiment measured(const HideArguments& arguments, const Trial& trial) {
  const std::unique_ptr<Engine> engine = engine_named(arguments.engine);
  ProgressDisplay display(fmt::format("{}: measuring with engine {}", arguments.setup, arguments.engine));
  const Laboratory laboratory{engine.get(),         all_effects(),
                              arguments.seed,       arguments.threads,
                              catch_interruption(), [&](double fraction) { display.show(fraction); }};
  Experiment experiment = make_measurements(trial.hidden.truth, trial.runs, trial.recording, laboratory);
  experiment.known = trial.known;
  experiment.title = arguments.title.empty() ? "granular damper, synthetic" : arguments.title;
  return experiment;
}

constexpr const char* first_line = "# What the user believes; box.length is replaced by each run's.\n";

/// The files of the case that an earlier `hide` left in the folder; empty where there is none. Throws
/// InputError where somebody else's experiment is there.
std::vector<std::filesystem::path> earlier_case(const OutputFolder& folder) {
  const std::filesystem::path experiment = folder.path() / "experiment.toml",
                              setup = folder.path() / "setup.toml";
  if (!std::filesystem::exists(experiment)) return {};
  if (!std::filesystem::exists(setup) || !read_text_file(setup).starts_with(first_line))
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
  const Experiment experiment = measured(arguments, trial);
  folder.remove(earlier);
  folder.write("setup.toml", first_line + write_setup(trial.hidden.believed));
  write_measurements(folder.path(), experiment);
  write_file(truth, truth_json(trial.hidden, trial.recording, arguments.engine, arguments.seed));
  std::FILE* people = arguments.json.for_people();
  fmt::print(people, "{} runs in {}\nwhat is hidden: {} (do not look before the diagnosis is made)\n",
             experiment.runs.size(), folder.path().string(), truth.string());
  fmt::print(people, "shakedown diagnose {0}/setup.toml --data {0}/experiment.toml\n",
             folder.path().string());
  const PaperValues taken(trial.hidden.believed, given_by_measurements);
  taken.print(people);
  std::vector<std::string> names;
  for (const MeasuredRun& run : experiment.runs) names.push_back(run.name);
  arguments.json.write(taken.added_to(nlohmann::ordered_json{
      {"schema_version", 1}, {"folder", folder.path().string()}, {"truth", truth.string()}, {"runs", names}}
                                          .dump()));
  return exit_done;
}

nlohmann::ordered_json json_of(const Share& share) {
  return {{"hits", share.hits},
          {"trials", share.trials},
          {"share", share.value},
          {"low", share.low},
          {"high", share.high}};
}

/// Would a diagnosis see it? Nothing is written.
int measure_power(const HideArguments& arguments, const Trial& trial) {
  const std::unique_ptr<Engine> laboratory = engine_named(arguments.engine), model = engine_named("hard");
  arguments.json.check();
  const TrialTools tools{laboratory.get(),  model.get(),          all_effects(),        arguments.budget,
                         arguments.threads, catch_interruption(), &strength_uncertainty};
  const Power power = power_of(trial, arguments.repeats, tools, [&](int done, const std::string& answer) {
    fmt::print(stderr, "{:>3} of {}: {}\n", done, arguments.repeats, answer);
  });
  const std::vector<std::string> hidden = hidden_effects(trial.hidden);
  std::string names;
  for (const std::string& effect : hidden) names += (names.empty() ? "" : " + ") + effect;
  fmt::print(arguments.json.for_people(),
             "hidden: {}\n  something is found missing: {}\n  answered exactly:           {}\n  answers:\n",
             names.empty() ? "nothing" : names, in_words(power.detected), in_words(power.named));
  nlohmann::ordered_json answers = nlohmann::ordered_json::object();
  for (const auto& [answer, times] : power.answers) {
    fmt::print(arguments.json.for_people(), "    {:>3}  {}\n", times, answer);
    answers[answer] = times;
  }
  arguments.json.write(nlohmann::ordered_json{{"schema_version", 1},
                                              {"hidden", hidden},
                                              {"detected", json_of(power.detected)},
                                              {"named", json_of(power.named)},
                                              {"answers", answers}}
                           .dump(2) +
                       "\n");
  return exit_done;
}

int hide_or_measure_power(const HideArguments& arguments) {
  const Trial trial = trial_of(arguments);
  return arguments.power ? measure_power(arguments, trial) : hide(arguments, trial);
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
  many("--effect", a->effects,
       "hide this effect (at its typical strength when no parameter is given); may be repeated",
       "NAME[=k:v,...]");
  many("--set", a->parameters,
       "what else is different in the laboratory, e.g. restitution.grain_grain=0.8; may be repeated",
       "KEY=VALUE");
  command.add_option("--out", a->out, "folder for setup.toml, experiment.toml, the tables and truth.json")
      ->type_name("DIR");
  command.add_option("--truth", a->truth, "put the answer there instead of DIR/truth.json")
      ->type_name("FILE");
  command.add_option("--lengths", a->lengths, "box length of each run; \"\" for none")
      ->type_name("L,L,...")
      ->capture_default_str();
  many("--run", a->runs,
       "one more run with keys of its own, e.g. box.length=40mm,grains.count=0; may be repeated",
       "KEY=VALUE,...");
  command.add_option("--engine", a->engine, "the laboratory's")->type_name("NAME")->capture_default_str();
  many("--camera", a->camera,
       "noise.box, noise.centre (0.2 mm, 0.5 mm), fps (500), missing, outliers (0), jump (20 mm), "
       "centre=false; a camera as it is: lens=0.5%, shutter=1ms, near=0.5%, wander=20um/0.3s, and by run "
       "trigger=1ms, release=0.3mm; a table as it is: rounding=0.1mm, jitter=1ms, stamped=true, start=0.2s, "
       "origin=2mm, declared=false",
       "KEY=VALUE,...");
  many("--known", a->known,
       "what its experimenter knows, e.g. \"box.mass=434 g +- 2 g\", in the place of or beside the usual "
       "errors of masses, release, scale and trigger; may be repeated",
       "KEY=VALUE +- ERROR");
  command.add_option("--duration", a->duration, "of each run, e.g. \"20 s\"; default: the setup's")
      ->type_name("TIME");
  command.add_option("--title", a->title, "of the experiment");
  add_seed_option(command, a->seed, "of initial states and noise");
  add_strict_option(command, a->strict);
  add_threads_option(command, a->threads);
  command.add_flag(
      "--power", a->power,
      "write nothing; repeat measurement and diagnosis: how often is the effect seen, how often named?");
  command.add_option("--repeats", a->repeats, "with --power")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command
      .add_option("--budget", a->budget,
                  "with --power: simulations of one diagnosis at most; default: as `shakedown diagnose`")
      ->check(positive_number())
      ->type_name("RUNS");
  add_json_option(command, a->json);
  return {&command, [a] { return hide_or_measure_power(*a); }};
}

}  // namespace shakedown
