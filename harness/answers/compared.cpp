// SPDX-License-Identifier: MIT
#include "compared.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "compare_report.hpp"
#include "course.hpp"
#include "diagnosis.hpp"
#include "drawn_curves.hpp"
#include "effects.hpp"
#include "judged_as_given.hpp"
#include "knobs_report.hpp"
#include "known_to_errors.hpp"
#include "missing_numbers.hpp"
#include "parameter_knobs.hpp"
#include "release_known.hpp"
#include "swing.hpp"
#include "swing_judged.hpp"
#include "turned_model.hpp"
#include "validation.hpp"

namespace shakedown {

namespace {

/// Says how bad the misfit of a run is.
std::string_view severity(const RunComparison& run) {
  const double ratio = run.error_box / run.floor_box;
  if (std::isnan(run.chance_box) ? ratio < 1.3 : run.chance_box > features_rejected)
    return "within the spread";
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

std::string beside(const MeasuredNumber& number, double scale, int digits, const char* unit = "") {
  if (!std::isfinite(number.measured) || !std::isfinite(number.model))
    return "not found (too few peaks or crossings)";
  return fmt::format("{:.{}f} ({:.{}f} +- {:.{}f}){}", number.measured * scale, digits, number.model * scale,
                     digits, number.spread * scale, digits, unit);
}

std::string readable(const std::vector<DecayComparison>& decays) {
  std::string text = "  measured (model +- spread from run to run)\n";
  for (const DecayComparison& run : decays) {
    text += fmt::format("    {:<12} frequency {}, slope of |peaks| {}\n      peaks, mm:", run.run,
                        beside(run.frequency, 1, 4, " Hz"), beside(run.slope, 1e3, 2, " mm/s"));
    for (const MeasuredNumber& peak : run.peaks) text += " " + beside(peak, 1e3, 1);
    text += "\n";
    if (run.forced) text += "      forced: " + told(*run.forced) + "\n";
    if (!run.landings.empty()) text += "      " + told(run.landings) + "\n";
  }
  return text;
}

/// Returns a length in mm; "-" where the grains' centre was not tracked.
std::string of_centre(const RunComparison& run, double metres) {
  return run.floor_centre > 0 ? fmt::format("{:.3f}", metres * 1e3) : "-";
}

}  // namespace

std::string compared_text(const Compared& compared) {
  const auto& [measurement, warnings, notes, fit, decays, momentum, judgement, last] = compared;
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
                        of_centre(run, run.floor_centre), severity(run));
  const bool has_ensembles = !last.swing;
  if (has_ensembles)
    text += fmt::format("  whole: p = {:.3f} ({:.2f} times the misfit of the model's own runs)\n",
                        fit.p_value, fit.scatter);
  text += nuisances_text(nuisances_of(fit, all_effects()));
  text += "\n" + validation_text(fit.validation()) + "\n";
  if (has_ensembles) text += readable(fit.cells);
  text += readable(decays);
  if (momentum.possible) {
    text += fmt::format("  momentum balance: chi2 per degree of freedom {:.3f}, p = {:.3g}\n",
                        momentum.as_given.chi2_per_degree(), momentum.as_given.p_value);
    for (const RunBalance& run : momentum.runs)
      text +=
          fmt::format("    {:<16} force that the model lacks {:.2f} mN rms (noise of one window {:.2f} mN)\n",
                      run.run, run.missing_force * 1e3, run.missing_force_noise * 1e3);
  }
  for (const std::string& note : warnings) text += "  note: " + note + "\n";
  return text;
}

namespace {

nlohmann::ordered_json json_of(const MeasuredNumber& number, double scale) {
  return {{"measured", number.measured * scale},
          {"model", number.model * scale},
          {"spread", number.spread * scale}};
}

nlohmann::ordered_json json_of(const std::vector<LandingComparison>& landings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const LandingComparison& landing : landings) {
    list.push_back({{"time_s", landing.time}});
    for (const LandingRow& row : landing_rows())
      list.back()[row.key] = json_of(landing.*row.number, row.scale);
  }
  return list;
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
    if (run.forced)
      for (const ForcedRow& row : rows_of(*run.forced))
        list.back()["forced"][row.key] = json_of(row.number, row.scale);
    list.back()["landings"] = json_of(run.landings);
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

}  // namespace

std::string compared_json(const Compared& compared) {
  const auto& [measurement, warnings, notes, fit, decays, momentum, judgement, last] = compared;
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
      {"camera", nuisances_json(nuisances_of(fit, all_effects()))},
      {"where", json_of(fit.cells)},
      {"decay", json_of(decays)},
      {"momentum",
       {{"possible", momentum.possible},
        {"chi2_per_dof", momentum.as_given.chi2_per_degree()},
        {"p_value", momentum.as_given.p_value}}},
      {"curves", curves_json(last)},
      {"notes", notes}};
  const std::string& no_balance = momentum.why_not;
  explain_missing_numbers(all, [&](const std::string& path) {
    const auto begins = [&](std::string_view with) { return path.rfind(with, 0) == 0; };
    if (path.find("com_mm") != std::string::npos) return std::string("the grains' centre was not tracked");
    if (path == "/p_value") return std::string("an empty box has no ensembles: its waveform is judged");
    if (begins("/decay/")) return std::string("too few peaks or crossings in the run");
    return begins("/momentum/") ? no_balance : std::string();
  });
  return all.dump();
}

