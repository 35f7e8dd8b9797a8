// SPDX-License-Identifier: MIT
#include "page_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace shakedown {

namespace {

std::string caption_html(const std::string& caption) {
  return caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>";
}
std::string title_html(const std::string& title) {
  return title.empty() ? "" : "<h3>" + escaped(title) + "</h3>";
}

std::string bare_table(const std::vector<std::string>& columns,
                       const std::vector<std::vector<std::string>>& rows) {
  std::string text = fmt::format("<div class=\"scroll\" tabindex=\"0\"><table{}><thead><tr>",
                                 columns.size() > 5 ? " class=\"wide\"" : "");
  for (const std::string& column : columns) text += "<th scope=\"col\">" + escaped(column) + "</th>";
  text += "</tr></thead><tbody>";
  for (const std::vector<std::string>& row : rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += "<td>" + escaped(cell) + "</td>";
    text += "</tr>";
  }
  return text + "</tbody></table></div>";
}

std::string percent(double fraction) { return fmt::format("{:.2f}%", 100 * std::clamp(fraction, 0.0, 1.0)); }

/// Returns the length of the longest bar with its error, in the values' unit.
double longest(const ReportBars& bars) {
  double top = std::isfinite(bars.floor) ? bars.floor : 0;
  for (const ReportBars::Line& line : bars.lines)
    for (std::size_t k = 0; k < line.values.size(); ++k)
      if (std::isfinite(line.values[k])) {
        const double error = k < line.errors.size() && std::isfinite(line.errors[k]) ? line.errors[k] : 0;
        top = std::max(top, line.values[k] + error);
      }
  return top > 0 ? top : 1;
}

/// Bars end at this fraction of the lane: what is right of it holds the numbers.
constexpr double lane = 0.74;

std::string bar_html(double value, double error, const std::string& kind, double top, const std::string& unit,
                     const std::string& name) {
  if (!std::isfinite(value))
    return fmt::format("<div class=\"bar {}\" title=\"{}\"><span>no number</span></div>", kind,
                       escaped(name));
  std::string whisker;
  if (std::isfinite(error) && value > 0)
    whisker = fmt::format("<s style=\"left:{:.1f}%;width:{:.1f}%\"></s>",
                          100 * std::max(0.0, value - error) / value,
                          100 * (std::min(error, value) + error) / value);
  return fmt::format("<div class=\"bar {}\" title=\"{}\"><i style=\"width:{}\">{}</i><span>{}{}</span></div>",
                     kind, escaped(name), percent(lane * std::max(0.0, value) / top), whisker,
                     for_people(value), unit.empty() ? "" : " " + escaped(unit));
}

}  // namespace

std::string for_people(double value) {
  if (!std::isfinite(value)) return "–";
  const double size = std::abs(value);
  if (size != 0 && (size < 1e-3 || size >= 1e6)) return fmt::format("{:.2e}", value);
  if (size >= 1000) return fmt::format("{:.0f}", value);
  return value == 0 ? "0" : size >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:#.3g}", value);
}

std::string with_interval(double value, double low, double high) {
  const double width = high - low;
  if (!std::isfinite(width)) return for_people(value);
  const int decimals = width > 0 ? static_cast<int>(std::ceil(1 - std::log10(width))) : 3;
  if (decimals > 7) return fmt::format("{} ({} to {})", for_people(value), for_people(low), for_people(high));
  const auto number = [&](double v) { return fmt::format("{:.{}f}", v, std::max(0, decimals)); };
  return number(value) + " (" + number(low) + " to " + number(high) + ")";
}

std::string_view css_class(Tone tone) {
  switch (tone) {
    case Tone::good: return "good";
    case Tone::bad: return "bad";
    case Tone::unsure: return "unsure";
    case Tone::plain: break;
  }
  return "plain";
}

std::string table_html(const ReportTable& table) {
  const std::string inside = bare_table(table.columns, table.rows) + caption_html(table.caption);
  if (table.folded)
    return "<details class=\"plain\"><summary>" + escaped(table.title) + "</summary>" + inside + "</details>";
  return "<figure>" + title_html(table.title) + inside + "</figure>";
}

std::string bars_html(const ReportBars& bars) {
  const double top = longest(bars);
  std::string text = "<figure>" + title_html(bars.title) + "<div class=\"key\">";
  for (std::size_t k = 0; k < bars.names.size() && bars.names.size() > 1; ++k)
    text += fmt::format("<span><i class=\"k{}\"></i>{}</span>", k, escaped(bars.names[k]));
  if (std::isfinite(bars.floor))
    text += fmt::format("<span><i class=\"floor\"></i>{}: {} {}</span>", escaped(bars.floor_name),
                        for_people(bars.floor), escaped(bars.unit));
  text += "</div><div class=\"bars\">";
  for (const ReportBars::Line& line : bars.lines) {
    text += "<div class=\"label\">" + escaped(line.label) +
            (line.note.empty() ? "" : "<small>" + escaped(line.note) + "</small>") +
            "</div><div class=\"lane\">";
    for (std::size_t k = 0; k < line.values.size(); ++k)
      text += bar_html(line.values[k], k < line.errors.size() ? line.errors[k] : std::nan(""),
                       fmt::format("k{}{}", k, line.tone == Tone::unsure ? " tied" : ""), top, bars.unit,
                       k < bars.names.size() ? bars.names[k] : "");
    if (std::isfinite(bars.floor))
      text += "<b class=\"floor\" style=\"left:" + percent(lane * bars.floor / top) + "\"></b>";
    text += "</div>";
  }
  return text + "</div>" + caption_html(bars.caption) + "</figure>";
}

