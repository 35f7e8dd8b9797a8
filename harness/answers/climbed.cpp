// SPDX-License-Identifier: MIT
#include "climbed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "course.hpp"
#include "effects.hpp"
#include "known_setup.hpp"
#include "known_to_errors.hpp"
#include "missing_numbers.hpp"
#include "momentum.hpp"
#include "parameter_knobs.hpp"
#include "refit.hpp"
#include "release_known.hpp"
#include "swing.hpp"
#include "swing_judged.hpp"
#include "validation.hpp"

namespace shakedown {

namespace {

std::string effects_of(const Setup& setup) {
  std::string names;
  for (const EffectChoice& choice : setup.effects)
    names += (names.empty() ? "" : " + ") + std::string(choice.record->name);
  return names.empty() ? "plain" : names;
}

/// Judges the momentum balance at the frequency of this rung; the errors of masses are its own.
MomentumAudit balance_at(const Setup& setup, const Refit& fit, const std::vector<Knob>& of_damper,
                         const Measurement& measurement) {
  Setup fitted = setup;
  for (const FittedValue& value : fit.values)
    if (std::none_of(of_damper.begin(), of_damper.end(),
                     [&](const Knob& knob) { return knob.key == value.key; }))
      set_number(fitted, value.key, value.value, all_effects());
  return audit_momentum(with_setup(measurement, fitted, all_effects()), all_effects());
}

/// `wander`: of the tracks, the same for all rungs.
Rung climb(const SetupOfFile& one, const Measurement& measurement, const Wander& wander,
           const Workshop& workshop, const LadderOptions& ladder) {
  const auto& [file, setup] = one;
  RefitOptions options;
  options.count = ladder.runs;
  // Refitted, so that a rung with few effects does not lose because its parameters were chosen worse.
  std::vector<Knob> knobs = ladder.refit ? believed(free_parameters(setup), measurement.known, all_effects())
                                         : as_given(setup, measurement.known, all_effects());
  const Measurement of_setup = with_setup(measurement, setup, all_effects());
  if (is_empty(setup, of_setup)) {
    const MomentumAudit balance = audit_momentum(of_setup, all_effects());
    if (std::optional<JudgedSwing> judged = judged_swing(setup, of_setup, knobs, balance, all_effects()))
      return {file, effects_of(setup), judged->refit, balance_at(setup, judged->refit, {}, measurement),
              judged->judgement};
  }
  const Measurement beside =
      from_first_turns(with_measured_release(of_setup, all_effects()), *workshop.engine);
  const KnownToErrors known = known_to_errors(setup, beside, wander, workshop);
  for (const std::vector<Knob>& list : {known.of_camera, known.of_damper})
    knobs.insert(knobs.end(), list.begin(), list.end());
  if (!ladder.refit) options.rounds = options.most_rounds = 1;
  Rung rung{file, effects_of(setup), refit(known.measured, knobs, workshop, options), {}, {}};
  rung.momentum = balance_at(setup, rung.fit, known.of_damper, measurement);
  return rung;
}

}  // namespace

std::vector<Rung> climbed(const std::vector<SetupOfFile>& setups, const Measurement& measurement,
                          const Engine& engine, const LadderOptions& options) {
  std::int64_t done = 0;
  const double rounds = options.refit ? 2 : 1;
  const double all = static_cast<double>(options.runs) *
                     static_cast<double>(measurement.runs.size() * setups.size()) * rounds;
  const auto told = [&](int n) {
    done += n;
    if (options.progress) options.progress(std::min(1.0, static_cast<double>(done) / all));
  };
  const Workshop workshop{&engine, all_effects(), options.execution, nullptr, {}, {told, {}}};
  const Wander wander = audit_momentum(measurement, all_effects()).wander_of_tracks();
  std::vector<Rung> rungs;
  for (const SetupOfFile& one : setups) rungs.push_back(climb(one, measurement, wander, workshop, options));
  return rungs;
}

namespace {

/// Returns the p-value of a rung for people; "-" for an empty box, which has none.
std::string p_of(const Rung& rung) {
  return std::isfinite(rung.fit.p_value) ? fmt::format("{:.3f}", rung.fit.p_value) : "-";
}

}  // namespace

std::string climbed_text(const std::vector<Rung>& rungs, bool refitted) {
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

std::string climbed_json(const std::vector<Rung>& rungs, bool refitted) {
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

}  // namespace shakedown
