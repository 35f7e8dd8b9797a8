// SPDX-License-Identifier: MIT
// shakedown compare: is the model acceptable, and where does it fail? Nothing is fitted.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "camera_features.hpp"
#include "command.hpp"
#include "compare_report.hpp"
#include "decay_comparison.hpp"
#include "diagnosis.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "ensemble_options.hpp"
#include "experiment_file.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "knobs_report.hpp"
#include "measured_data.hpp"
#include "missing_numbers.hpp"
#include "momentum.hpp"
#include "output_file.hpp"
#include "parameter_knobs.hpp"
#include "progress_display.hpp"
#include "refit.hpp"
#include "report_output.hpp"
#include "setup_arguments.hpp"
#include "swing.hpp"
#include "validation.hpp"

namespace shakedown {

namespace {

struct CompareArguments {
  std::string engine = "hard";
  SetupArguments setup;
  JsonOutput json;
  ReportOutput report;
  std::string data, out;
  int runs = 128, threads = 0;
};

/// How bad a misfit is, in words, by the error over what noise and run-to-run spread make.
std::string_view severity(double ratio) {
  if (ratio < 1.3) return "within the spread";
  if (ratio < 2) return "slight";
  return ratio < 5 ? "clear" : "gross";
}

constexpr double significant = 0.05;  // family-wise
constexpr std::size_t most_cells = 8;

std::string readable(const std::vector<FailureCell>& cells) {
  std::string text = "  where it fails (chance of any part as bad, with all parts looked at allowed for):\n";
  std::size_t shown = 0;
  for (const FailureCell& cell : cells) {
    if (cell.p_value >= significant || shown++ >= most_cells) break;
    text += line_of(cell);
  }
  return shown > 0 ? text : "  no run, time, phase, amplitude, landing or flight stands out\n";
}

std::string beside(const MeasuredNumber& number, double scale, int digits) {
  if (!std::isfinite(number.measured) || !std::isfinite(number.model))
    return "not found (too few peaks or crossings)";
  return fmt::format("{:.{}f} ({:.{}f} +- {:.{}f})", number.measured * scale, digits, number.model * scale,
                     digits, number.spread * scale, digits);
}

std::string readable(const std::vector<DecayComparison>& decays) {
  std::string text = "  measured (model +- spread from run to run)\n";
  for (const DecayComparison& run : decays) {
    text += fmt::format("    {:<12} frequency {} Hz, slope of |peaks| {} mm/s\n      peaks, mm:", run.run,
                        beside(run.frequency, 1, 4), beside(run.slope, 1e3, 2));
    for (const MeasuredNumber& peak : run.peaks) text += " " + beside(peak, 1e3, 1);
    text += "\n";
  }
  return text;
}

/// "-" where the grains' centre was not tracked.
std::string of_centre(const RunComparison& run, double metres) {
  return run.floor_centre > 0 ? fmt::format("{:.3f}", metres * 1e3) : "-";
}

std::string readable(const Refit& fit, const MomentumAudit& momentum,
                     const std::vector<DecayComparison>& decays, const ModelJudgement& judgement) {
  std::string text =
      judgement.holds()
          ? "The model holds: what remains is within camera noise and the spread from run to run.\n"
      : judgement.standing == Standing::fails ? "The data reject the model.\n"
                                              : "Whether the model holds is undecided.\n";
  text += "  " + judgement.reason + "\n";
  text +=
      fmt::format("  {:<16} {:>11} {:>9} {:>14} {:>9}\n", "run", "box, mm", "spread", "centre, mm", "spread");
  for (const RunComparison& run : fit.runs)
    text += fmt::format("  {:<16} {:>11.3f} {:>9.3f} {:>14} {:>9}  {}\n", run.run, run.error_box * 1e3,
                        run.floor_box * 1e3, of_centre(run, run.error_centre),
                        of_centre(run, run.floor_centre), severity(run.error_box / run.floor_box));
  text += fmt::format("  whole: p = {:.3f} ({:.2f} times the misfit of the model's own runs)\n", fit.p_value,
                      fit.scatter);
  text += "\n" + validation_text(fit.validation()) + "\n" + readable(fit.cells) + readable(decays);
  if (momentum.possible) {
    text += fmt::format("  momentum balance: chi2 per degree of freedom {:.3f}, p = {:.3g}\n",
                        momentum.as_given.chi2_per_degree(), momentum.as_given.p_value);
    for (const RunBalance& run : momentum.runs)
      text +=
          fmt::format("    {:<16} force that the model lacks {:.2f} mN rms (noise of one window {:.2f} mN)\n",
                      run.run, run.missing_force * 1e3, run.missing_force_noise * 1e3);
  }
  return text;
}

nlohmann::ordered_json json_of(const MeasuredNumber& number, double scale) {
  return {{"measured", number.measured * scale},
          {"model", number.model * scale},
          {"spread", number.spread * scale}};
}

nlohmann::ordered_json json_of(const std::vector<DecayComparison>& decays) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const DecayComparison& run : decays) {
    nlohmann::ordered_json peaks = nlohmann::ordered_json::array();
    for (const MeasuredNumber& peak : run.peaks) peaks.push_back(json_of(peak, 1e3));
    list.push_back({{"run", run.run},
                    {"frequency_hz", json_of(run.frequency, 1)},
                    {"slope_mm_per_s", json_of(run.slope, 1e3)},
                    {"peaks_mm", peaks}});
  }
  return list;
}

