// SPDX-License-Identifier: MIT
// Figures for papers: numbers lie where the axes say, axes carry units, files are whole.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "drawing.hpp"
#include "drawn_figure.hpp"
#include "errors.hpp"
#include "output_file.hpp"
#include "result_figures.hpp"
#include "scratch_folder.hpp"
#include "within.hpp"

using namespace shakedown;
using nlohmann::json;

namespace {

/// A swing of two runs as a comparison tells it, its model 1 mm above what was measured.
json compared() {
  json curves = json::array();
  for (const char* run : {"L040", "L065"}) {
    json curve{{"run", run}, {"observable", "box"}};
    for (int i = 0; i <= 40; ++i) {
      const double t = 0.1 * i, x = 100 * std::cos(6 * t);
      curve["time_s"].push_back(t);
      curve["measured_mm"].push_back(i == 7 ? json(nullptr) : json(x));
      curve["model_mm"].push_back(x + 1);
      curve["as_given_mm"].push_back(x + 20);
      curve["residual_mm"].push_back(i == 7 ? json(nullptr) : json(-1));
      curve["spread_mm"].push_back(0.5);
    }
    curves.push_back(curve);
  }
  return {{"schema_version", 1}, {"curves", curves}};
}

json diagnosed() {
  return {{"hypotheses",
           {{{"effects", {"clamp_dry_friction"}}, {"probability", 0.7}},
            {{"effects", {"unknown"}}, {"probability", 0.296}},
            {{"effects", json::array()}, {"probability", 0.004}}}},
          {"answer_set",
           {{{"effects", {"clamp_dry_friction"}}, {"probability", 0.7}},
            {{"effects", {"unknown"}}, {"probability", 0.296}}}},
          {"ladder",
           {{{"step", "as given"}, {"error_box_mm", 8.0}, {"held_out_error_box_mm", nullptr}},
            {{"step", "clamp_dry_friction"}, {"error_box_mm", 1.0}, {"held_out_error_box_mm", 2.0}}}},
          {"noise_floor", {{"box_mm", 0.9}}}};
}

json simulated() {
  json peaks = json::array(), moments = json::array();
  for (int i = 0; i < 10; ++i) {
    peaks.push_back({{"mean", (i % 2 ? 1 : -1) * (100 - 8.0 * i)}, {"sd", 0.5}, {"n", 4}});
    moments.push_back({{"mean", i + 0.5}, {"sd", 0.1}, {"n", 4}});
  }
  return {{"peaks_mm", peaks},
          {"peak_times_s", moments},
          {"decay",
           {{"peaks", 8},
            {"linear", {{"intercept_mm", 104}, {"slope_mm_per_s", -8}}},
            {"exponential", {{"amplitude_mm", 110}, {"rate_per_s", 0.1}}}}},
          {"energy_loss", {{"grain_grain", 0.5}, {"end_wall", 0.3}, {"side_wall", 0.1}}},
          {"effect_energy_loss", {{"clamp_dry_friction", 0.05}}}};
}

class Figures : public testing::Test {
 protected:
  Figure figure(const json& result, const std::string& kind = "", const std::string& run = "") const {
    write_file(folder / "result.json", result.dump());
    return figure_of_result(folder / "result.json", {kind, run, "box"});
  }
  const ScratchFolder folder;
};

/// Every tag is closed in its turn.
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-z?]+)[^<>]*?(/?)>");
  for (std::sregex_iterator at(xml.begin(), xml.end(), tag), end; at != end; ++at) {
    const std::string name = (*at)[2];
    if (name.starts_with("?") || (*at)[3] == "/") continue;
    if ((*at)[1] == "/") {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
    } else {
      open.push_back(name);
    }
  }
  return open.empty();
}

