// SPDX-License-Identifier: MIT
#include "noise_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "page_figures.hpp"
#include "report_parts.hpp"

namespace shakedown {

namespace {

/// Returns the positions with gaps filled; the ends that were not seen are cut off.
std::vector<double> filled(const std::vector<double>& x) {
  const auto seen = [](double value) { return std::isfinite(value); };
  const auto first = std::find_if(x.begin(), x.end(), seen);
  const auto last = std::find_if(x.rbegin(), x.rend(), seen).base();
  if (first >= last) return {};
  std::vector<double> whole(first, last);
  for (std::size_t i = 1, before = 0; i < whole.size(); ++i) {
    if (!seen(whole[i])) continue;
    for (std::size_t k = before + 1; k < i; ++k)
      whole[k] = whole[before] + (whole[i] - whole[before]) * static_cast<double>(k - before) /
                                     static_cast<double>(i - before);
    before = i;
  }
  return whole;
}

std::vector<double> blackman_harris(std::size_t count) {
  std::vector<double> window(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    window[i] =
        0.35875 - 0.48829 * std::cos(angle) + 0.14128 * std::cos(2 * angle) - 0.01168 * std::cos(3 * angle);
  }
  return window;
}

}  // namespace

TrackSpectrum spectrum_of_track(const std::vector<double>& x, double interval) {
  constexpr std::size_t most = 512, least = 64;
  const std::vector<double> track = filled(x);
  const std::size_t n = std::min(most, track.size() / 2 * 2 / (track.size() < 2 * most ? 2 : 1));
  if (track.size() < least || n < least / 2) return {};
  const std::vector<double> window = blackman_harris(n);
  std::vector<double> cosine(n), sine(n), power(n / 2, 0.0);
  double squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    cosine[i] = std::cos(angle), sine[i] = std::sin(angle), squares += window[i] * window[i];
  }
  int windows = 0;
  std::vector<double> part(n);
  for (std::size_t begin = 0; begin + n <= track.size(); begin += n / 2, ++windows) {
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) mean += track[begin + i] / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) part[i] = window[i] * (track[begin + i] - mean);
    for (std::size_t k = 1; k <= power.size(); ++k) {
      double real = 0, imaginary = 0;
      for (std::size_t i = 0, at = 0; i < n; ++i, at = (at + k) % n)
        real += part[i] * cosine[at], imaginary += part[i] * sine[at];
      power[k - 1] += real * real + imaginary * imaginary;
    }
  }
  TrackSpectrum spectrum;
  for (std::size_t k = 1; k <= power.size(); ++k) {
    spectrum.frequency.push_back(static_cast<double>(k) / (static_cast<double>(n) * interval));
    spectrum.density.push_back(std::sqrt(2 * interval * power[k - 1] / (squares * windows)));
  }
  return spectrum;
}

double density_of(const NoiseFound& noise, double interval, double frequency) {
  const double r = noise.correlation[0], angle = 2 * std::numbers::pi * frequency * interval;
  const double coloured = (1 - r * r) / (1 - 2 * r * std::cos(angle) + r * r);
  return noise.standard_deviation * std::sqrt(2 * interval * coloured);
}

