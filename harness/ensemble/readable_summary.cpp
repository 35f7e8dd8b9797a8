// SPDX-License-Identifier: MIT
#include "readable_summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <set>

#include "steady_pull.hpp"

namespace shakedown {

namespace {

/// Returns "8.20", of an ensemble "8.20 +- 0.05"; "-" where there is no such number.
std::string with_spread(const Statistic& statistic, int decimals) {
  if (statistic.n == 0) return "-";
  if (statistic.n == 1 || std::isnan(statistic.sd)) return fmt::format("{:.{}f}", statistic.mean, decimals);
  return fmt::format("{:.{}f} +- {:.{}f}", statistic.mean, decimals, statistic.sd, decimals);
}

std::string line(std::string_view name, const std::string& value, std::string_view unit = "") {
  return fmt::format("  {:<34}{}{}{}\n", name, value, unit.empty() || value == "-" ? "" : " ",
                     value == "-" ? "" : unit);
}

std::string peaks_line(const Ensemble& ensemble) {
  std::string text;
  for (std::size_t n = 0; n < 8; ++n) {
    const Statistic peak = ensemble.over_runs([&](const RunResult& run) {
      return n < run.observables.peaks.size() ? 1e3 * std::abs(run.observables.peaks[n].position) : absent;
    });
    if (peak.n > 0) text += fmt::format("{}{:.1f}", n == 0 ? "" : "  ", peak.mean);
  }
  return text.empty() ? "-" : text;
}

std::string motion_lines(const Ensemble& ensemble, const Setup& setup) {
  const auto seen = [&](double scale, int decimals, auto member) {
    return with_spread(
        ensemble.over_runs([&](const RunResult& run) { return scale * run.observables.*member; }), decimals);
  };
  const auto rms = [&](auto which) {
    return with_spread(
        ensemble.over_runs([&](const RunResult& run) { return 1e3 * which(run.observables.decay); }), 2);
  };
  return line("first |peaks|", peaks_line(ensemble), "mm") +
         line("slope of |peaks|", seen(1e3, 2, &Observables::slope), "mm/s") +
         line("frequency", seen(1, 4, &Observables::frequency), "Hz") +
         line(fmt::format("first peak below {:.3g} mm", 1e3 * small_peak(setup)),
              seen(1, 2, &Observables::first_small_peak), "s") +
         line("decay: rms about a straight line", rms([](const Decay& decay) { return decay.linear.rms; }),
              "mm") +
         line("       rms about an exponential",
              rms([](const Decay& decay) { return decay.exponential.rms; }), "mm");
}

/// Returns the lines about the state under steady forcing.
std::string forced_lines(const Ensemble& ensemble) {
  const auto seen = [&](double scale, int decimals, double SteadyState::*member) {
    return with_spread(ensemble.over_runs([&](const RunResult& run) {
      return run.observables.steady ? scale * (*run.observables.steady).*member : absent;
    }),
                       decimals);
  };
  if (ensemble.over_runs([](const RunResult& run) { return run.observables.steady ? 1.0 : absent; }).n == 0)
    return "";
  return line("forced: amplitude", seen(1e3, 2, &SteadyState::amplitude), "mm") +
         line("        from cycle to cycle", seen(100, 1, &SteadyState::variation), "%") +
         line("        lag behind it", seen(1, 3, &SteadyState::phase_lag), "rad") +
         line("        loss factor", seen(1, 4, &SteadyState::loss_factor)) +
         line("        effective mass of grains", seen(1e3, 1, &SteadyState::effective_mass), "g");
}

std::string energy_lines(const Ensemble& ensemble, const Setup& setup) {
  std::string text;
  for (const std::size_t i : {0u, 3u})
    text += line(fmt::format("{:g} % of the energy gone after", 100 * (1 - energy_fractions[i])),
                 with_spread(ensemble.over_runs([&](const RunResult& run) {
                   return run.observables.seconds_to_energy_fraction[i];
                 }),
                             2),
                 "s");
  constexpr std::array<std::string_view, contact_classes> names{
      "lost between grains", "lost at the end walls", "lost at the side walls"};
  for (std::size_t i = 0; i < contact_classes; ++i)
    text += line(names[i],
                 with_spread(ensemble.over_runs(
                                 [&](const RunResult& run) { return 100 * run.observables.energy_loss[i]; }),
                             1),
                 "% of E0");
  for (std::size_t i = 0; i < setup.effects.size(); ++i)
    text +=
        line(fmt::format("taken by {}", setup.effects[i].record->name),
             with_spread(ensemble.over_runs([&](const RunResult& run) {
               return i < run.observables.effect_loss.size() ? 100 * run.observables.effect_loss[i] : absent;
             }),
                         1),
             "% of E0");
  return text;
}

double collisions_of(const RunResult& run) {
  double total = 0;
  for (const std::int64_t count : run.trajectory.collisions) total += static_cast<double>(count);
  return total < 0 ? std::numeric_limits<double>::quiet_NaN() : total;
}

/// Returns the line of a promise, "not told" where a program of other people does not tell it.
std::string worst_line(const char* label, double worst, const char* unit) {
  return std::isnan(worst) ? line(label, "- (not told)") : line(label, fmt::format("{:.1e}", worst), unit);
}

std::string health_lines(const Ensemble& ensemble) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double ledger = none, momentum = none, overlap = none, rescues = 0;
  std::set<std::string> notes;
  for (const RunResult& run : ensemble.runs) {
    const Health& health = run.trajectory.health;
    ledger = std::fmax(ledger, health.ledger_error);
    momentum = std::fmax(momentum, health.momentum_error);
    overlap = std::fmax(overlap, health.deepest_overlap);
    rescues = std::max(rescues, static_cast<double>(health.elastic_rescues));
    notes.insert(health.notes.begin(), health.notes.end());
  }
  std::string text = line("collisions", with_spread(ensemble.over_runs(collisions_of), 0)) +
                     worst_line("energy ledger open by", ledger, "of E0") +
                     worst_line("momentum off by", momentum, "of M Omega Delta0") +
                     worst_line("deepest overlap", overlap, "m") +
                     line("impacts made elastic", fmt::format("{:.0f}", rescues));
  // Notes may hold numbers of their run: a long ensemble would bury the rest under them.
  constexpr std::size_t shown = 3;
  std::size_t count = 0;
  for (const std::string& note : notes)
    if (count++ < shown) text += line("note", note);
  if (notes.size() > shown)
    text += line("note", fmt::format("... and {} more in summary.json", notes.size() - shown));
  return text;
}

}  // namespace

