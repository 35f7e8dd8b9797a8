// SPDX-License-Identifier: MIT
#include "chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "markup.hpp"
#include "series_file.hpp"

namespace shakedown {

namespace {

constexpr double width = 760, panel_height = 300, left = 74, right = 16, top = 34, bottom = 46;
constexpr std::size_t most_points = 3000;  // of a line: more cannot be seen
constexpr std::array<const char*, 6> colours{"#1b6ca8", "#c0392b", "#2e8b57",
                                             "#8e44ad", "#d68910", "#555555"};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Returns the step of about six ticks, 1, 2 or 5 times a power of ten.
double tick_step(const Range& range) {
  const double raw = (range.high - range.low) / 6, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power) return factor * power;
  return 10 * power;
}

class Drawing {
 public:
  Drawing(const Panel& panel, double offset) : panel_(panel), offset_(offset) {
    for (const Curve& curve : panel.curves) {
      for (const double x : curve.x) x_.include(x);
      for (const double y : curve.y) y_.include(y);
    }
    if (!(x_.high > x_.low)) x_ = {0, 1};
    if (!(y_.high > y_.low))
      y_ = {std::isfinite(y_.low) ? y_.low - 1 : 0, std::isfinite(y_.low) ? y_.low + 1 : 1};
    const double margin = 0.04 * (y_.high - y_.low);
    y_ = {y_.low - margin, y_.high + margin};
  }

  std::string svg() const {
    std::string text = axes();
    for (std::size_t c = 0; c < panel_.curves.size(); ++c)
      text += curve(panel_.curves[c], colours[c % colours.size()], c);
    for (const Panel::Vertical& line : panel_.verticals)
      text += fmt::format(
          "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#333\" "
          "stroke-dasharray=\"6 4\"/>"
          "<text x=\"{3:.1f}\" y=\"{4:.1f}\">{5}</text>\n",
          at_x(line.x), offset_ + top, offset_ + panel_height - bottom, at_x(line.x) + 4, offset_ + top + 12,
          escaped(line.label));
    return text;
  }

 private:
  double at_x(double x) const { return left + (x - x_.low) / (x_.high - x_.low) * (width - left - right); }
  double at_y(double y) const {
    return offset_ + panel_height - bottom -
           (y - y_.low) / (y_.high - y_.low) * (panel_height - top - bottom);
  }

  std::string axes() const {
    std::string text =
        fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#333\"/>\n",
                    left, offset_ + top, width - left - right, panel_height - top - bottom);
    const double dx = tick_step(x_), dy = tick_step(y_);
    for (double x = std::ceil(x_.low / dx) * dx; x <= x_.high; x += dx)
      text += fmt::format(
          "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" "
          "y=\"{3}\" text-anchor=\"middle\">{4:.6g}</text>\n",
          at_x(x), offset_ + top, offset_ + panel_height - bottom, offset_ + panel_height - bottom + 16,
          std::abs(x) < dx / 1e6 ? 0 : x);
    for (double y = std::ceil(y_.low / dy) * dy; y <= y_.high; y += dy)
      text += fmt::format(
          "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#ddd\"/><text x=\"{3}\" "
          "y=\"{4:.1f}\" text-anchor=\"end\">{5:.6g}</text>\n",
          left, width - right, at_y(y), left - 6, at_y(y) + 4, std::abs(y) < dy / 1e6 ? 0 : y);
    text += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                        (left + width - right) / 2, offset_ + panel_height - 10, escaped(panel_.x_label));
    const double middle = offset_ + (top + panel_height - bottom) / 2;
    return text + fmt::format(
                      "<text x=\"16\" y=\"{0}\" text-anchor=\"middle\" transform=\"rotate(-90 16 "
                      "{0})\">{1}</text>\n",
                      middle, escaped(panel_.y_label));
  }

  std::string curve(const Curve& curve, const char* colour, std::size_t number) const {
    const double key = left + 10 + 168.0 * static_cast<double>(number % 4),
                 line = offset_ + top - 8 - 13.0 * static_cast<double>(number / 4);
    std::string text = fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" "
        "stroke-width=\"2\"{4}/><text x=\"{5:.1f}\" y=\"{6:.1f}\">{7}</text>\n",
        key, key + 18, line - 4, colour, curve.dashed ? " stroke-dasharray=\"5 3\"" : "", key + 22, line,
        escaped(curve.name));
    const std::size_t step = curve.points ? 1 : std::max<std::size_t>(1, curve.x.size() / most_points);
    std::string path;
    bool pen_down = false;
    for (std::size_t i = 0; i < curve.x.size(); i += step) {
      if (!std::isfinite(curve.y[i])) {
        pen_down = false;
        continue;
      }
      if (curve.points)
        text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"none\" stroke=\"{}\"/>\n",
                            at_x(curve.x[i]), at_y(curve.y[i]), colour);
      else
        path += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", at_x(curve.x[i]), at_y(curve.y[i]));
      pen_down = true;
    }
    if (!path.empty())
      text += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.3\"{}/>\n", path,
                          colour, curve.dashed ? " stroke-dasharray=\"5 3\"" : "");
    return text;
  }

  const Panel& panel_;
  double offset_;
  Range x_, y_;
};

}  // namespace

std::string svg_of(const Chart& chart) {
  const double height = 24 + panel_height * static_cast<double>(chart.panels.size());
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<text x=\"{2}\" y=\"18\" "
      "font-size=\"14\">{3}</text>\n",
      width, height, left, escaped(chart.title));
  for (std::size_t p = 0; p < chart.panels.size(); ++p)
    text += Drawing(chart.panels[p], 24 + panel_height * static_cast<double>(p)).svg();
  return text + "</svg>\n";
}

std::string csv_of(const Chart& chart) {
  std::string text = "panel,curve,x,y\n";
  for (const Panel& panel : chart.panels)
    for (const Curve& curve : panel.curves)
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        text += fmt::format("\"{}\",\"{}\",", panel.y_label, curve.name) + csv_line({curve.x[i], curve.y[i]});
  return text;
}

}  // namespace shakedown
