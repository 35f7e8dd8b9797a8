// SPDX-License-Identifier: MIT
// A figure for a paper as plain data: panels with curves over two axes, or with bars.
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace shakedown {

/// Who is drawn; line and colour follow from it, so that a reader knows them again in every figure.
enum class Look { measured, model, as_given, second, third, fourth };

/// Returns the word of a look, as elements of an SVG have it for their class.
const char* name_of(Look look);

struct FigureCurve {
  std::string name;  ///< "measured"
  Look look = Look::model;
  std::vector<double> x, y;    ///< in the units of the axes; NaN: a gap
  std::vector<double> errors;  ///< of single points, drawn as bars; may be empty
  bool points = false;         ///< single points, not a line
};

struct FigureBand {
  std::string name;
  std::vector<double> x, low, high;  ///< in the units of the axes; NaN: a gap
};

struct FigureBar {
  std::string label;
  double value = 0, second = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none
  bool tied = false;                                                    ///< not told from the others that are
};

struct Panel {
  std::string title;             ///< of several panels: whose it is
  std::string x_label, y_label;  ///< with the unit: "time, s"
  std::vector<FigureBand> bands;
  std::vector<FigureCurve> curves;
  bool through_zero = false;  ///< a line at y = 0
  /// Instead of bands and curves; x_label is that of their lengths.
  std::vector<FigureBar> bars;
  double floor = std::numeric_limits<double>::quiet_NaN();  ///< of bars: a line across
};

struct Figure {
  std::vector<Panel> panels;
  std::string bar_name, second_name, tied_name, floor_name;  ///< of bars, for the legend; may be empty
};

}  // namespace shakedown