std::string strip_html(const ReportStrip& strip) {
  std::string text = "<figure>" + title_html(strip.title);
  text += fmt::format(
      "<div class=\"key\"><span>0 <b class=\"ramp\"></b> {:g} and more {}</span></div><div class=\"strip\">",
      strip.top, escaped(strip.value_name));
  for (const ReportStrip::Row& row : strip.rows) {
    text += "<span>" + escaped(row.name) + "</span><div class=\"cells\">";
    for (std::size_t k = 0; k < row.values.size(); ++k) {
      const double middle = (strip.edges[k] + strip.edges[k + 1]) / 2;
      if (!std::isfinite(row.values[k]))
        text += "<i class=\"none\" title=\"not measured or not moving\"></i>";
      else
        text += fmt::format(
            "<i style=\"--v:{:.2f}\" data-at=\"{:.3f}\" data-show=\"{}\" title=\"{}, {:.2f} to {:.2f} s: {} "
            "{}\"></i>",
            std::clamp(row.values[k] / strip.top, 0.0, 1.0), middle, escaped(row.group), escaped(row.name),
            strip.edges[k], strip.edges[k + 1], for_people(row.values[k]), escaped(strip.value_name));
    }
    text += "</div>";
  }
  if (!strip.edges.empty())
    text += fmt::format(
        "<span></span><div class=\"ticks\"><span>{:g}</span><span>{}</span><span>{:g}</span></div>",
        strip.edges.front(), escaped(strip.x_label), strip.edges.back());
  return text + "</div>" + caption_html(strip.caption) + "</figure>";
}

std::string intervals_html(const std::vector<ReportInterval>& intervals) {
  if (intervals.empty()) return "";
  std::string text = "<div class=\"intervals\">";
  for (const ReportInterval& v : intervals) {
    const bool whiskers = std::isfinite(v.low) && std::isfinite(v.high), given = std::isfinite(v.given);
    text += "<span>" + escaped(v.name) + "</span>";
    if (!v.word.empty()) {
      text += "<span class=\"track\"></span><span class=\"number\">" + escaped(v.word) + "</span>";
      continue;
    }
    double low = whiskers ? v.low : v.value, high = whiskers ? v.high : v.value;
    if (given) low = std::min(low, v.given), high = std::max(high, v.given);
    const bool known = std::isfinite(v.known_low) && std::isfinite(v.known_high);
    if (known) low = std::min(low, v.known_low), high = std::max(high, v.known_high);
    const double margin = high > low ? 0.15 * (high - low) : 1e-12 + 0.02 * std::abs(v.value),
                 from = low - margin, across = high - low + 2 * margin;
    const auto at = [&](double x) { return percent((x - from) / across); };
    text += "<span class=\"track\">";
    if (known)
      text += fmt::format("<em style=\"left:{};width:{}\" title=\"known before\"></em>", at(v.known_low),
                          percent((v.known_high - v.known_low) / across));
    if (given) text += "<u style=\"left:" + at(v.given) + "\" title=\"in the setup\"></u>";
    if (whiskers)
      text +=
          fmt::format("<b style=\"left:{};width:{}\"></b>", at(v.low), percent((v.high - v.low) / across));
    const std::string number = whiskers ? with_interval(v.value, v.low, v.high) : for_people(v.value);
    const std::size_t interval = std::min(number.find(" ("), number.size());
    text += "<i style=\"left:" + at(v.value) + "\"></i></span><span class=\"number\">" +
            number.substr(0, interval) + " " + escaped(v.unit);
    if (interval < number.size()) text += "<small>" + number.substr(interval) + "</small>";
    if (given) text += fmt::format(" <small>setup: {}</small>", for_people(v.given));
    if (known)
      text +=
          fmt::format(" <small>known: {} to {}</small>", for_people(v.known_low), for_people(v.known_high));
    text += "</span>";
  }
  return text + "</div>";
}

std::string numbers_html(const ReportPlot& plot) {
  std::vector<std::string> columns{plot.x_label};
  for (const ReportCurve& curve : plot.curves) columns.push_back(curve.name);
  std::vector<std::vector<std::string>> rows;
  const std::size_t step = std::max<std::size_t>(1, plot.x.size() / 30);
  for (std::size_t i = 0; i < plot.x.size(); i += step) {
    rows.push_back({for_people(plot.x[i])});
    for (const ReportCurve& curve : plot.curves) rows.back().push_back(for_people(curve.y[i]));
  }
  return "<details><summary>Numbers as a table" +
         std::string(step > 1 ? fmt::format(" (one line in {})", step) : "") + "</summary>" +
         bare_table(columns, rows) + "</details>";
}

}  // namespace shakedown