/// The line through the words at an axis: value against place.
struct Scale {
  double value = 0, place = 0, by_place = 0;
  double at(double where) const { return value + (where - place) * by_place; }
};
Scale scale_of(const Drawing& drawing, const std::string& what, bool upright) {
  std::vector<std::pair<double, double>> ticks;
  for (const Mark& mark : drawing.marks)
    if (mark.what == what) {
      std::string number = mark.text;
      if (number.starts_with("\u2212")) number = "-" + number.substr(3);
      ticks.emplace_back(upright ? mark.points[0].y : mark.points[0].x, std::stod(number));
    }
  EXPECT_GE(ticks.size(), 3u);
  const auto& [first, low] = ticks.front();
  const auto& [last, high] = ticks.back();
  // Words at an upright axis stand lower than their tick by a share of a letter.
  const double lower = upright ? 0.36 * letter_size : 0;
  return {low, first - lower, (high - low) / (last - first)};
}

std::vector<const Mark*> marks_of(const Drawing& drawing, const std::string& what) {
  std::vector<const Mark*> found;
  for (const Mark& mark : drawing.marks)
    if (mark.what == what) found.push_back(&mark);
  return found;
}

bool says(const Drawing& drawing, const std::string& words) {
  return std::any_of(drawing.marks.begin(), drawing.marks.end(),
                     [&](const Mark& mark) { return mark.text == words; });
}

}  // namespace

TEST_F(Figures, NumbersLieWhereTheAxesSay) {
  const Drawing drawing = drawn(figure(compared(), "decay", "L040"), Width::column);
  const Scale time = scale_of(drawing, "x_tick", false), place = scale_of(drawing, "y_tick", true);
  const std::vector<const Mark*> models = marks_of(drawing, "model"), dots = marks_of(drawing, "measured");
  ASSERT_EQ(models.size(), 1u);
  const std::vector<DrawnPoint>& model = models[0]->points;
  WITHIN(time.at(model.front().x), 0, 1e-14, 8.9e-16);
  WITHIN(place.at(model.front().y), 101, 4e-13, 2.3e-14);
  WITHIN(time.at(model.back().x), 4, 1e-14, 8.9e-16);
  WITHIN(place.at(model.back().y), 100 * std::cos(24.0) + 1, 1e-13, 9.7e-15);
  // Smooth between the points: of a swing of 100 mm in steps of 0.6 rad.
  double most = 0;
  for (const DrawnPoint& point : model)
    most = std::max(most, std::abs(place.at(point.y) - 1 - 100 * std::cos(6 * time.at(point.x))));
  EXPECT_LT(most, 8);  // 3.6 mm seen, at the ends
  ASSERT_EQ(dots.size(), 1u);
  ASSERT_EQ(dots[0]->points.size(), 40u);  // one was not measured
  WITHIN(place.at(dots[0]->points[3].y), 100 * std::cos(1.8), 3e-13, 1.8e-14);
  EXPECT_TRUE(says(drawing, "time since release, s"));
  EXPECT_TRUE(says(drawing, "position of the box, mm"));
}

TEST_F(Figures, AreAsWideAsAJournalsColumnOrPage) {
  const Figure two = figure(compared(), "residuals");
  const Drawing column = drawn(two, Width::column), page = drawn(two, Width::page);
  WITHIN(column.width, 85 / 25.4 * 72, 1e-12, 5.4e-14);
  WITHIN(page.width, 180 / 25.4 * 72, 2e-12, 1.2e-13);
  EXPECT_LT(page.height, 0.7 * column.height);  // beside each other
  for (const Drawing& drawing : {column, page})
    for (const Mark& mark : drawing.marks)
      for (const DrawnPoint& point : mark.points) {
        EXPECT_GE(point.x, 0);
        EXPECT_LE(point.x, drawing.width);
        EXPECT_GE(point.y, 0);
        EXPECT_LE(point.y, drawing.height);
      }
  EXPECT_TRUE(says(column, "L040"));
  EXPECT_TRUE(says(column, "measured less model, mm"));
}