namespace {

/// Compares boxes without grains; returns false where no run swings long enough.
bool compare_by_waveform(const Setup& setup, const Measurement& recorded, const Engine& engine,
                         const std::vector<Knob>& knobs, Compared& compared) {
  std::optional<JudgedSwing> judged = judged_swing(setup, recorded, knobs, compared.momentum, all_effects());
  if (!judged) return false;
  compared.fit = std::move(judged->refit);
  compared.judgement = judged->judgement;
  compared.last = {recorded, {}, std::move(judged->found)};
  // A box alone has no spread, and a spread needs two runs.
  const Workshop workshop{&engine, all_effects(), {1}};
  compared.decays = compare_decay(compared.measurement, workshop, 2, 1);
  return true;
}

}  // namespace

Compared compared_with(const Setup& setup, const Measurement& recorded, const Engine& engine,
                       const CompareOptions& options) {
  Compared compared;
  compared.measurement = from_first_turns(with_measured_release(recorded, all_effects()), engine);
  compared.warnings = recorded.warnings;
  compared.notes = all_notes(recorded);
  const Measurement& measurement = compared.measurement;
  compared.momentum = audit_momentum(recorded, all_effects());
  if (is_empty(setup, recorded) &&
      compare_by_waveform(setup, recorded, engine, as_given(setup, measurement.known, all_effects()),
                          compared))
    return compared;
  std::int64_t done = 0;
  const double all = static_cast<double>(options.runs) * static_cast<double>(measurement.runs.size());
  const auto told = [&](int n) {
    done += n;
    if (options.progress) options.progress(std::min(1.0, static_cast<double>(done) / all));
  };
  const Workshop workshop{&engine, all_effects(), options.execution, nullptr, {}, {told, {}}};
  compared.last = {measurement, EnsembleFit{setup, {}, {}, {}}, {}};
  EnsembleFit& ensembles = *compared.last.ensembles;
  JudgedAsGiven judged =
      judged_as_given(setup, measurement, compared.momentum.wander_of_tracks(), workshop, options.runs);
  ensembles.measured = std::move(judged.measured);
  compared.fit = std::move(judged.fit);
  ensembles.fit = ensembles.as_given = compared.fit;
  compared.decays = compare_decay(measurement, workshop, std::min(32, options.runs), 1);
  compared.judgement = judgement_of(
      compared.fit.test(), compared.momentum.test_of(compared.momentum.as_given), compared.fit.left());
  return compared;
}

namespace {

/// Returns what a reader may turn: the parameters and the camera, as nothing was found and nothing is
/// suspected.
ReportKnobs knobs_of_comparison(const LastFit& last, const Setup& setup, const Engine& engine,
                                const Execution& execution) {
  if (last.swing) return knobs_of(turned_numbers(*last.swing, setup, {}, all_effects()), last, setup);
  TurnedOptions options;
  options.known = all_effects();
  options.execution = execution;
  constexpr double seconds = 20;
  options.seconds = seconds;
  return knobs_of(turned_model(*last.ensembles, setup, engine, options), last, setup);
}

}  // namespace

Report report_of(const Compared& compared, const Setup& setup, const Engine& engine,
                 const Execution& execution) {
  return report_of({compared.fit, compared.momentum, compared.judgement, compared.decays},
                   compared.measurement, setup,
                   drawn_curves(compared.measurement, nullptr, setup,
                                compared.last.ensembles ? &compared.last : nullptr, engine, execution),
                   knobs_of_comparison(compared.last, setup, engine, execution));
}

}  // namespace shakedown
