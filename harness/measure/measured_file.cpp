// SPDX-License-Identifier: MIT
#include "measured_file.hpp"

#include <cmath>
#include <cstdio>
#include <sstream>

#include "output_file.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

std::string micrometres(double metres) {
  if (!std::isfinite(metres)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.6f", metres);
  return text;
}

void write_column(std::ostream& output, const char* name, const char* from, const char* unit,
                  double uncertainty) {
  output << "\n[column." << name << "]\nfrom = \"" << from << "\"\nunit = \"" << unit << "\"\n";
  if (std::isfinite(uncertainty))
    output << "uncertainty = " << toml_string(write_quantity(uncertainty, "mm")) << "\n";
}

}  // namespace

void write_measured_run(const std::filesystem::path& file, const MeasuredRun& run) {
  std::ostringstream output;
  output << (run.has_com() ? "t_s,x_box_m,x_com_m\n" : "t_s,x_box_m\n");
  char time[32];
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    // 240 frames a second need more digits than 500.
    const bool in_tenths = std::abs(run.time[i] - std::round(run.time[i] * 1e4) * 1e-4) < 1e-9;
    std::snprintf(time, sizeof time, in_tenths ? "%.4f" : "%.6f", run.time[i]);
    output << time << "," << micrometres(run.x_box[i]);
    if (run.has_com()) output << "," << micrometres(run.x_com[i]);
    output << "\n";
  }
  write_file(file, output.str());
}

void write_experiment(const std::filesystem::path& file, const Experiment& experiment) {
  std::ostringstream output;
  output << "title = " << toml_string(experiment.title) << "\n";
  double box_uncertainty = NAN, com_uncertainty = NAN;
  bool com = false;
  for (const MeasuredRun& run : experiment.runs) {
    box_uncertainty = run.box_uncertainty;
    if (run.has_com()) com = true, com_uncertainty = run.com_uncertainty;
  }
  if (!experiment.runs.empty())
    output << "\n[camera]\nframe_rate = "
           << toml_string(write_quantity(experiment.runs.front().frame_rate, "Hz")) << "\n";
  write_column(output, "time", "t_s", "s", NAN);
  write_column(output, "box_position", "x_box_m", "m", box_uncertainty);
  if (com) write_column(output, "grain_centre", "x_com_m", "m", com_uncertainty);
  if (!experiment.known.empty()) output << "\n[known]\n";
  for (const KnownValue& known : experiment.known) output << known_line(known) << "\n";
  for (const MeasuredRun& run : experiment.runs) {
    output << "\n[[run]]\nfile = " << toml_string(run.name + ".csv") << "\n";
    if (std::isfinite(run.box_length))
      output << "box_length = " << toml_string(write_quantity(run.box_length, "mm")) << "\n";
    if (run.frame_rate != experiment.runs.front().frame_rate)
      output << "frame_rate = " << toml_string(write_quantity(run.frame_rate, "Hz")) << "\n";
    if (com && !run.has_com()) output << "column.grain_centre.from = \"\"\n";
    if (run.start != Start::not_said)
      output << "release = " << (run.start == Start::anywhere ? "\"unknown\"" : "\"at rest\"") << "\n";
    for (const KnownValue& known : run.known) output << "known." << known_line(known) << "\n";
    for (const Override& override : run.overrides)
      if (override.key != "box.length") output << override.key << " = " << toml_value(override) << "\n";
  }
  write_file(file, output.str());
}

}  // namespace shakedown
