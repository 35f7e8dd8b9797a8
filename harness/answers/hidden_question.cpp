// SPDX-License-Identifier: MIT
#include "hidden_question.hpp"

#include <fmt/format.h>

#include <memory>

#include "comma_list.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "output_file.hpp"
#include "toml_document.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

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

/// Refuses an effect that does nothing without another one that is not there: a film of it would tell of
/// nothing.
void expect_what_they_need(const Setup& truth) {
  std::vector<Violation> found;
  for (const EffectChoice& choice : truth.effects)
    if (const std::string needs(choice.record->needs); !needs.empty() && find_choice(truth, needs) == nullptr)
      found.push_back({{"--effect", 0, 0},
                       std::string(choice.record->name),
                       "does nothing without " + needs,
                       "hide both: --effect " + needs + " --effect " + std::string(choice.record->name)});
  if (!found.empty()) throw InputError(std::move(found));
}

HiddenCase hidden_case(const HiddenQuestion& question) {
  std::vector<Override> common, truth;
  std::vector<Violation> found;
  if (!question.duration.empty()) common.push_back({"run.duration", question.duration, "--duration"});
  const Setup believed = question.setup_with(common);
  read_each(question.effects, found, [&](const std::string& text) {
    for (Override& override : overrides_of_effect(text, "--effect", believed))
      truth.push_back(std::move(override));
  });
  read_each(question.parameters, found,
            [&](const std::string& text) { truth.push_back(parse_override(text)); });
  if (!found.empty()) throw InputError(std::move(found));
  truth.insert(truth.begin(), common.begin(), common.end());
  HiddenCase hidden{believed, question.setup_with(truth)};
  expect_what_they_need(hidden.truth);
  return hidden;
}

std::vector<PlannedRun> planned_runs(const HiddenQuestion& question) {
  std::vector<double> lengths;
  std::vector<Violation> found;
  for (const std::string& text : names_in(question.lengths)) {
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
  read_each(question.runs, found, [&](const std::string& text) {
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

RecordingSettings recording_of(const HiddenQuestion& question) {
  std::vector<std::string> parts;
  for (const std::string& text : question.camera)
    for (std::string& part : split_at_commas(text)) parts.push_back(std::move(part));
  return parse_recording(parts);
}

}  // namespace

Trial trial_of(const HiddenQuestion& question) {
  Trial trial;
  std::vector<Violation> found;
  collect(found, [&] { trial.hidden = hidden_case(question); });
  collect(found, [&] { trial.runs = planned_runs(question); });
  collect(found, [&] { trial.recording = recording_of(question); });
  collect(found, [&] {
    trial.known = with_known(usually_known(trial.hidden.believed, trial.recording), question.known);
  });
  if (!found.empty()) throw InputError(std::move(found));
  trial.seed = question.seed;
  return trial;
}

Experiment measured(const HiddenQuestion& question, const Trial& trial, const std::atomic<bool>* stop,
                    const std::function<void(double fraction)>& progress) {
  const std::unique_ptr<Engine> engine = engine_named(question.engine);
  const Laboratory laboratory{engine.get(), all_effects(), question.seed, {question.threads, stop}, progress};
  Experiment experiment = make_measurements(trial.hidden.truth, trial.runs, trial.recording, laboratory);
  experiment.known = trial.known;
  experiment.title = question.title.empty() ? "granular damper, synthetic" : question.title;
  return experiment;
}

void write_case(const std::filesystem::path& folder, const std::filesystem::path& truth,
                const HiddenQuestion& question, const Trial& trial, const Experiment& experiment) {
  write_file(folder / "setup.toml", std::string(first_line_of_case) + write_setup(trial.hidden.believed));
  write_measurements(folder, experiment);
  write_file(truth, truth_json(trial.hidden, trial.recording, question.engine, question.seed));
}

}  // namespace shakedown
