// SPDX-License-Identifier: MIT
// Writes line charts as SVG, and the numbers in them as CSV.
#pragma once
#include <string>
#include <vector>

namespace shakedown {

struct Curve {
  std::string name;
  std::vector<double> x, y;  ///< NaN in y: a gap
  bool dashed = false;
  bool points = false;  ///< marks instead of a line
};

struct Panel {
  std::string x_label, y_label;
  std::vector<Curve> curves;
  struct Vertical {
    double x;
    std::string label;
  };
  std::vector<Vertical> verticals{};  ///< dashed lines from bottom to top
};

struct Chart {
  std::string name;  ///< of its files, without ending
  std::string title;
  std::vector<Panel> panels;  ///< one below the other
};

/// Returns the chart as an SVG file of its own.
std::string svg_of(const Chart& chart);

/// Returns the table "panel,curve,x,y", where panel is the label of its y axis; ten significant digits.
std::string csv_of(const Chart& chart);

}  // namespace shakedown
