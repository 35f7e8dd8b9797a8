// SPDX-License-Identifier: MIT
// Sections of a report that show measured runs beside the model.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hard_engine.hpp"
#include "measured_against_model.hpp"
#include "page_figures.hpp"
#include "replay_tracks.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

/// One of the two things that a camera follows, in measured runs and in the model's.
struct ShownMotion {
  const char* name;
  std::vector<double> MeasuredAgainstModel::*measured;
  double MeasuredAgainstModel::*noise;
  EnsembleCurve ModelMotion::*model;
  std::vector<double> MeasuredAgainstModel::*residual;
  std::vector<double> MeasuredAgainstModel::*given_residual;
};
constexpr ShownMotion box{"box",
                          &MeasuredAgainstModel::box,
                          &MeasuredAgainstModel::box_noise,
                          &ModelMotion::box,
                          &MeasuredAgainstModel::box_residual,
                          &MeasuredAgainstModel::given_box_residual};
constexpr ShownMotion centre{"centre of the grains",
                             &MeasuredAgainstModel::centre,
                             &MeasuredAgainstModel::centre_noise,
                             &ModelMotion::centre,
                             &MeasuredAgainstModel::centre_residual,
                             &MeasuredAgainstModel::given_centre_residual};

bool has_given(const MeasuredAgainstModel& run) { return run.as_given.runs > 0; }
const char* final_name(const MeasuredAgainstModel& run) { return has_given(run) ? "final model" : "model"; }

std::vector<double> times(double factor, std::vector<double> values) {
  for (double& value : values) value *= factor;
  return values;
}

std::vector<double> off(const EnsembleCurve& curve, double deviations, double factor) {
  std::vector<double> values = curve.mean;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = factor * (values[i] + deviations * curve.sd[i]);
  return values;
}