nlohmann::ordered_json json_of(const std::vector<FailureCell>& cells) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FailureCell& cell : cells)
    list.push_back(
        {{"run", cell.run.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(cell.run)},
         {"observable", cell.observable},
         {"what", cell.what},
         {"from_s", cell.from},
         {"to_s", cell.to},
         {"error_mm", cell.error * 1e3},
         {"sigmas", cell.sigmas},
         {"p_value", cell.p_value}});
  return list;
}

nlohmann::ordered_json json_of(const Refit& fit, const MomentumAudit& momentum,
                               const std::vector<DecayComparison>& decays, const ModelJudgement& judgement,
                               const std::vector<std::string>& notes, const LastFit& last) {
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  for (const RunComparison& run : fit.runs)
    runs.push_back({{"run", run.run},
                    {"error_box_mm", run.error_box * 1e3},
                    {"floor_box_mm", run.floor_box * 1e3},
                    {"error_com_mm", run.floor_centre > 0 ? run.error_centre * 1e3 : std::nan("")},
                    {"floor_com_mm", run.floor_centre > 0 ? run.floor_centre * 1e3 : std::nan("")},
                    {"chi2", run.chi2}});
  nlohmann::ordered_json all{
      {"schema_version", 1},
      {"holds", judgement.holds()},
      {"standing", std::string(name_of(judgement.standing))},
      {"reason", judgement.reason},
      {"p_value", fit.p_value},
      {"scatter", fit.scatter},
      {"error_box_mm", fit.error_box() * 1e3},
      {"error_com_mm", fit.floor_centre() > 0 ? fit.error_centre() * 1e3 : std::nan("")},
      {"noise_floor",
       {{"box_mm", fit.floor_box() * 1e3},
        {"com_mm", fit.floor_centre() > 0 ? fit.floor_centre() * 1e3 : std::nan("")}}},
      {"runs", runs},
      {"validation", validation_json(fit.validation())},
      {"where", json_of(fit.cells)},
      {"decay", json_of(decays)},
      {"momentum",
       {{"possible", momentum.possible},
        {"chi2_per_dof", momentum.as_given.chi2_per_degree()},
        {"p_value", momentum.as_given.p_value}}},
      {"curves", curves_json(last)},
      {"notes", notes}};
  explain_missing_numbers(all, [&](const std::string& path) {
    const auto begins = [&](std::string_view with) { return path.rfind(with, 0) == 0; };
    if (path.find("com_mm") != std::string::npos) return std::string("the grains' centre was not tracked");
    if (begins("/decay/")) return std::string("too few peaks or crossings in the run");
    return begins("/momentum/") ? momentum.why_not : std::string();
  });
  return all;
}

/// Nothing was found and nothing is suspected: the parameters and the camera are there to be turned.
ReportKnobs knobs_of(const LastFit& last, const Setup& setup, const Engine& engine, int threads) {
  TurnedOptions options;
  options.known = all_effects();
  options.threads = threads;
  options.stop = catch_interruption();
  constexpr double seconds = 20;
  options.seconds = seconds;
  return knobs_of(turned_model(*last.ensembles, setup, engine, options), last, setup);
}

