// SPDX-License-Identifier: MIT
#include "drawn_parts.hpp"

namespace shakedown {

const char* name_of(Look look) {
  switch (look) {
    case Look::measured: return "measured";
    case Look::model: return "model";
    case Look::as_given: return "as_given";
    case Look::second: return "second";
    case Look::third: return "third";
    case Look::fourth: break;
  }
  return "fourth";
}

/// Widths of Helvetica in thousandths of its size, from its metrics; rare letters count as a digit.
double text_width(const std::string& text) {
  double thousandths = 0;
  for (const char letter : text) {
    if ((static_cast<unsigned char>(letter) & 0xC0) == 0x80) continue;  // the rest of a UTF-8 letter
    const auto among = [&](const char* letters) {
      return std::string_view(letters).find(letter) != std::string_view::npos;
    };
    thousandths += among("ijl'|")           ? 222
                   : among("ft .,:;/!I()-") ? 278
                   : among("r\"")           ? 333
                   : among("ckvxyzsJ")      ? 500
                   : among("mM%")           ? 860
                   : among("wCDHNRU")       ? 722
                   : among("GOQ")           ? 778
                   : among("ABEKPSVXYWTZ")  ? 667
                                            : 556;
  }
  return letter_size * thousandths / 1000;
}

/// Colours that stay apart for all kinds of eyes and in print; dashes where grey must tell them too.
Style style_of(Look look) {
  switch (look) {
    case Look::measured: return {{0.11, 0.13, 0.14}, 0.8, {}};
    case Look::model: return {{0, 0.40, 0.66}, 0.9, {}};
    case Look::as_given: return {{0.75, 0.29, 0}, 0.8, {3.5, 2}};
    case Look::second: return {{0, 0.47, 0.35}, 0.9, {5, 1.5, 1, 1.5}};
    case Look::third: return {{0.80, 0.47, 0.65}, 0.9, {1.2, 1.2}};
    case Look::fourth: break;
  }
  return {{0.45, 0.45, 0.47}, 0.9, {7, 2}};
}

Mark text_at(double x, double y, std::string words, Anchor anchor, const char* what) {
  Mark mark;
  mark.kind = Mark::Kind::text, mark.what = what, mark.colour = ink, mark.anchor = anchor;
  mark.points = {{x, y}}, mark.text = std::move(words);
  return mark;
}

Mark line_through(std::vector<DrawnPoint> points, const Style& style, const char* what) {
  Mark mark;
  mark.what = what, mark.points = std::move(points);
  mark.colour = style.colour, mark.width = style.width, mark.dash = style.dash;
  return mark;
}

Mark area_within(std::vector<DrawnPoint> points, std::array<double, 3> colour, double opacity,
                 const char* what) {
  Mark mark;
  mark.kind = Mark::Kind::area, mark.what = what, mark.points = std::move(points);
  mark.colour = colour, mark.opacity = opacity;
  return mark;
}

double add_legend(const std::vector<Entry>& entries, double left, double right, std::vector<Mark>& marks) {
  if (entries.empty()) return 0;
  double x = left, y = letter_size;
  for (const Entry& entry : entries) {
    const double width = sample_width + 3 + text_width(entry.name);
    if (x > left && x + width > right) x = left, y += row;
    for (Mark mark : entry.sample) {
      for (DrawnPoint& point : mark.points) point.x += x, point.y += y - 0.33 * letter_size;
      marks.push_back(std::move(mark));
    }
    marks.push_back(text_at(x + sample_width + 3, y, entry.name, Anchor::start, "legend"));
    x += width + 10;
  }
  return y + 0.4 * row;
}

}  // namespace shakedown