TEST_F(Figures, BarsAreAsLongAsTheirNumbers) {
  const Drawing chances = drawn(figure(diagnosed()), Width::column);
  const Scale percent = scale_of(chances, "x_tick", false);
  const std::vector<const Mark*> bars = marks_of(chances, "bar");
  ASSERT_EQ(bars.size(), 2u);  // one in two hundred and less is left out
  WITHIN(percent.at(bars[0]->points[1].x), 70, 3e-13, 1.6e-14);
  WITHIN(percent.at(bars[1]->points[1].x), 29.6, 1e-13, 6.6e-15);
  EXPECT_TRUE(says(chances, "something in no list"));
  EXPECT_TRUE(says(chances, "not told apart"));

  const Drawing ladder = drawn(figure(diagnosed(), "ladder"), Width::column);
  const Scale error = scale_of(ladder, "x_tick", false);
  WITHIN(error.at(marks_of(ladder, "bar")[0]->points[1].x), 8, 3e-14, 1.8e-15);
  WITHIN(error.at(marks_of(ladder, "second")[0]->points[1].x), 2, 9e-15, 4.5e-16);
  WITHIN(error.at(marks_of(ladder, "floor")[0]->points[0].x), 0.9, 4e-15, 2e-16);
  EXPECT_TRUE(says(ladder, "error of the box, mm (rms)"));
}

TEST_F(Figures, PeaksHaveTheirLineAndTheirExponential) {
  const Drawing drawing = drawn(figure(simulated()), Width::column);
  const Scale time = scale_of(drawing, "x_tick", false), height = scale_of(drawing, "y_tick", true);
  const std::vector<DrawnPoint>& peaks = marks_of(drawing, "measured")[0]->points;
  WITHIN(height.at(peaks[2].y), 84, 5e-13, 2.9e-14);
  const DrawnPoint end = marks_of(drawing, "model")[0]->points.back();
  WITHIN(time.at(end.x), 7.5, 3e-14, 1.7e-15);
  WITHIN(height.at(end.y), 44, 5e-13, 2.9e-14);
  const Drawing energy = drawn(figure(simulated(), "energy"), Width::column);
  EXPECT_TRUE(says(energy, "share of the energy at release, %"));
  const Scale percent = scale_of(energy, "x_tick", false);
  WITHIN(percent.at(marks_of(energy, "bar").back()->points[1].x), 5, 2e-14, 1.2e-15);
}

TEST_F(Figures, FilesAreWhole) {
  json named = diagnosed();
  named["ladder"][1]["step"] = "a < b & \"c\"";
  for (const Figure& one : {figure(compared()), figure(compared(), "residuals", "L065"),
                            figure(named, "ladder"), figure(simulated())}) {
    const Drawing drawing = drawn(one, Width::column);
    const std::string svg = svg_of(drawing), pdf = pdf_of(drawing);
    EXPECT_TRUE(is_well_formed(svg)) << svg.substr(0, 400);
    EXPECT_NE(svg.find("width=\"85.00mm\""), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_TRUE(pdf.starts_with("%PDF-1.4"));
    EXPECT_NE(pdf.find("/MediaBox [ 0 0 240.94"), std::string::npos);
    EXPECT_NE(pdf.find("/FontFile"), std::string::npos);  // journals want the font within
    EXPECT_EQ(pdf, pdf_of(drawing));
    // The table of contents of a PDF lies where its end says.
    const std::size_t start = pdf.rfind("startxref");
    ASSERT_NE(start, std::string::npos);
    EXPECT_EQ(pdf.substr(std::stoul(pdf.substr(start + 9)), 4), "xref");
  }
}

TEST_F(Figures, SayWhatAResultHoldsInstead) {
  const auto said = [&](const json& result, const std::string& kind, const std::string& run) {
    try {
      figure(result, kind, run);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(said(compared(), "restitution", "").find("it holds decay, residuals"), std::string::npos);
  EXPECT_NE(said(compared(), "decay", "L1").find("L040, L065"), std::string::npos);
  EXPECT_NE(said(json::array({1}), "", "").find("nothing that can be drawn"), std::string::npos);
  EXPECT_NE(said({{"hypotheses", {{{"effects", 3}}}}}, "", "").find("run its command again"),
            std::string::npos);
}
