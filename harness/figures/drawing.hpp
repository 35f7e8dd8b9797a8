// SPDX-License-Identifier: MIT
// A figure laid out: lines, areas, dots and words at their places, which a file format writes one by one.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "figure.hpp"

namespace shakedown {

/// Points of a printer: 1/72 inch.
constexpr double points_per_mm = 72 / 25.4;

enum class Anchor { start, middle, end };

struct DrawnPoint {
  double x = 0, y = 0;  ///< points from the upper left corner
};

struct Mark {
  enum class Kind { line, area, dots, text };
  Kind kind = Kind::line;
  std::string what;                ///< "axis", "grid", or name_of() its look
  std::vector<DrawnPoint> points;  ///< of a text one: where its anchor stands, on the base line
  std::array<double, 3> colour{};  ///< red, green, blue, 0 to 1
  double opacity = 1;
  double width = 0;          ///< of a line; of dots their diameter
  std::vector<double> dash;  ///< lengths of strokes and gaps
  std::string text;
  Anchor anchor = Anchor::start;
  bool turned = false;  ///< upwards
};

struct Drawing {
  double width = 0, height = 0;  ///< points
  std::vector<Mark> marks;       ///< those behind first
};

/// Letters have this size, points.
constexpr double letter_size = 8;

/// Returns the width of a text in Helvetica, points, by classes of letters, so that it needs no font.
double text_width(const std::string& text);

/// Returns the drawing as SVG text. Letters stay text.
std::string svg_of(const Drawing& drawing);

/// Returns the drawing as the bytes of a PDF with the font in it. The same drawing gives the same bytes.
/// Throws FileError where the library fails.
std::string pdf_of(const Drawing& drawing);

}  // namespace shakedown
