// SPDX-License-Identifier: MIT
#include "drawn_figure.hpp"

#include <algorithm>
#include <cmath>

#include "axis.hpp"
#include "drawn_parts.hpp"

namespace shakedown {

namespace {

constexpr double band_opacity = 0.18;

struct Frame {
  double left = 0, top = 0, right = 0, bottom = 0;  // points
};

/// Puts more points on a curve of few, smooth through them (Catmull and Rom's cubics); gaps stay.
void smooth(std::vector<double>& x, std::vector<double>& y) {
  constexpr std::size_t enough = 1000;
  constexpr int parts = 5;
  const std::size_t n = x.size();
  if (n < 4 || n > enough) return;
  std::vector<double> xs, ys;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double dx = x[i + 1] - x[i];
    const auto slope = [&](std::size_t k) {
      const std::size_t a = k > 0 && std::isfinite(y[k - 1]) ? k - 1 : k,
                        b = k + 1 < n && std::isfinite(y[k + 1]) ? k + 1 : k;
      return b > a ? (y[b] - y[a]) / (x[b] - x[a]) : 0;
    };
    xs.push_back(x[i]), ys.push_back(y[i]);
    if (!std::isfinite(y[i]) || !std::isfinite(y[i + 1]) || !(dx > 0)) continue;
    const double a = slope(i) * dx, b = slope(i + 1) * dx;
    for (int part = 1; part < parts; ++part) {
      const double u = part / static_cast<double>(parts), w = 1 - u;
      xs.push_back(x[i] + u * dx);
      ys.push_back(w * w * (1 + 2 * u) * y[i] + u * u * (3 - 2 * u) * y[i + 1] + u * w * (w * a - u * b));
    }
  }
  xs.push_back(x.back()), ys.push_back(y.back());
  x = std::move(xs), y = std::move(ys);
}

/// What is drawn within one frame.
class Plot {
 public:
  Plot(const Panel& panel, int ticks_across, int ticks_up) : panel_(panel) {
    double left = INFINITY, right = -INFINITY, low = INFINITY, high = -INFINITY;
    const auto widen = [](double& least, double& most, const std::vector<double>& values) {
      for (const double value : values)
        if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
    };
    for (const FigureBand& band : panel.bands)
      widen(left, right, band.x), widen(low, high, band.low), widen(low, high, band.high);
    for (const FigureCurve& curve : panel.curves) widen(left, right, curve.x), widen(low, high, curve.y);
    if (panel.through_zero) low = std::min(low, 0.0), high = std::max(high, 0.0);
    if (!(left <= right)) left = 0, right = 1;
    if (!(low <= high)) low = 0, high = 1;
    const double margin = 0.04 * (high - low),
                 end = panel.curves.size() && left > 0 && left < 0.1 * right ? 0 : left;
    x_ = axis_of(end, right, ticks_across, false);
    y_ = axis_of(low - margin, high + margin, ticks_up, false);
  }
  double label_width() const {
    double widest = 0;
    for (const std::string& label : y_.labels) widest = std::max(widest, text_width(label));
    return widest;
  }
  void draw(const Frame& frame, bool with_x_label, std::vector<Mark>& marks) {
    frame_ = frame;
    grid(marks);
    for (const FigureBand& band : panel_.bands) draw_band(band, marks);
    for (const FigureCurve& curve : panel_.curves)
      if (curve.points) draw_points(curve, marks);
    for (const FigureCurve& curve : panel_.curves)
      if (!curve.points) draw_line(curve, marks);
    edges(with_x_label, marks);
  }

 private:
  double across(double x) const {
    return frame_.left + (x - x_.low) / (x_.high - x_.low) * (frame_.right - frame_.left);
  }
  double up(double y) const {
    return frame_.bottom - (y - y_.low) / (y_.high - y_.low) * (frame_.bottom - frame_.top);
  }

  void grid(std::vector<Mark>& marks) const {
    for (const double y : y_.ticks)
      marks.push_back(line_through({{frame_.left, up(y)}, {frame_.right, up(y)}}, {pale, 0.4, {}}, "grid"));
    if (panel_.through_zero)
      marks.push_back(line_through({{frame_.left, up(0)}, {frame_.right, up(0)}}, {ink, 0.4, {}}, "zero"));
  }

  void edges(bool with_x_label, std::vector<Mark>& marks) const {
    const Style style{ink, 0.6, {}};
    marks.push_back(
        line_through({{frame_.left, frame_.top}, {frame_.left, frame_.bottom}, {frame_.right, frame_.bottom}},
                     style, "axis"));
    constexpr double tick = 3, gap = 2, under = 0.36 * letter_size;
    for (std::size_t i = 0; i < x_.ticks.size(); ++i) {
      const double x = across(x_.ticks[i]);
      marks.push_back(line_through({{x, frame_.bottom}, {x, frame_.bottom + tick}}, style, "axis"));
      marks.push_back(
          text_at(x, frame_.bottom + tick + gap + letter_size * 0.8, x_.labels[i], Anchor::middle, "x_tick"));
    }
    for (std::size_t i = 0; i < y_.ticks.size(); ++i) {
      const double y = up(y_.ticks[i]);
      marks.push_back(line_through({{frame_.left - tick, y}, {frame_.left, y}}, style, "axis"));
      marks.push_back(text_at(frame_.left - tick - gap, y + under, y_.labels[i], Anchor::end, "y_tick"));
    }
    if (with_x_label)
      marks.push_back(text_at((frame_.left + frame_.right) / 2,
                              frame_.bottom + tick + gap + 2.1 * letter_size, panel_.x_label, Anchor::middle,
                              "x_label"));
    Mark label = text_at(frame_.left - tick - 2 * gap - label_width() - 0.3 * letter_size,
                         (frame_.top + frame_.bottom) / 2, panel_.y_label, Anchor::middle, "y_label");
    label.turned = true;
    marks.push_back(std::move(label));
    if (!panel_.title.empty())
      marks.push_back(text_at(frame_.left, frame_.top - 3, panel_.title, Anchor::start, "title"));
  }

