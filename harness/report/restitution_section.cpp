// SPDX-License-Identifier: MIT
#include "restitution_section.hpp"

#include "report_parts.hpp"

namespace shakedown {

namespace {

ReportPlot plot_against_speed(const std::vector<double>& speed, const RestitutionBand& band_of,
                              const std::string& title) {
  ReportPlot plot;
  plot.title = title;
  plot.x_label = "closing speed at first touch, m/s";
  plot.y_label = "restitution";
  plot.x = speed;
  std::vector<double> low, high;
  for (std::size_t i = 0; i < speed.size(); ++i)
    low.push_back(band_of.low(i)), high.push_back(band_of.high(i));
  plot.curves = band("95 %", low, high);
  plot.curves.push_back({"restitution", CurveRole::model, band_of.restitution});
  return plot;
}

}  // namespace

ReportSection restitution_section(const RestitutionCurve& curve) {
  ReportSection section;
  section.title = "Restitution against speed";
  section.paragraphs = {"No form assumed but that it does not turn: it " + words_of(curve) + "."};
  section.plots = {plot_against_speed(curve.speed, curve.grains, "Grains"),
                   plot_against_speed(curve.speed, curve.walls, "Walls")};
  return section;
}

}  // namespace shakedown
