// SPDX-License-Identifier: MIT
// What panels of curves and of bars are drawn with.
#pragma once
#include "drawing.hpp"

namespace shakedown {

struct Style {
  std::array<double, 3> colour{};
  double width = 1;          ///< points
  std::vector<double> dash;  ///< points
};
/// Returns colour, width and dashes of a curve with this look.
Style style_of(Look look);
constexpr std::array<double, 3> ink{0.11, 0.13, 0.14}, pale{0.88, 0.88, 0.88};

/// Make marks of a drawing; `what` names the mark in the file.
Mark text_at(double x, double y, std::string words, Anchor anchor, const char* what);
Mark line_through(std::vector<DrawnPoint> points, const Style& style, const char* what);
Mark area_within(std::vector<DrawnPoint> points, std::array<double, 3> colour, double opacity,
                 const char* what);

/// A word of the legend with what stands before it.
struct Entry {
  std::string name;
  std::vector<Mark> sample;  ///< between (0, 0) and (sample_width, 0)
};
constexpr double sample_width = 14;

/// From one base line to the next, points.
constexpr double row = 1.4 * letter_size;

/// Adds the words in rows between left and right; returns the height of them all, points.
double add_legend(const std::vector<Entry>& entries, double left, double right, std::vector<Mark>& marks);

/// Draws a figure of bars, `width` points wide.
Drawing drawn_bars(const Figure& figure, double width);

}  // namespace shakedown
