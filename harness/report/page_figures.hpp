// SPDX-License-Identifier: MIT
// Makes the pieces of the page that need no script: tables, bars, strips, intervals.
#pragma once
#include <string>
#include <string_view>

#include "markup.hpp"
#include "report.hpp"

namespace shakedown {

/// Returns a number for people: four significant digits, no exponent between 1e-3 and 1e5.
std::string for_people(double value);

/// Returns "0.9901 (0.9899 to 0.9903)", with as many digits as the interval deserves.
std::string with_interval(double value, double low, double high);

/// Returns the class of the page's style sheet.
std::string_view css_class(Tone tone);

/// Return parts of a page as HTML, their texts escaped.
std::string table_html(const ReportTable& table);
std::string bars_html(const ReportBars& bars);
std::string strip_html(const ReportStrip& strip);
std::string intervals_html(const std::vector<ReportInterval>& intervals);

/// Returns the numbers behind a plot as a table, thinned to some thirty lines.
std::string numbers_html(const ReportPlot& plot);

}  // namespace shakedown
