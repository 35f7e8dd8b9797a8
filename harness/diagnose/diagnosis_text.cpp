// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "diagnosis.hpp"
#include "text.hpp"
#include "validation.hpp"

namespace shakedown {

std::string line_of(const FailureCell& cell) {
  const std::string when = cell.to > cell.from ? fmt::format(" {:.0f} to {:.1f} s", cell.from, cell.to) : "";
  return fmt::format("    {:<12} {:<13} {:<42} {:>7.3f} mm rms, {:>5.1f} sigma, p = {:.3f}\n",
                     cell.run.empty() ? "all runs" : cell.run, cell.observable, cell.what + when,
                     cell.error * 1e3, cell.sigmas, cell.p_value);
}

namespace {

std::string hypotheses_text(const Diagnosis& d) {
  std::string text;
  constexpr double shown = 0.01;
  for (const Hypothesis& h : d.hypotheses) {
    if (h.probability < shown) continue;
    std::string names;
    for (const std::string& effect : h.effects)
      names += (names.empty() ? "" : " + ") + (effect == unlisted_effect ? "something in no list" : effect);
    text +=
        fmt::format("  {:>5.1f} %  {}\n", 100 * h.probability, names.empty() ? "nothing is missing" : names);
  }
  return text.empty() ? "" : "  probability of what is missing\n" + text + "\n";
}

/// Returns a length in mm; "-" where nothing was measured.
std::string in_mm(double metres) { return std::isfinite(metres) ? fmt::format("{:.3f}", metres * 1e3) : "-"; }

std::string suspects_text(const std::vector<RankedEffect>& ranking) {
  constexpr std::size_t most_told = 12;
  std::string text = ranking.empty()
                         ? ""
                         : "\n  suspects                                 gain  held-out gain   look-alikes\n";
  for (std::size_t i = 0; i < ranking.size() && i < most_told; ++i) {
    const RankedEffect& r = ranking[i];
    std::string alike;
    for (const std::string& name : r.look_alikes) alike += (alike.empty() ? "" : ", ") + name;
    text += fmt::format("    {:<34} {:>10.1f} {:>14} {}\n", r.effect, r.gain,
                        std::isfinite(r.held_out_gain) ? fmt::format("{:.1f}", r.held_out_gain)
                        : r.by_balance                 ? "(balance)"
                        : r.fitted                     ? "-"
                                                       : "(signature)",
                        alike);
  }
  return text;
}

/// Returns the effect that has the curve, a line for each of the setup's.
std::string restitution_to_try(const Setup& setup) {
  std::string text = fmt::format(
      "\n  to try, with restitution.grain_grain = {:.4g} and restitution.grain_wall = {:.4g} (--out writes "
      "the "
      "setup):\n",
      setup.restitution.grain_grain, setup.restitution.grain_wall);
  std::stringstream lines(curve_as_toml(restitution_against_speed(), setup));
  for (std::string line; std::getline(lines, line);) text += "    " + line + "\n";
  return text;
}

}  // namespace

std::string diagnosis_text(const Diagnosis& d) {
  std::string text = d.sentence + "\n\n" + hypotheses_text(d);
  text +=
      fmt::format("  {:<58} {:>10} {:>10} {:>12} {:>8}\n", "error, mm", "box", "centre", "box held out", "p");
  for (const LadderStep& s : d.ladder)
    text += fmt::format("  {:<58} {:>10} {:>10} {:>12} {:>8}\n", s.step, in_mm(s.error_box),
                        s.floor_centre > 0 ? in_mm(s.error_centre) : "-", in_mm(s.held_out_error_box),
                        std::isfinite(s.p_value) ? fmt::format("{:.3f}", s.p_value) : "-");
  if (!d.ladder.empty())
    text += fmt::format("  {:<58} {:>10} {:>10}\n", "noise and run-to-run spread",
                        in_mm(d.ladder.back().floor_box),
                        d.ladder.back().floor_centre > 0 ? in_mm(d.ladder.back().floor_centre) : "-");
  text += "  final model " + d.judgement.reason + "\n\n" + validation_text(d.validation);
  if (!d.forced.empty()) text += "\n  forced: measured (final model +- spread from run to run)\n";
  for (const DecayComparison& run : d.forced)
    text += fmt::format("    {:<12} {}\n", run.run, told(*run.forced));
  if (!d.parameters.empty()) {
    text += "\n  values (95 % interval)\n";
    for (const DiagnosedParameter& p : d.parameters)
      text += p.word.empty() ? fmt::format("    {:<44} {:.6g} ({:.6g} to {:.6g}) {}\n", p.name, p.value,
                                           p.low, p.high, p.unit)
                             : fmt::format("    {:<44} {}\n", p.name, p.word);
  }
  if (!d.camera.empty()) text += "\n" + nuisances_text(d.camera);
  if (d.momentum.possible && d.momentum.wander.deviation > 0)
    text += fmt::format("  the track wanders by {:.2g} mm over {:.2g} s\n", d.momentum.wander.deviation * 1e3,
                        d.momentum.wander.time);
  if (d.momentum.possible)
    text += fmt::format(
        "\n  momentum balance: chi2 per degree of freedom {:.3g} as given, {:.3g} with what was found\n",
        d.momentum.as_given.chi2_per_degree(), d.momentum.final_fit.chi2_per_degree());
  else
    text += "\n  momentum balance: not possible (" + d.momentum.why_not + ")\n";
  text += suspects_text(d.ranking);
  if (!d.where.empty()) {
    text += "\n  where it fails\n";
    for (const FailureCell& c : d.where) text += line_of(c);
  }
  if (!d.force_formula.empty()) text += "\n  force to try: " + d.force_formula + "\n";
  if (d.free_restitution) text += restitution_to_try(d.free_restitution->setup);
  for (const std::string& next : d.next_experiments) text += "  next: " + next + "\n";
  for (const std::string& note : d.notes) text += "  note: " + note + "\n";
  if (!d.not_tried.empty())
    text +=
        "  not tried, for want of time or simulations (--seconds, --budget): " + joined(d.not_tried, ", ") +
        "\n";
  return text + fmt::format("\n  {} simulations in {:.0f} s\n", d.runs_simulated, d.seconds);
}

}  // namespace shakedown
