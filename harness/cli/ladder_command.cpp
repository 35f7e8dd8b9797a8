// SPDX-License-Identifier: MIT
// shakedown ladder: several setups beside each other, judged by the same measurements.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "camera_features.hpp"
#include "command.hpp"
#include "course.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "experiment.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "known_setup.hpp"
#include "ladder_report.hpp"
#include "measured_data.hpp"
#include "missing_numbers.hpp"
#include "momentum.hpp"
#include "output_file.hpp"
#include "paper_values.hpp"
#include "parameter_knobs.hpp"
#include "progress_display.hpp"
#include "refit.hpp"
#include "report_output.hpp"
#include "setup_arguments.hpp"
#include "swing.hpp"
#include "swing_judged.hpp"
#include "validation.hpp"

namespace shakedown {

namespace {

struct LadderArguments {
  std::vector<std::string> setups;
  std::string data;
  int runs = 128, threads = 0;
  bool refit = false, strict = false;
  JsonOutput json;
  ReportOutput report;
  std::string out;
};

std::string effects_of(const Setup& setup) {
  std::string names;
  for (const EffectChoice& choice : setup.effects)
    names += (names.empty() ? "" : " + ") + std::string(choice.record->name);
  return names.empty() ? "plain" : names;
}

/// Judges the momentum balance at the frequency of this rung.
MomentumAudit balance_at(const Setup& setup, const Refit& fit, const Measurement& measurement) {
  Setup fitted = setup;
  for (const FittedValue& value : fit.values) set_number(fitted, value.key, value.value, all_effects());
  return audit_momentum(with_setup(measurement, fitted, all_effects()), all_effects());
}

Rung climb(const std::string& file, const Setup& setup, const Measurement& measurement,
           const Workshop& workshop, const LadderArguments& arguments) {
  RefitOptions options;
  options.count = arguments.runs;
  // Refitted, so that a rung with few effects does not lose because its parameters were chosen worse.
  std::vector<Knob> knobs = arguments.refit
                                ? believed(free_parameters(setup), measurement.known, all_effects())
                                : as_given(setup, measurement.known, all_effects());
  const Measurement of_setup = with_setup(measurement, setup, all_effects());
  if (is_empty(setup, of_setup)) {
    const MomentumAudit balance = audit_momentum(of_setup, all_effects());
    if (std::optional<JudgedSwing> judged = judged_swing(setup, of_setup, knobs, balance, all_effects()))
      return {file, effects_of(setup), judged->refit, balance_at(setup, judged->refit, measurement),
              judged->judgement};
  }
  const Measurement beside = from_first_turns(of_setup, *workshop.engine);
  for (Knob& knob : camera_knobs(setup, beside, all_effects())) knobs.push_back(std::move(knob));
  if (!arguments.refit) options.rounds = options.most_rounds = 1;
  Rung rung{file,
            effects_of(setup),
            refit(features_with_camera(beside, all_effects()), knobs, workshop, options),
            {},
            {}};
  rung.momentum = balance_at(setup, rung.fit, measurement);
  return rung;
}

std::vector<Rung> climb_all(const LadderArguments& arguments, const std::vector<Setup>& setups,
                            const Measurement& measurement) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  ProgressDisplay display(fmt::format("{}: {} setups", arguments.data, setups.size()));
  std::int64_t done = 0;
  const double rounds = arguments.refit ? 2 : 1;
  const double all = static_cast<double>(arguments.runs) *
                     static_cast<double>(measurement.runs.size() * setups.size()) * rounds;
  const Workshop workshop{
      engine.get(),
      all_effects(),
      {arguments.threads, catch_interruption()},
      nullptr,
      {},
      {[&](int n) { display.show(std::min(1.0, static_cast<double>(done += n) / all)); }, {}}};
  std::vector<Rung> rungs;
  for (std::size_t i = 0; i < setups.size(); ++i)
    rungs.push_back(climb(arguments.setups[i], setups[i], measurement, workshop, arguments));
  return rungs;
}

/// Returns the p-value of a rung for people; "-" for an empty box, which has none.
std::string p_of(const Rung& rung) {
  return std::isfinite(rung.fit.p_value) ? fmt::format("{:.3f}", rung.fit.p_value) : "-";
}

std::string readable_rungs(const std::vector<Rung>& rungs, bool refitted) {
  std::string text =
      fmt::format("{:<28} {:>16} {:>16} {:>12} {:>8} {:>10} {:>10}\n", "errors and their floor, mm", "box",
                  "grains' centre", refitted ? "held out" : "", "p", "misfit", "momentum");
  for (const Rung& rung : rungs) {
    text += fmt::format("{:<28} {:>8.3f} /{:>6.3f} {:>8.3f} /{:>6.3f} {:>12} {:>8} {:>10.2f} {:>10}  {}\n",
                        rung.setup, rung.fit.error_box() * 1e3, rung.fit.floor_box() * 1e3,
                        rung.fit.error_centre() * 1e3, rung.fit.floor_centre() * 1e3,
                        refitted && std::isfinite(rung.fit.held_out_error_box)
                            ? fmt::format("{:.3f}", rung.fit.held_out_error_box * 1e3)
                            : "",
                        p_of(rung), rung.fit.scatter,
                        rung.momentum.possible ? fmt::format("{:.2g}", rung.momentum.as_given.p_value) : "-",
                        name_of(rung.judgement().standing));
    text += "  " + rung.effects;
    for (const FittedValue& value : rung.fit.values)
      text += fmt::format(", {} {:.4g} +- {:.2g}", value.key, value.value, value.error);
    text += "\n  " + rung.judgement().reason + "\n";
  }
  return text +
         "p: share of experiments of the model's own that fit no better; misfit: times what such experiments "
         "have; momentum: p of its balance.\n";
}

std::string json_of_rungs(const std::vector<Rung>& rungs, bool refitted) {
  nlohmann::ordered_json ladder = nlohmann::ordered_json::array();
  for (const Rung& rung : rungs) {
    nlohmann::ordered_json values = nlohmann::ordered_json::object();
    for (const FittedValue& value : rung.fit.values)
      values[value.key] = {{"value", value.value}, {"low", value.low}, {"high", value.high}};
    ladder.push_back(
        {{"setup", rung.setup},
         {"effects", rung.effects},
         {"error_box_mm", rung.fit.error_box() * 1e3},
         {"error_com_mm", rung.fit.error_centre() * 1e3},
         {"noise_floor", {{"box_mm", rung.fit.floor_box() * 1e3}, {"com_mm", rung.fit.floor_centre() * 1e3}}},
         {"held_out_error_box_mm", refitted ? nlohmann::ordered_json(rung.fit.held_out_error_box * 1e3)
                                            : nlohmann::ordered_json(nullptr)},
         {"p_value", rung.fit.p_value},
         {"scatter", rung.fit.scatter},
         {"chi2", rung.fit.chi2},
         {"momentum_p_value", rung.momentum.possible ? nlohmann::ordered_json(rung.momentum.as_given.p_value)
                                                     : nlohmann::ordered_json(nullptr)},
         {"holds", rung.holds()},
         {"standing", std::string(name_of(rung.judgement().standing))},
         {"reason", rung.judgement().reason},
         {"validation", validation_json(rung.fit.validation())},
         {"parameters", values}});
  }
  nlohmann::ordered_json all{{"schema_version", 1}, {"refitted", refitted}, {"ladder", ladder}};
  explain_missing_numbers(all, [](const std::string& path) -> std::string {
    if (path.ends_with("/p_value")) return "an empty box has no ensembles: its waveform is judged";
    return path.find("held_out") != std::string::npos ? "one box length only: nothing was left out" : "";
  });
  return all.dump(2) + "\n";
}

int ladder(const LadderArguments& arguments) {
  std::vector<Setup> setups;
  std::vector<Violation> wrong;
  for (const std::string& file : arguments.setups) {
    try {
      setups.push_back(read_setup(file, all_effects()));
      if (arguments.strict) refuse_paper_values(setups.back(), file, given_by_measurements);
    } catch (const InputError& error) {
      wrong.insert(wrong.end(), error.violations.begin(), error.violations.end());
    }
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
  const Measurement measurement =
      measurement_of(setups.front(), read_measured(arguments.data, setups.front()), all_effects());
  for (Setup& setup : setups) setup = with_known(setup, measurement.known, all_effects());
  arguments.json.check();
  arguments.report.check();
  std::unique_ptr<OutputFolder> folder;
  if (!arguments.out.empty())
    folder = std::make_unique<OutputFolder>(arguments.out, OutputFolder::Use::alone);
  const std::vector<Rung> rungs = climb_all(arguments, setups, measurement);
  PaperValues taken(setups.front(), given_by_measurements);
  for (const Setup& setup : setups) taken.join(PaperValues(setup, given_by_measurements));
  taken.print(arguments.json.for_people());
  fmt::print(arguments.json.for_people(), "{}", readable_rungs(rungs, arguments.refit));
  const std::string document = taken.added_to(json_of_rungs(rungs, arguments.refit));
  if (folder) folder->write("ladder.json", document);
  if (arguments.report.wanted(arguments.out))
    fmt::print(
        arguments.json.for_people(), "{}",
        arguments.report.write(report_of(rungs, arguments.refit, measurement, setups.back()), arguments.out));
  arguments.json.write(document);
  const bool any = std::any_of(rungs.begin(), rungs.end(), [](const Rung& rung) { return rung.holds(); });
  return any ? exit_done : exit_model_rejected;
}

}  // namespace

Command add_ladder_command(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("ladder", "setups beside each other, judged by the same measurements");
  const auto arguments = std::make_shared<LadderArguments>();
  command.add_option("SETUP", arguments->setups, "setup files (TOML)")->required()->type_name("...");
  command.add_option("--data", arguments->data, "experiment file")->type_name("EXPERIMENT")->required();
  command.add_flag(
      "--refit", arguments->refit,
      "refit both restitutions and the frequency of each, and predict each box length from the others");
  add_strict_option(command, arguments->strict);
  add_simulations_option(command, arguments->runs);
  add_threads_option(command, arguments->threads);
  command
      .add_option("--out", arguments->out,
                  "write ladder.json and what `shakedown report` needs into this folder")
      ->type_name("DIR");
  add_report_option(command, arguments->report);
  add_json_option(command, arguments->json);
  command.footer("Exit code 0: one of the setups holds. 1: none does.");
  return {&command, [arguments] { return ladder(*arguments); }};
}

}  // namespace shakedown