int compare(const CompareArguments& arguments) {
  Setup setup = arguments.setup.read(given_by_measurements);
  const Measurement recorded = measurement_of(setup, read_measured(arguments.data, setup), all_effects());
  arguments.json.check();
  arguments.report.check();
  std::unique_ptr<OutputFolder> folder;
  if (!arguments.out.empty())
    folder = std::make_unique<OutputFolder>(arguments.out, OutputFolder::Use::alone);
  const std::unique_ptr<Engine> engine = engine_named(arguments.engine);
  const Measurement measurement = from_first_turns(recorded, *engine);
  RefitOptions options;
  options.count = arguments.runs;
  options.rounds = options.most_rounds = 1;
  Refit fit;
  LastFit last{measurement, EnsembleFit{setup, {}, {}, {}}, {}};
  std::vector<DecayComparison> decays;
  {
    ProgressDisplay display(
        fmt::format("{}: comparing with {} runs of each setup", arguments.data, arguments.runs));
    std::int64_t done = 0;
    const double all = static_cast<double>(arguments.runs) * static_cast<double>(measurement.runs.size());
    const Workshop workshop{engine.get(),
                            all_effects(),
                            arguments.threads,
                            catch_interruption(),
                            [&](int n) { display.show(std::min(1.0, static_cast<double>(done += n) / all)); },
                            nullptr};
    std::vector<Knob> knobs = as_given(setup, measurement.known, all_effects());
    for (Knob& knob : camera_knobs(setup, measurement, all_effects())) knobs.push_back(std::move(knob));
    last.ensembles->measured = features_with_camera(measurement, all_effects());
    fit = refit(last.ensembles->measured, knobs, workshop, options);
    last.ensembles->fit = last.ensembles->as_given = fit;
    decays = compare_decay(measurement, workshop, std::min(32, arguments.runs), 1);
  }
  const MomentumAudit momentum = audit_momentum(recorded, all_effects());
  const ModelJudgement judgement = judgement_of(fit.test(), momentum.test_of(momentum.as_given), fit.left());
  const PaperValues taken(setup, given_by_measurements);
  const std::string document =
      taken.added_to(json_of(fit, momentum, decays, judgement, all_notes(recorded), last).dump());
  taken.print(arguments.json.for_people());
  fmt::print(arguments.json.for_people(), "{}", readable(fit, momentum, decays, judgement));
  for (const std::string& note : recorded.warnings)
    fmt::print(arguments.json.for_people(), "  note: {}\n", note);
  if (folder) folder->write("compare.json", document);
  if (arguments.report.wanted(arguments.out)) {
    CurveOptions drawn;
    drawn.threads = arguments.threads;
    drawn.known = all_effects();
    drawn.stop = catch_interruption();
    const std::vector<MeasuredAgainstModel> curves =
        measured_against_model(measurement, nullptr, setup, *engine, drawn);
    fmt::print(arguments.json.for_people(), "{}",
               arguments.report.write(report_of(fit, momentum, judgement, measurement, setup, curves,
                                                knobs_of(last, setup, *engine, arguments.threads)),
                                      arguments.out));
  }
  arguments.json.write(document);
  return judgement.holds() ? exit_done : exit_model_rejected;
}

}  // namespace

Command add_compare_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "compare", "is the model acceptable for these measurements, and where does it fail");
  const auto arguments = std::make_shared<CompareArguments>();
  add_setup_arguments(command, arguments->setup);
  command.add_option("--data", arguments->data, "experiment file")->type_name("EXPERIMENT")->required();
  add_simulations_option(command, arguments->runs);
  add_threads_option(command, arguments->threads);
  command
      .add_option("--out", arguments->out,
                  "write compare.json and what `shakedown report` needs into this folder")
      ->type_name("DIR");
  add_report_option(command, arguments->report);
  command.add_option("--engine", arguments->engine, "hard, soft or bullet")
      ->type_name("NAME")
      ->capture_default_str();
  add_json_option(command, arguments->json);
  command.footer(
      "Exit code 0: the model holds. 1: it fails, or that is undecided. The rule, the same for compare, "
      "ladder,\n"
      "fit and diagnose: a model fails where the momentum balance has p <= 0.001, or the features p <= 0.01 "
      "with a\n"
      "misfit of 1.4 times that of the model's own runs or more, or where more than 2.5 times noise and "
      "spread from\n"
      "run to run remain; with a smaller misfit it is undecided, for two codes of one physics differ by as "
      "much, and\n"
      "so it is where a p-value could not be computed.");
  return {&command, [arguments] { return compare(*arguments); }};
}

}  // namespace shakedown
