// SPDX-License-Identifier: MIT
#include "contact_curve_section.hpp"

#include <cctype>

#include "report_parts.hpp"

namespace shakedown {

namespace {

ReportPlot plot_against_speed(const ContactCurve& curve, const ContactBand& band_of,
                              const std::string& title) {
  ReportPlot plot;
  plot.title = title;
  plot.x_label = std::string(curve.law->speed) + " at first touch, m/s";
  plot.y_label = curve.law->coefficient;
  plot.x = curve.speed;
  std::vector<double> low, high;
  for (std::size_t i = 0; i < curve.speed.size(); ++i)
    low.push_back(curve.low(band_of, i)), high.push_back(curve.high(band_of, i));
  plot.curves = band("95 %", low, high);
  plot.curves.push_back({std::string(curve.law->coefficient), CurveRole::model, band_of.value});
  return plot;
}

std::string capitalised(std::string text) {
  if (!text.empty()) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

}  // namespace

ReportSection contact_curve_section(const ContactCurve& curve) {
  ReportSection section;
  section.title =
      capitalised(std::string(curve.law->coefficient)) + " against " + std::string(curve.law->speed);
  section.paragraphs = {"No form assumed but that it does not turn: it " + words_of(curve) + "."};
  section.plots = {plot_against_speed(curve, curve.grains, "Grains"),
                   plot_against_speed(curve, curve.walls, "Walls")};
  return section;
}

}  // namespace shakedown