namespace {

std::vector<double> density_in_mm(std::vector<double> values) {
  for (double& value : values) value *= 1e3;
  return values;
}

/// Draws a line that steps where one part of the record ends; nothing where frames are too few for parts.
ReportPlot over_time(const std::string& run, const NoiseFound& box, const NoiseFound& centre) {
  std::vector<double> time;
  for (const NoiseFound* noise : {&box, &centre})
    for (const NoiseAt& part : noise->over_time) time.insert(time.end(), {part.from, part.to - 1e-9});
  std::sort(time.begin(), time.end());
  time.erase(std::unique(time.begin(), time.end()), time.end());
  ReportPlot plot = time_plot("Noise against time", "noise of a frame, mm", run, std::move(time));
  const auto add = [&](const char* name, CurveRole role, const NoiseFound& noise) {
    if (noise.over_time.empty()) return;
    ReportCurve curve{name, role, std::vector<double>(plot.x.size(), std::nan(""))};
    for (std::size_t i = 0; i < plot.x.size(); ++i)
      for (const NoiseAt& part : noise.over_time)
        if (plot.x[i] >= part.from && plot.x[i] < part.to) curve.y[i] = 1e3 * part.deviation;
    plot.curves.push_back(std::move(curve));
  };
  add("box", CurveRole::model, box);
  add("centre of the grains", CurveRole::other, centre);
  return plot;
}

ReportPlot spectrum_plot(const RunAudit& run, const std::vector<double>& x, const NoiseFound& noise,
                         const char* of) {
  const TrackSpectrum spectrum = spectrum_of_track(x, run.frame_interval);
  ReportPlot plot;
  plot.title = fmt::format("Spectrum of the track: {}", of);
  plot.caption =
      "The swing and what impacts make of it stand at the left; where the track comes down to the "
      "noise as it was found, the camera begins.";
  plot.group = run.run;
  plot.x_label = "frequency, Hz", plot.y_label = "density, mm/√Hz";
  plot.logarithmic_y = true;
  plot.x = spectrum.frequency;
  std::vector<double> found;
  for (const double f : spectrum.frequency) found.push_back(density_of(noise, run.frame_interval, f));
  if (plot.x.empty()) return plot;
  plot.curves = {{"track", CurveRole::model, density_in_mm(spectrum.density)},
                 {"noise as found", CurveRole::as_given, density_in_mm(std::move(found))}};
  return plot;
}

std::string source_of(const NoiseFound& noise) {
  switch (noise.source) {
    case NoiseSource::frames: return "from the frames";
    case NoiseSource::bound: return "at most this, from the frames";
    case NoiseSource::declared: return "as declared";
    case NoiseSource::assumed: break;
  }
  return "assumed";
}

std::vector<std::string> row_of_noise(const std::string& run, const char* of, const NoiseFound& noise) {
  const auto mm = [](double metres) {
    return std::isfinite(metres) && metres > 0 ? for_people(1e3 * metres) : std::string("–");
  };
  return {
      run,
      of,
      mm(noise.standard_deviation),
      source_of(noise),
      mm(noise.declared),
      noise.correlation[0] != 0 ? for_people(noise.correlation[0]) : "none",
      noise.wander > 0 ? fmt::format("{} over {} s", mm(noise.wander), for_people(noise.wander_time)) : "–",
      mm(noise.quantum),
      fmt::format("{}", noise.outliers),
      fmt::format("{}", noise.missing)};
}

}  // namespace

ReportSection noise_section(const Measurement& measurement) {
  ReportSection section;
  section.title = "Noise of the camera";
  ReportTable table{
      "",
      "Noise of one frame; memory: correlation with the frame before; wander: slow error at rest.",
      {"run", "of", "noise, mm", "known", "declared, mm", "memory", "wander, mm", "step, mm", "outliers",
       "missing"},
      {},
      false};
  for (const Measurement::Run& run : measurement.runs) {
    const RunAudit& found = run.audit;
    const bool centre = found.com.standard_deviation > 0;
    table.rows.push_back(row_of_noise(found.run, "box", found.box));
    if (centre) table.rows.push_back(row_of_noise(found.run, "grains' centre", found.com));
    for (const ReportPlot& plot : {over_time(found.run, found.box, centre ? found.com : NoiseFound{}),
                                   spectrum_plot(found, found.x_box, found.box, "box"),
                                   spectrum_plot(found, centre ? found.x_com : std::vector<double>{},
                                                 found.com, "centre of the grains")})
      if (!plot.curves.empty()) section.plots.push_back(plot);
  }
  section.tables = {table};
  return section;
}

}  // namespace shakedown
