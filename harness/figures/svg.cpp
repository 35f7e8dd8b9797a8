// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "drawing.hpp"
#include "markup.hpp"

namespace shakedown {

namespace {

std::string colour_of(const Mark& mark) {
  const auto byte = [](double share) { return static_cast<int>(std::lround(255 * share)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(mark.colour[0]), byte(mark.colour[1]), byte(mark.colour[2]));
}

std::string places_of(const Mark& mark) {
  std::string places;
  for (const DrawnPoint& point : mark.points)
    places += fmt::format("{}{:.2f},{:.2f}", places.empty() ? "" : " ", point.x, point.y);
  return places;
}

std::string element_of(const Mark& mark) {
  const std::string beginning = fmt::format(" class=\"{}\"", mark.what), colour = colour_of(mark);
  const std::string opacity = mark.opacity < 1 ? fmt::format(" fill-opacity=\"{}\"", mark.opacity) : "";
  switch (mark.kind) {
    case Mark::Kind::line: {
      std::string dash;
      for (const double length : mark.dash) dash += fmt::format("{}{}", dash.empty() ? "" : " ", length);
      if (!dash.empty()) dash = " stroke-dasharray=\"" + dash + "\"";
      return fmt::format("<polyline{} fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{} points=\"{}\"/>\n",
                         beginning, colour, mark.width, dash, places_of(mark));
    }
    case Mark::Kind::area:
      return fmt::format("<polygon{} fill=\"{}\"{} points=\"{}\"/>\n", beginning, colour, opacity,
                         places_of(mark));
    case Mark::Kind::dots: {
      std::string dots = fmt::format("<g{} fill=\"{}\">\n", beginning, colour);
      for (const DrawnPoint& point : mark.points)
        dots +=
            fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\"/>\n", point.x, point.y, mark.width / 2);
      return dots + "</g>\n";
    }
    case Mark::Kind::text: break;
  }
  const DrawnPoint& at = mark.points.front();
  const char* anchor = mark.anchor == Anchor::start    ? "start"
                       : mark.anchor == Anchor::middle ? "middle"
                                                       : "end";
  const std::string turn =
      mark.turned ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", at.x, at.y) : "";
  return fmt::format("<text{} x=\"{:.2f}\" y=\"{:.2f}\" fill=\"{}\" text-anchor=\"{}\"{}>{}</text>\n",
                     beginning, at.x, at.y, colour, anchor, turn, escaped(mark.text));
}

}  // namespace

std::string svg_of(const Drawing& drawing) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "width=\"{:.2f}mm\" "
      "height=\"{:.2f}mm\" viewBox=\"0 0 {:.2f} {:.2f}\" font-family=\"Helvetica, Arial, 'Liberation Sans', "
      "sans-serif\" font-size=\"{}\" stroke-linejoin=\"round\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#ffffff\"/>\n",
      drawing.width / points_per_mm, drawing.height / points_per_mm, drawing.width, drawing.height,
      letter_size);
  for (const Mark& mark : drawing.marks) text += element_of(mark);
  return text + "</svg>\n";
}

}  // namespace shakedown
