// SPDX-License-Identifier: MIT
#include "sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "page_figures.hpp"
#include "provenance.hpp"
#include "report_parts.hpp"
#include "run_numbers.hpp"

namespace shakedown {

namespace {

/// Numbers of a run that are drawn together.
struct Drawn {
  const char* title;
  const char* y_label;
  std::vector<std::pair<const char*, const char*>> numbers;  ///< column of the file, name of the curve
};

const std::vector<Drawn>& drawn() {
  static const std::vector<Drawn> all{
      {"Steady amplitude under forcing", "amplitude, mm", {{"steady_amplitude_mm", "amplitude"}}},
      {"Loss factor under forcing",
       "loss factor",
       {{"loss_factor", "energy lost per cycle over 2 pi times stored"}}},
      {"Effective mass of the grains under forcing",
       "mass, g",
       {{"effective_mass_g", "of their force, the part in phase with the box, over its acceleration"}}},
      {"Time to lose the energy",
       "time, s",
       {{"seconds_to_lose_95_percent", "95 %"},
        {"seconds_to_lose_90_percent", "90 %"},
        {"seconds_to_lose_75_percent", "75 %"},
        {"seconds_to_lose_50_percent", "50 %"}}},
      {"Fall of the peaks", "slope, mm/s", {{"slope_mm_per_s", "straight line, t < 8 s"}}},
      {"Frequency", "frequency, Hz", {{"frequency_hz", "first ten zero crossings"}}},
      {"First small peak", "time, s", {{"first_small_peak_s", "first peak below 9.3 % of the release"}}},
      {"Where the energy goes",
       "fraction of the initial energy",
       {{"energy_left", "left"},
        {"loss_grain_grain", "between grains"},
        {"loss_end_wall", "at end walls"},
        {"loss_side_wall", "at side walls"}}},
  };
  return all;
}

std::size_t column_of(std::string_view name) {
  const auto numbers = run_numbers();
  return static_cast<std::size_t>(
      std::find_if(numbers.begin(), numbers.end(), [&](const RunNumber& n) { return n.name == name; }) -
      numbers.begin());
}

double at(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : std::nan("");
}

std::string axis_label(const SweepAxis& axis) {
  return axis.key + (axis.unit.empty() ? "" : ", " + axis.unit);
}

/// Draws the sweep along its longer axis; the other's values are curves.
class Sheet {
 public:
  Sheet(const SweepIdentity& identity, const std::vector<PointSummary>& points)
      : identity_(identity), points_(points) {
    std::vector<std::set<double>> values(identity.axes.size());
    for (const PointSummary& point : points)
      for (std::size_t a = 0; a < values.size(); ++a) values[a].insert(point.varied[a]);
    if (values.size() == 2 && values[1].size() > values[0].size()) along_ = 1;
    x_.assign(values[along_].begin(), values[along_].end());
    if (values.size() == 2) across_.assign(values[1 - along_].begin(), values[1 - along_].end());
  }

  /// Returns the plots of these numbers; nothing when no point has such a number.
  std::vector<ReportPlot> plots(const Drawn& drawn) const {
    std::vector<ReportPlot> found;
    if (across_.empty()) return one_axis(drawn);
    for (const auto& [number, name] : drawn.numbers) {
      ReportPlot plot = empty(drawn.numbers.size() > 1 ? std::string(drawn.title) + ": " + name : drawn.title,
                              drawn.y_label);
      for (const double across : some_across()) {
        const SweepAxis& axis = identity_.axes[1 - along_];
        plot.curves.push_back(
            {fmt::format("{} = {:g}{}", axis.key, across, axis.unit.empty() ? "" : " " + axis.unit),
             CurveRole::other, means(number, across)});
      }
      if (has_numbers(plot)) found.push_back(std::move(plot));
    }
    return found;
  }

