// SPDX-License-Identifier: MIT
#include "run_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "page_figures.hpp"
#include "replay_tracks.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

constexpr double longest_series = 2500;  // points that a plot of 1000 pixels can show

std::string plus_minus(const Statistic& value, double factor, const char* unit) {
  if (value.n == 0) return "–";
  return value.n > 1
             ? fmt::format("{} ± {} {}", for_people(factor * value.mean), for_people(factor * value.sd), unit)
             : fmt::format("{} {}", for_people(factor * value.mean), unit);
}

std::vector<double> every_nth(const std::vector<double>& values, std::size_t step, double factor) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); i += step) kept.push_back(factor * values[i]);
  return kept;
}

ReportSection peaks_section(const Ensemble& ensemble) {
  ReportSection section;
  section.title = "Peaks";
  section.paragraphs = {"Largest extremum of the box in each half period, the release excluded."};
  ReportPlot plot;
  plot.title = "Decay of the peaks";
  plot.x_label = "time since release, s";
  plot.y_label = "|peak|, mm";
  for (std::size_t r = 0; r < ensemble.runs.size() && r < 12; ++r)
    for (const Peak& peak : ensemble.runs[r].observables.peaks)
      if (std::abs(peak.position) > 1e-3 && r == 0) plot.x.push_back(peak.time);
  ReportCurve first{"first run", CurveRole::model, {}};
  for (const Peak& peak : ensemble.runs.front().observables.peaks)
    if (std::abs(peak.position) > 1e-3) first.y.push_back(std::abs(peak.position) * 1e3);
  plot.curves = {first};
  if (!plot.x.empty()) section.plots = {plot};
  return section;
}

std::vector<std::string> health_of(const Ensemble& ensemble) {
  Health worst;
  for (const RunResult& run : ensemble.runs) worst = worse_of(std::move(worst), run.trajectory.health);
  std::vector<std::string> lines =
      health_in_words(worst, fmt::format("Worst of all runs ({})", ensemble.runs.size()));
  lines.insert(lines.begin() + 1, fmt::format("{} impacts made elastic.", worst.elastic_rescues));
  return lines;
}

}  // namespace

void RunCurves::add(const Trajectory& t) {
  const auto step =
      static_cast<std::size_t>(std::ceil(std::max(1.0, static_cast<double>(t.time.size()) / longest_series)));
  const std::array<const std::vector<double>*, 6> series{&t.x_box,   &t.x_com,   &t.total_energy,
                                                         &t.loss[0], &t.loss[1], &t.loss[2]};
  if (++runs_ == 1) {
    time_ = every_nth(t.time, step, 1);
    first_box_ = every_nth(t.x_box, step, 1e3);
    first_centre_ = every_nth(t.x_com, step, 1e3);
    log_ = t.collision_log;
    for (auto& statistics : statistics_) statistics.resize(time_.size());
  }
  for (std::size_t s = 0; s < series.size(); ++s) {
    const std::vector<double> values = every_nth(*series[s], step, 1e3);
    for (std::size_t i = 0; i < std::min(values.size(), time_.size()); ++i) statistics_[s][i].add(values[i]);
  }
}

namespace {

std::vector<ReportFact> facts_of_run(const Ensemble& ensemble, const Statistic& gone) {
  const auto decay = ensemble.over_runs([](const RunResult& r) { return r.observables.slope; });
  const auto frequency = ensemble.over_runs([](const RunResult& r) { return r.observables.frequency; });
  std::vector<ReportFact> facts{
      {"Fall of the peaks", plus_minus(decay, 1e3, "mm/s"), "straight line, t < 8 s", Tone::plain},
      {"Frequency", plus_minus(frequency, 1, "Hz"), "first ten zero crossings", Tone::plain},
      {"95 % of the energy gone", plus_minus(gone, 1, "s"), "", Tone::plain}};
  const std::array<const char*, contact_classes> classes{"Lost between grains", "Lost at end walls",
                                                         "Lost at side walls"};
  for (std::size_t c = 0; c < contact_classes; ++c)
    facts.push_back(
        {classes[c],
         plus_minus(ensemble.over_runs([c](const RunResult& r) { return r.observables.energy_loss[c]; }), 100,
                    "%"),
         "of the initial energy", Tone::plain});
  return facts;
}

}  // namespace

Report RunCurves::report(const Ensemble& ensemble, const Setup& setup, const std::string& name) const {
  Report report;
  report.kind = "run";
  report.title = name;
  const auto gone =
      ensemble.over_runs([](const RunResult& r) { return r.observables.seconds_to_energy_fraction[3]; });
  report.sentence = gone.n > 0
                        ? fmt::format("{} grains in a {:.4g} mm box take 95 % of the energy in {} s.",
                                      setup.grains.count, setup.box.length * 1e3, for_people(gone.mean))
                        : fmt::format("{} grains in a {:.4g} mm box for {:.4g} s.", setup.grains.count,
                                      setup.box.length * 1e3, setup.run.duration);
  report.subtitle = fmt::format("Engine {}, {} run{}, seed {}.", ensemble.engine, ensemble.runs.size(),
                                ensemble.runs.size() == 1 ? "" : "s", setup.run.seed);
  report.facts = facts_of_run(ensemble, gone);
  const auto means = [&](std::size_t s) {
    std::vector<double> values;
    for (const RunningStatistic& running : statistics_[s]) values.push_back(running.statistic().mean);
    return values;
  };
  const auto position = [&](const char* title, std::size_t s, const std::vector<double>& first) {
    ReportPlot plot = time_plot(title, "position, mm", log_ ? "run" : "", time_);
    if (runs_ > 1) {
      std::vector<double> low, high;
      for (const RunningStatistic& running : statistics_[s]) {
        const Statistic found = running.statistic();
        low.push_back(found.mean - 2 * found.sd);
        high.push_back(found.mean + 2 * found.sd);
      }
      plot.curves = band("two standard deviations of a run", low, high);
      plot.curves.push_back({"mean", CurveRole::other, means(s)});
    }
    plot.curves.push_back({"first run", CurveRole::model, first});
    return plot;
  };
  ReportSection motion;
  motion.title = "Motion";
  motion.plots = {position("Box", 0, first_box_)};
  if (setup.grains.count > 0) motion.plots.push_back(position("Centre of the grains", 1, first_centre_));
  ReportSection energies;
  energies.title = "Where the energy goes";
  energies.plots = {energy_plot(log_ ? "run" : "", time_, means(2), {means(3), means(4), means(5)})};
  report.sections = {motion, peaks_section(ensemble), energies};
  if (log_) {
    const double first_landing = 0.25 / setup.spring.frequency;
    report.replays = {replay_of(
        {"", setup, ensemble.runs.front().run, *log_},
        {"run", "The grains", first_landing, first_landing + 0.5, setup.run.duration, 500'000, 2e-5})};
  }
  say_how_to_reproduce(report, setup);
  report.health = health_of(ensemble);
  return report;
}

}  // namespace shakedown
