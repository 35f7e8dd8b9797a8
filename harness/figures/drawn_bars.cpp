// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "axis.hpp"
#include "drawn_parts.hpp"

namespace shakedown {

namespace {

Mark bar_between(double left, double right, double top, double bottom, bool filled, const char* what) {
  const std::array<double, 3> colour = style_of(Look::model).colour;
  std::vector<DrawnPoint> corners{{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  if (filled) return area_within(std::move(corners), colour, 1, what);
  corners.push_back(corners.front());
  return line_through(std::move(corners), {colour, 0.8, {}}, what);
}

const Style floor_style{{0.75, 0.29, 0}, 0.8, {3, 2}};

std::vector<Entry> entries_of_bars(const Figure& figure) {
  std::vector<Entry> entries;
  const auto add = [&](const std::string& name, Mark mark) {
    if (!name.empty()) entries.push_back({name, {std::move(mark)}});
  };
  add(figure.bar_name, bar_between(0, sample_width, -3, 3, true, "legend"));
  add(figure.second_name, bar_between(0, sample_width, -3, 3, false, "legend"));
  Mark tied = bar_between(0, sample_width, -3, 3, true, "legend");
  tied.opacity = 0.45;
  add(figure.tied_name, std::move(tied));
  add(figure.floor_name,
      line_through({{sample_width / 2, -4}, {sample_width / 2, 4}}, floor_style, "legend"));
  return entries;
}

/// Returns a number with three digits.
std::string number_of(double value) {
  if (value == 0) return "0";
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return before < -3 ? fmt::format("{:.2g}", value) : fmt::format("{:.{}f}", value, std::max(0, 2 - before));
}

/// Breaks a label into lines that fit.
std::vector<std::string> lines_of(const std::string& label, double width) {
  std::vector<std::string> lines{""};
  for (std::size_t at = 0; at < label.size();) {
    const std::size_t end = std::min(label.find(' ', at), label.size());
    const std::string word = label.substr(at, end - at);
    if (lines.back().empty())
      lines.back() = word;
    else if (text_width(lines.back() + " " + word) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
    at = end + 1;
  }
  return lines;
}

/// Places along a figure of bars, points.
struct Lane {
  double left = 0, right = 0, longest = 1;  ///< longest: the number at `right`
  double across(double value) const { return left + (right - left) * value / longest; }
};
constexpr double thick = 6, inset = 3;

void add_bar(double value, bool filled, double opacity, const Lane& lane, double top,
             std::vector<Mark>& marks) {
  if (!std::isfinite(value)) return;
  marks.push_back(
      bar_between(lane.left, lane.across(value), top, top + thick, filled, filled ? "bar" : "second"));
  marks.back().opacity = opacity;
  marks.push_back(text_at(lane.across(value) + inset, top + thick - 0.1 * thick, number_of(value),
                          Anchor::start, "value"));
}

void add_scale(const Axis& axis, const std::string& label, const Lane& lane, double top, double bottom,
               std::vector<Mark>& marks) {
  const Style style{ink, 0.6, {}};
  marks.push_back(line_through({{lane.left, top}, {lane.left, bottom}, {lane.right, bottom}}, style, "axis"));
  for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
    const double x = lane.across(axis.ticks[i]);
    marks.push_back(line_through({{x, bottom}, {x, bottom + 3}}, style, "axis"));
    marks.push_back(text_at(x, bottom + 5 + 0.8 * letter_size, axis.labels[i], Anchor::middle, "x_tick"));
  }
  marks.push_back(text_at((lane.left + lane.right) / 2, bottom + 5 + 2.1 * letter_size, label, Anchor::middle,
                          "x_label"));
}

}  // namespace

Drawing drawn_bars(const Figure& figure, double width) {
  Drawing drawing{width, 0, {}};
  const Panel& panel = figure.panels.front();
  double top = std::isfinite(panel.floor) ? panel.floor : 0;
  for (const FigureBar& bar : panel.bars)
    for (const double value : {bar.value, bar.second})
      if (std::isfinite(value)) top = std::max(top, value);
  const Axis axis = axis_of(0, top > 0 ? top : 1, width > 300 ? 8 : 4, true);
  const Lane lane{4, width - 26, axis.high};
  double y = add_legend(entries_of_bars(figure), lane.left, width - 4, drawing.marks) + 2;
  const double first = y;
  for (const FigureBar& bar : panel.bars) {
    for (const std::string& line : lines_of(bar.label, width - lane.left - inset - 4)) {
      drawing.marks.push_back(text_at(lane.left + inset, y + letter_size, line, Anchor::start, "label"));
      y += 1.2 * letter_size;
    }
    y += 1.4;
    constexpr double faint = 0.45;
    add_bar(bar.value, true, bar.tied ? faint : 1, lane, y, drawing.marks);
    y += thick;
    if (std::isfinite(bar.second)) {
      add_bar(bar.second, false, 1, lane, y + 1, drawing.marks);
      y += thick + 1;
    }
    y += 4;
  }
  if (std::isfinite(panel.floor))
    drawing.marks.push_back(line_through({{lane.across(panel.floor), first}, {lane.across(panel.floor), y}},
                                         floor_style, "floor"));
  add_scale(axis, panel.x_label, lane, first, y, drawing.marks);
  drawing.height = y + 5 + 2.6 * letter_size;
  return drawing;
}

}  // namespace shakedown
