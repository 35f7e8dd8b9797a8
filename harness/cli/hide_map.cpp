// SPDX-License-Identifier: MIT
// shakedown hide --map: how good must the camera be?
#include "hide_map.hpp"

#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "experiment.hpp"
#include "interruption.hpp"
#include "kept_simulations.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "simulation_journal.hpp"
#include "strength_mapped.hpp"

namespace shakedown {

namespace {

/// Makes the measurements as planned, with nothing hidden in them.
Experiment planned_experiment(HiddenQuestion question, Trial trial) {
  trial.hidden.truth = trial.hidden.believed;
  question.engine = "hard";
  return measured(question, trial, catch_interruption(), {});
}

std::string words_of_trial(const Trial& trial, const HiddenQuestion& question) {
  std::string runs;
  for (const PlannedRun& run : trial.runs) runs += (runs.empty() ? "" : ", ") + run.name;
  return fmt::format("{} runs ({}) of {:g} s, noise of a frame {:g} mm at {:g} Hz{}", trial.runs.size(), runs,
                     trial.hidden.believed.run.duration, 1e3 * trial.recording.box_noise,
                     trial.recording.frame_rate, question.title.empty() ? "" : ": " + question.title);
}

}  // namespace

int map_strengths(const MapArguments& arguments, const HiddenQuestion& question, const Trial& trial,
                  const std::string& out, const JsonOutput& json) {
  json.check();
  arguments.report.check();
  std::unique_ptr<OutputFolder> folder;
  if (!out.empty()) folder = std::make_unique<OutputFolder>(out, OutputFolder::Use::alone);
  const Experiment experiment = planned_experiment(question, trial);
  const Setup& believed = trial.hidden.believed;
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const std::unique_ptr<SimulationJournal> journal =
      journal_in(folder.get(), "map", experiment, arguments.resume);
  MapOptions options;
  options.known = all_effects();
  for (const std::string& effect : question.effects)
    options.effects.push_back(effect.substr(0, effect.find('=')));
  options.execution = {question.threads, catch_interruption()};
  options.seconds = arguments.seconds;
  options.journal = journal.get();
  StrengthMap map;
  try {
    ProgressDisplay display(fmt::format("mapping, {:g} s at most", arguments.seconds));
    options.progress = [&](const std::string& stage, double fraction) {
      display.rename("mapping: " + stage);
      display.show(fraction);
    };
    map = strength_map(believed, measurement_of(believed, experiment, all_effects()), *engine,
                       usual_lines(trial.recording.box_noise), options);
  } catch (const Interrupted&) {
    throw Interrupted(what_is_kept(journal.get()));
  }
  std::FILE* people = json.for_people();
  const std::string words = words_of_trial(trial, question);
  fmt::print(people, "{}\n{}", words, map_text(map));
  if (folder) folder->write("map.json", map_json(map));
  // What was left out for want of time can be gone on with.
  if (journal && map.left_out.empty()) std::filesystem::remove(journal->file());
  if (arguments.report.wanted(out))
    fmt::print(people, "{}", arguments.report.write(report_of(map, believed, words), out));
  json.write(map_json(map));
  return exit_done;
}

}  // namespace shakedown