std::string readable_summary(const Ensemble& ensemble, const Setup& setup) {
  const std::size_t finished = ensemble.runs.size();
  std::string text = fmt::format("engine {}: {} grain{}, box {:g} mm, {:g} s, seed {}", ensemble.engine,
                                 setup.grains.count, setup.grains.count == 1 ? "" : "s",
                                 1e3 * setup.box.length, setup.run.duration, setup.run.seed);
  if (ensemble.requested > 1) text += fmt::format(", {} runs (mean +- sd of one run)", finished);
  text += "\n";
  if (ensemble.interrupted && ensemble.requested == 1 && finished == 1)
    text += fmt::format("  interrupted at {:.3f} s\n", ensemble.runs[0].trajectory.end_time);
  else if (ensemble.interrupted)
    text += fmt::format("  interrupted: {} of {} runs finished\n", finished, ensemble.requested);
  if (finished == 0) return text;
  if (const std::string pull = words_of_pull(steady_pull(setup)); !pull.empty())
    text += line("shaking over the steady pull", pull);
  if (setup.domain == Domain::damper) text += motion_lines(ensemble, setup) + forced_lines(ensemble);
  text += energy_lines(ensemble, setup) + health_lines(ensemble);
  double collisions = 0, seconds = 0;
  for (const RunResult& run : ensemble.runs) {
    collisions += collisions_of(run);
    seconds += run.trajectory.wall_seconds;
  }
  std::string taken = fmt::format("{:.2f} s", ensemble.wall_seconds);
  if (!std::isnan(collisions))
    taken += fmt::format(", {:.3g} collisions per second of engine time",
                         seconds > 0 ? collisions / seconds : 0.0);
  return text + line("time taken", taken);
}

}  // namespace shakedown