  /// Returns the whole plane as strips, for two axes with four values each or more.
  std::vector<ReportStrip> strips(const Drawn& drawn) const {
    if (across_.size() < 4 || x_.size() < 4) return {};
    const SweepAxis &x = identity_.axes[along_], &y = identity_.axes[1 - along_];
    ReportStrip strip{drawn.title,
                      "Each row: " + axis_label(y) + ". Each column: " + axis_label(x) +
                          ". White: the least, full: the most.",
                      axis_label(x),
                      drawn.y_label,
                      {},
                      {},
                      1};
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double across : across_) {
      strip.rows.push_back({fmt::format("{:g}", across), "", means(drawn.numbers.front().first, across)});
      for (const double v : strip.rows.back().values)
        if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
    if (!(high > low)) return {};
    for (ReportStrip::Row& row : strip.rows)
      for (double& v : row.values) v -= low;
    strip.top = high - low;
    strip.value_name = fmt::format("above {:.4g} ({})", low, drawn.y_label);
    for (std::size_t i = 0; i <= x_.size(); ++i)
      strip.edges.push_back(i == 0 ? x_.front() : i == x_.size() ? x_.back() : (x_[i - 1] + x_[i]) / 2);
    return {strip};
  }

 private:
  ReportPlot empty(std::string title, std::string y_label) const {
    ReportPlot plot;
    plot.title = std::move(title);
    plot.x_label = axis_label(identity_.axes[along_]);
    plot.y_label = std::move(y_label);
    plot.x = x_;
    return plot;
  }

  std::vector<ReportPlot> one_axis(const Drawn& drawn) const {
    ReportPlot plot = empty(drawn.title, drawn.y_label);
    const std::vector<double> mean = means(drawn.numbers.front().first, 0);
    if (drawn.numbers.size() == 1) {
      std::vector<double> low, high;
      const std::vector<double> sd = spreads(drawn.numbers.front().first);
      for (std::size_t i = 0; i < mean.size(); ++i)
        low.push_back(mean[i] - 2 * sd[i]), high.push_back(mean[i] + 2 * sd[i]);
      if (std::any_of(sd.begin(), sd.end(), [](double v) { return std::isfinite(v); }))
        plot.curves = band("two standard deviations of a run", low, high);
    }
    for (std::size_t k = 0; k < drawn.numbers.size(); ++k)
      plot.curves.push_back({drawn.numbers[k].second, k == 0 ? CurveRole::model : CurveRole::other,
                             means(drawn.numbers[k].first, 0)});
    if (!has_numbers(plot)) return {};
    return {plot};
  }

  /// Returns at most four of the values across: more curves cannot be told apart by colour.
  std::vector<double> some_across() const {
    constexpr std::size_t most = 4;
    if (across_.size() <= most) return across_;
    std::vector<double> some;
    for (std::size_t k = 0; k < most; ++k) some.push_back(across_[k * (across_.size() - 1) / (most - 1)]);
    return some;
  }

  std::vector<double> numbers(const char* number, double across,
                              std::vector<double> PointSummary::*what) const {
    std::vector<double> values(x_.size(), std::nan(""));
    for (const PointSummary& point : points_) {
      if (!across_.empty() && point.varied[1 - along_] != across) continue;
      const auto place = std::lower_bound(x_.begin(), x_.end(), point.varied[along_]);
      values[static_cast<std::size_t>(place - x_.begin())] = at(point.*what, column_of(number));
    }
    return values;
  }
  std::vector<double> means(const char* number, double across) const {
    return numbers(number, across, &PointSummary::mean);
  }
  std::vector<double> spreads(const char* number) const { return numbers(number, 0, &PointSummary::sd); }

  static bool has_numbers(const ReportPlot& plot) {
    return std::any_of(plot.curves.begin(), plot.curves.end(), [](const ReportCurve& curve) {
      return curve.role != CurveRole::band_low && curve.role != CurveRole::band_high &&
             std::any_of(curve.y.begin(), curve.y.end(), [](double v) { return std::isfinite(v); });
    });
  }