  /// Hands each stretch without a gap on.
  template <class Use>
  void stretches(const std::vector<double>& x, const std::vector<double>& y, Use&& use) const {
    std::vector<DrawnPoint> points;
    for (std::size_t i = 0; i <= x.size(); ++i) {
      if (i < x.size() && std::isfinite(x[i]) && std::isfinite(y[i])) {
        points.push_back({across(x[i]), up(y[i])});
      } else if (!points.empty()) {
        use(std::move(points));
        points.clear();
      }
    }
  }

  void draw_band(const FigureBand& band, std::vector<Mark>& marks) const {
    std::vector<double> x = band.x, low = band.low, also = band.x, high = band.high;
    smooth(x, low), smooth(also, high);
    std::vector<std::vector<DrawnPoint>> below;
    stretches(x, low, [&](std::vector<DrawnPoint> points) { below.push_back(std::move(points)); });
    std::size_t k = 0;
    stretches(also, high, [&](std::vector<DrawnPoint> points) {
      if (k >= below.size()) return;
      points.insert(points.end(), below[k].rbegin(), below[k].rend());
      ++k;
      marks.push_back(area_within(std::move(points), style_of(Look::model).colour, band_opacity, "band"));
    });
  }

  void draw_line(const FigureCurve& curve, std::vector<Mark>& marks) const {
    std::vector<double> x = curve.x, y = curve.y;
    smooth(x, y);
    stretches(x, y, [&](std::vector<DrawnPoint> points) {
      marks.push_back(line_through(std::move(points), style_of(curve.look), name_of(curve.look)));
    });
  }

  void draw_points(const FigureCurve& curve, std::vector<Mark>& marks) const {
    Mark dots = line_through({}, style_of(curve.look), name_of(curve.look));
    dots.kind = Mark::Kind::dots;
    constexpr std::size_t few = 50, some = 400;
    dots.width = curve.x.size() > some ? 1.0 : curve.x.size() > few ? 1.6 : 2.6;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
      const double x = across(curve.x[i]);
      dots.points.push_back({x, up(curve.y[i])});
      if (i < curve.errors.size() && curve.errors[i] > 0)
        marks.push_back(
            line_through({{x, up(curve.y[i] - curve.errors[i])}, {x, up(curve.y[i] + curve.errors[i])}},
                         {style_of(curve.look).colour, 0.6, {}}, "error"));
    }
    marks.push_back(std::move(dots));
  }

  const Panel& panel_;
  Axis x_, y_;
  Frame frame_;
};

std::vector<Entry> entries_of(const Panel& panel) {
  std::vector<Entry> entries;
  for (const FigureCurve& curve : panel.curves) {
    if (curve.name.empty()) continue;
    Mark mark = line_through({{0, 0}, {sample_width, 0}}, style_of(curve.look), "legend");
    if (curve.points) mark.kind = Mark::Kind::dots, mark.width = 2.6, mark.points = {{sample_width / 2, 0}};
    entries.push_back({curve.name, {std::move(mark)}});
  }
  for (const FigureBand& band : panel.bands)
    if (!band.name.empty())
      entries.push_back({band.name,
                         {area_within({{0, -3}, {sample_width, -3}, {sample_width, 3}, {0, 3}},
                                      style_of(Look::model).colour, band_opacity, "legend")}});
  return entries;
}

Drawing drawn_curves(const Figure& figure, double width, std::size_t columns) {
  Drawing drawing{width, 0, {}};
  const std::size_t count = figure.panels.size();
  const bool alone = count == 1, titled = !figure.panels.front().title.empty();
  const double each = width / static_cast<double>(columns), high = (alone ? 52 : 36) * points_per_mm;
  constexpr double end = 10;
  std::vector<Plot> plots;
  double margin = 0;
  for (const Panel& panel : figure.panels) {
    plots.emplace_back(panel, static_cast<int>(each / 45), static_cast<int>(high / 28));
    margin = std::max(margin, plots.back().label_width());
  }
  margin += 9 + 1.5 * letter_size;
  double y = add_legend(entries_of(figure.panels.front()), margin, width - end, drawing.marks) + 4;
  for (std::size_t i = 0; i < count; i += columns) {
    y += titled ? row : 0;
    const bool last = i + columns >= count;
    for (std::size_t k = i; k < std::min(count, i + columns); ++k) {
      const double left = each * static_cast<double>(k - i);
      plots[k].draw({left + margin, y, left + each - end, y + high}, last || k + columns >= count,
                    drawing.marks);
    }
    y += high + 5 + (last ? 2.7 : 2.3) * letter_size;
  }
  drawing.height = y;
  return drawing;
}

}  // namespace

Drawing drawn(const Figure& figure, Width width) {
  const double wide = (width == Width::column ? 85 : 180) * points_per_mm;
  if (!figure.panels.front().bars.empty()) return drawn_bars(figure, wide);
  const bool two = width == Width::page && figure.panels.size() > 1;
  return drawn_curves(figure, wide, two ? 2 : 1);
}

}  // namespace shakedown