bool has_numbers(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

ReportPlot position_plot(const MeasuredAgainstModel& run, const ShownMotion& of, const char* title) {
  const EnsembleCurve& model = run.final_model.*of.model;
  ReportPlot plot = time_plot(title, "position, mm", run.run, run.time);
  plot.curves = band("two standard deviations of a run", off(model, -2, 1e3), off(model, 2, 1e3));
  if (has_given(run))
    plot.curves.push_back({"as given", CurveRole::as_given, times(1e3, (run.as_given.*of.model).mean)});
  plot.curves.push_back({final_name(run), CurveRole::model, times(1e3, model.mean)});
  plot.curves.push_back({"measured", CurveRole::measured, times(1e3, run.*of.measured)});
  return plot;
}

ReportPlot residual_plot(const MeasuredAgainstModel& run) {
  ReportPlot plot = time_plot("Residual", "expected spreads", run.run, run.time);
  plot.caption =
      "Measured less model, in units of what run-to-run spread and camera noise make. Dashed: three units. A "
      "click moves the grains there.";
  plot.level = 3;
  plot.curves = {{"box", CurveRole::model, run.box_residual}};
  if (has_numbers(run.centre_residual))
    plot.curves.push_back({"centre of the grains", CurveRole::other, run.centre_residual});
  return plot;
}

/// Plots measured less model, which the eye cannot see beside a swing of 100 mm.
ReportPlot error_plot(const MeasuredAgainstModel& run, const ShownMotion& of) {
  ReportPlot plot = time_plot(fmt::format("Error of the {}", of.name), "error, mm", run.run, run.time);
  plot.caption = "Measured less mean of the model.";
  const auto less = [&](const EnsembleCurve& model) {
    std::vector<double> error = run.*of.measured;
    for (std::size_t i = 0; i < error.size(); ++i) error[i] = 1e3 * (error[i] - model.mean[i]);
    return error;
  };
  std::vector<double> low(run.time.size()), high(run.time.size());
  for (std::size_t i = 0; i < low.size(); ++i)
    high[i] = 2e3 * std::hypot((run.final_model.*of.model).sd[i], run.*of.noise), low[i] = -high[i];
  plot.curves = band("two expected spreads", low, high);
  if (has_given(run)) plot.curves.push_back({"as given", CurveRole::as_given, less(run.as_given.*of.model)});
  plot.curves.push_back({final_name(run), CurveRole::model, less(run.final_model.*of.model)});
  return plot;
}

double rms(const std::vector<double>& values) {
  double sum = 0, n = 0;
  for (const double v : values)
    if (std::isfinite(v)) sum += v * v, ++n;
  return n > 0 ? std::sqrt(sum / n) : std::nan("");
}

/// Returns where in its swing the box is, rad from its outer turning point, by the model's mean, which has no
/// noise.
double phase_at(const MeasuredAgainstModel& run, std::size_t i) {
  const std::vector<double>& x = run.final_model.box.mean;
  if (i == 0 || i + 1 >= x.size()) return std::nan("");
  const double speed = (x[i + 1] - x[i - 1]) / (run.time[i + 1] - run.time[i - 1]);
  return std::atan2(-speed / (2 * std::numbers::pi * run.amended.spring.frequency), x[i]);
}

/// Returns the largest |x| of the model's mean within half a period to either side, m.
double amplitude_at(const MeasuredAgainstModel& run, std::size_t i) {
  const double reach = 0.5 / run.amended.spring.frequency;
  double top = 0;
  for (std::size_t k = i; k < run.time.size() && run.time[k] - run.time[i] <= reach; ++k)
    top = std::max(top, std::abs(run.final_model.box.mean[k]));
  for (std::size_t k = i; k-- > 0 && run.time[i] - run.time[k] <= reach;)
    top = std::max(top, std::abs(run.final_model.box.mean[k]));
  return top;
}

/// Makes bars of the rms residual of the box in bins of some number of each moment.
template <class Number>
ReportBars residual_by(const std::vector<MeasuredAgainstModel>& runs,
                       const std::vector<std::pair<double, std::string>>& upper, Number&& number) {
  std::vector<std::vector<double>> bins(upper.size());
  for (const MeasuredAgainstModel& run : runs)
    for (std::size_t i = 0; i < run.time.size(); ++i) {
      const double at = number(run, i);
      const auto bin =
          std::find_if(upper.begin(), upper.end(), [&](const auto& edge) { return at < edge.first; });
      if (std::isfinite(at) && bin != upper.end())
        bins[static_cast<std::size_t>(bin - upper.begin())].push_back(run.box_residual[i]);
    }
  ReportBars bars;
  bars.names = {"rms residual of the box"};
  bars.floor = 1;
  bars.floor_name = "expected";
  for (std::size_t k = 0; k < bins.size(); ++k)
    if (has_numbers(bins[k])) bars.lines.push_back({upper[k].second, "", {rms(bins[k])}});
  return bars;
}

ReportStrip strip_of(const std::vector<MeasuredAgainstModel>& runs,
                     std::vector<double> MeasuredAgainstModel::*residual, const char* of,
                     const std::string& title) {
  constexpr double width = 0.5;
  ReportStrip strip;
  strip.title = title;
  strip.caption = fmt::format("rms residual of the {} in half a second. A click shows that moment.", of);
  strip.x_label = "time since release, s";
  strip.value_name = "expected spreads";
  double end = 0;
  for (const MeasuredAgainstModel& run : runs) end = std::max(end, run.time.back());
  for (double t = 0; t < end + width / 2; t += width) strip.edges.push_back(t);
  for (const MeasuredAgainstModel& run : runs) {
    ReportStrip::Row row{run.run, run.run, {}};
    for (std::size_t k = 0; k + 1 < strip.edges.size(); ++k) {
      std::vector<double> inside;
      for (std::size_t i = 0; i < run.time.size(); ++i)
        if (run.time[i] >= strip.edges[k] && run.time[i] < strip.edges[k + 1])
          inside.push_back((run.*residual)[i]);
      row.values.push_back(rms(inside));
    }
    strip.rows.push_back(row);
  }
  return strip;
}

}  // namespace

ReportSection curves_section(const std::vector<MeasuredAgainstModel>& runs, const std::string& title) {
  ReportSection section;
  section.title = title;
  for (const MeasuredAgainstModel& run : runs) {
    section.plots.push_back(position_plot(run, box, "Box"));
    section.plots.push_back(error_plot(run, box));
    section.plots.push_back(residual_plot(run));
    if (!has_numbers(run.centre)) continue;
    section.plots.push_back(position_plot(run, centre, "Centre of the grains"));
    section.plots.push_back(error_plot(run, centre));
  }
  return section;
}