  const SweepIdentity& identity_;
  const std::vector<PointSummary>& points_;
  std::size_t along_ = 0;
  std::vector<double> x_, across_;
};

ReportTable all_numbers(const SweepIdentity& identity, const std::vector<PointSummary>& points) {
  ReportTable table{"Every point as numbers", "Means over the runs of each point.", {}, {}, true};
  for (const SweepAxis& axis : identity.axes) table.columns.push_back(axis_label(axis));
  table.columns.insert(table.columns.end(), {"runs", "failures"});
  std::vector<std::size_t> shown;
  for (std::size_t n = 0; n < run_numbers().size(); ++n)
    if (std::any_of(points.begin(), points.end(),
                    [&](const PointSummary& p) { return std::isfinite(at(p.mean, n)); })) {
      shown.push_back(n);
      table.columns.push_back(std::string(run_numbers()[n].name));
    }
  for (const PointSummary& point : points) {
    std::vector<std::string> row;
    for (const double value : point.varied) row.push_back(fmt::format("{:g}", value));
    row.insert(row.end(), {fmt::format("{}", point.runs), fmt::format("{}", point.failures)});
    for (const std::size_t n : shown) row.push_back(for_people(at(point.mean, n)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string place(const SweepIdentity& identity, const PointSummary& point) {
  std::string text;
  for (std::size_t a = 0; a < identity.axes.size(); ++a)
    text += fmt::format("{}{} = {:g}{}", text.empty() ? "" : ", ", identity.axes[a].key, point.varied[a],
                        identity.axes[a].unit.empty() ? "" : " " + identity.axes[a].unit);
  return text;
}

}  // namespace

std::string finding_of(const SweepIdentity& identity, const std::vector<PointSummary>& points) {
  const auto best = [&](const char* number, double sign) {
    const std::size_t column = column_of(number);
    const PointSummary* found = nullptr;
    for (const PointSummary& point : points) {
      const double value = sign * at(point.mean, column);
      if (std::isfinite(value) && (found == nullptr || value < sign * found->mean[column])) found = &point;
    }
    return std::pair(found, found == nullptr ? std::nan("") : found->mean[column]);
  };
  if (const auto [point, mm] = best("steady_amplitude_mm", -1); point != nullptr)
    return fmt::format("Forced, the box swings most at {}: {} mm.", place(identity, *point), for_people(mm));
  if (const auto [point, seconds] = best("seconds_to_lose_95_percent", 1); point != nullptr)
    return fmt::format("95 % of the energy is gone soonest at {}: after {} s.", place(identity, *point),
                       for_people(seconds));
  if (const auto [point, left] = best("energy_left", 1); point != nullptr)
    return fmt::format("No point loses 95 % of its energy within the run; least is left at {}: {} %.",
                       place(identity, *point), for_people(100 * left));
  return fmt::format("{} points swept.", points.size());
}

Report report_of(const ResultFile& file, const std::string& name) {
  const std::vector<ResultRow> rows = file.rows();
  const std::vector<PointSummary> points = summaries_of(rows);
  const SweepIdentity& identity = file.identity();
  const auto failed =
      std::count_if(rows.begin(), rows.end(), [](const ResultRow& row) { return !row.failure.empty(); });
  Report report;
  report.kind = "sweep";
  report.title = name;
  report.sentence = finding_of(identity, points);
  report.subtitle = fmt::format("Engine {}; {} point{}, {} runs.", identity.engine, points.size(),
                                points.size() == 1 ? "" : "s", rows.size());
  report.facts = {{"Points", fmt::format("{}", points.size()), "", Tone::plain},
                  {"Runs", fmt::format("{}", rows.size()),
                   failed > 0 ? fmt::format("{} of them failed", failed) : "none failed",
                   failed > 0 ? Tone::bad : Tone::good},
                  {"Digest of all results", results_digest(rows),
                   "the same for any threads, shards and order", Tone::plain}};
  if (!points.empty()) {
    const Sheet sheet(identity, points);
    ReportSection section;
    section.title = "What changes";
    for (const Drawn& one : drawn()) {
      for (ReportPlot& plot : sheet.plots(one)) section.plots.push_back(std::move(plot));
      for (ReportStrip& strip : sheet.strips(one)) section.strips.push_back(std::move(strip));
    }
    section.tables = {all_numbers(identity, points)};
    report.sections = {section};
  }
  report.command = this_command();
  report.setup = identity.base_setup;
  report.program = version_line();
  return report;
}

}  // namespace shakedown