ReportSection failure_section(const std::vector<MeasuredAgainstModel>& runs) {
  ReportSection section;
  section.title = "Where it fails";
  const bool given = !runs.empty() && has_given(runs.front());
  for (const ShownMotion* of : {&box, &centre}) {
    if (std::none_of(runs.begin(), runs.end(),
                     [&](const MeasuredAgainstModel& run) { return has_numbers(run.*of->measured); }))
      continue;
    const std::string title = fmt::format("The {} by time and run", of->name);
    if (given) section.strips.push_back(strip_of(runs, of->given_residual, of->name, title + ": as given"));
    section.strips.push_back(strip_of(runs, of->residual, of->name, title + (given ? ": final model" : "")));
  }
  constexpr double eighth = std::numbers::pi / 4;
  ReportBars phase = residual_by(runs,
                                 {{-3 * eighth, "inner end, turning back"},
                                  {-eighth, "moving out through zero"},
                                  {0, "coming to the outer end"},
                                  {eighth, "leaving the outer end"},
                                  {3 * eighth, "moving in through zero"},
                                  {4 * eighth + 1e-9, "coming to the inner end"}},
                                 phase_at);
  phase.title = "By phase of the swing";
  std::vector<double> largest;
  for (const MeasuredAgainstModel& run : runs) {
    double most = std::numeric_limits<double>::min();
    for (const double x : run.final_model.box.mean) most = std::max(most, std::abs(x));
    largest.push_back(most);
  }
  const auto share_at = [&](const MeasuredAgainstModel& run, std::size_t i) {
    return amplitude_at(run, i) / largest[static_cast<std::size_t>(&run - runs.data())];
  };
  ReportBars amplitude = residual_by(runs,
                                     {{0.1, "below 10 %"},
                                      {0.3, "10 to 30 %"},
                                      {0.6, "30 to 60 %"},
                                      {0.8, "60 to 80 %"},
                                      {1e9, "above 80 %"}},
                                     share_at);
  amplitude.title = "By amplitude of the swing, of the run's largest";
  section.bars = {phase, amplitude};
  return section;
}

ReportSection energy_section(const std::vector<MeasuredAgainstModel>& runs) {
  ReportSection section;
  section.title = "Where the energy goes";
  section.paragraphs = {
      "Means of the final model's runs; what is lost in contacts of each class, and what is left in spring, "
      "box and grains."};
  for (const MeasuredAgainstModel& run : runs) {
    std::array<std::vector<double>, contact_classes> lost;
    for (std::size_t c = 0; c < contact_classes; ++c) lost[c] = times(1e3, run.final_model.loss[c].mean);
    section.plots.push_back(energy_plot(run.run, run.time, times(1e3, run.final_model.energy.mean), lost));
  }
  return section;
}

std::vector<std::string> health_lines(const std::vector<MeasuredAgainstModel>& runs) {
  Health worst;
  std::int64_t collisions = 0;
  int simulations = 0;
  for (const MeasuredAgainstModel& run : runs)
    for (const ModelMotion* motion : {&run.as_given, &run.final_model}) {
      worst = worse_of(std::move(worst), motion->health);
      collisions += motion->collisions;
      simulations += motion->runs;
    }
  std::vector<std::string> lines = health_in_words(
      worst, fmt::format("Worst of the {} simulations drawn here ({} collisions)", simulations, collisions));
  if (collisions > 0)
    lines.insert(
        lines.begin() + 1,
        fmt::format("{:.1f} % of the impacts were slow enough to be made elastic (what keeps layers "
                    "from endless impacts).",
                    100.0 * static_cast<double>(worst.elastic_rescues) / static_cast<double>(collisions)));
  return lines;
}

std::vector<ReportReplay> replays_of(const std::vector<MeasuredAgainstModel>& runs, std::size_t most,
                                     std::size_t bytes) {
  std::vector<ReportReplay> replays;
  const std::size_t count = std::min(most, runs.size());
  for (std::size_t r = 0; r < count; ++r) {
    const MeasuredAgainstModel& run = runs[r];
    if (run.amended.grains.count == 0) continue;
    Setup setup = run.amended;
    setup.run.duration = run.time.back();
    RunOptions options;
    options.log_collisions = true;
    const Trajectory trajectory = make_hard_engine()->run(setup, options);
    if (!trajectory.collision_log) continue;
    std::size_t worst = 0;
    for (std::size_t i = 0; i < run.time.size(); ++i)
      if (std::isfinite(run.box_residual[i]) &&
          (!std::isfinite(run.box_residual[worst]) ||
           std::abs(run.box_residual[i]) > std::abs(run.box_residual[worst])))
        worst = i;
    ReportReplay replay = replay_of({"", setup, 0, *trajectory.collision_log},
                                    {run.run, "The grains", run.time[worst] - 0.25, run.time[worst] + 0.25,
                                     run.time.back(), bytes / count, 2e-5});
    replay.caption = "Black box (white on dark): measured. " + replay.caption;
    for (std::size_t i = 0; i < run.time.size(); ++i)
      if (std::isfinite(run.box[i]))
        replay.measured_time.push_back(run.time[i]), replay.measured_x_box.push_back(run.box[i]);
    replays.push_back(std::move(replay));
  }
  return replays;
}

}  // namespace shakedown
