// SPDX-License-Identifier: MIT
// The page holds everything and loads nothing; a report read back from its file is the same.
#include "report.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "diagnose_report.hpp"
#include "engines.hpp"
#include "errors.hpp"
#include "measured_against_model.hpp"
#include "output_file.hpp"
#include "packed_numbers.hpp"
#include "packed_replay.hpp"
#include "paper_report.hpp"
#include "report_joined.hpp"
#include "report_parts.hpp"
#include "scratch_folder.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

Report small_report() {
  Report report;
  report.kind = "test";
  report.title = "<script>alert(1)</script> & \"quotes\"";
  report.sentence = "A sentence </h1> with a trap.";
  report.tone = Tone::bad;
  report.verdict = "missing";
  ReportSection section;
  section.title = "Curves";
  ReportPlot plot;
  plot.title = "Box";
  plot.group = "L040";
  plot.over_time = true;
  plot.x = {0, 0.1, 0.2};
  plot.curves = {{"measured </script>", CurveRole::measured, {1, std::nan(""), -2.5}}};
  section.plots = {plot};
  section.strips = {{"strip", "", "s", "sigma", {0, 1, 2}, {{"L040", "L040", {1, std::nan("")}}}}};
  section.bars = {{"ladder", "", "mm", {"a", "b"}, {{"as given", "p = 0", {3, std::nan("")}}}, 0.3, "floor"}};
  section.intervals = {{"restitution", "", "", 0.75, 0.7, 0.8, 0.76}};
  report.sections = {section};
  report.command = "shakedown <x>";
  return report;
}

std::string inflated(const std::string& bytes) {
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  std::string out(1 << 20, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  inflateEnd(&stream);
  return out;
}

}  // namespace

TEST(Report, PageForbidsTheNetworkAndNamesNoOtherFile) {
  const std::string html = report_html(small_report());
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  for (const char* reference :
       {"src=\"", "src='", "url(", "@import", "href=\"http", "fetch(", "XMLHttpRequest", "WebSocket"})
    EXPECT_EQ(html.find(reference), std::string::npos) << reference;
}

TEST(Report, PageEscapesWhatItIsGiven) {
  const std::string html = report_html(small_report());
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("</h1> with"), std::string::npos);
  EXPECT_EQ(html.find("measured </script>"), std::string::npos);
}

TEST(Report, SameReportSameBytes) { EXPECT_EQ(report_html(small_report()), report_html(small_report())); }

TEST(Report, SurvivesItsFile) {
  const ScratchFolder folder;
  const Report report = small_report();
  write_file(folder / report_file_name, report_json(report));
  EXPECT_EQ(report_html(read_report(folder.path())), report_html(report));
  write_file(folder / "other.json", "{\"schema_version\": 99}");
  EXPECT_THROW(read_report(folder / "other.json"), FileError);
  write_file(folder / "other.json", "nonsense");
  EXPECT_THROW(read_report(folder / "other.json"), FileError);
  EXPECT_THROW(read_report(folder / "missing.json"), FileError);
}

TEST(Report, DamagedFilesAreNamed) {
  const ScratchFolder folder;
  const auto complaint = [&](const std::function<void(Report&)>& damage) -> std::string {
    Report report = small_report();
    damage(report);
    write_file(folder / report_file_name, report_json(report));
    try {
      report_html(read_report(folder.path()));
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint([](Report&) {}), "");
  const std::vector<std::function<void(Report&)>> damages{
      [](Report& r) { r.sections[0].plots[0].curves[0].y.pop_back(); },
      [](Report& r) { r.sections[0].plots[0].curves[0].role = static_cast<CurveRole>(99); },
      [](Report& r) { r.sections[0].strips[0].rows[0].values.clear(); },
      [](Report& r) { r.tone = static_cast<Tone>(-3); },
      [](Report& r) { r.replays.emplace_back().radius = {0.005}; },
      [](Report& r) {
        r.replays.emplace_back().box.time = {0, 1};
      }};
  for (const auto& damage : damages)
    EXPECT_NE(complaint(damage).find("report.json: is damaged"), std::string::npos) << &damage - &damages[0];
}

TEST(Report, SeveralAreJoinedWithoutMixingTheirRuns) {
  const Report all = joined({{"a", small_report()}, {"b", small_report()}});
  ASSERT_EQ(all.sections.size(), 3u);
  EXPECT_EQ(all.sections[1].plots[0].group, "a: L040");
  EXPECT_EQ(all.sections[2].strips[0].rows[0].group, "b: L040");
}

// A camera may be wrong about the grains and right about the box.
TEST(Report, ShowsWhereTheGrainsCentreFailsWhereItWasSeen) {
  MeasuredAgainstModel run;
  run.run = "L040";
  for (int i = 0; i < 50; ++i) run.time.push_back(0.02 * i);
  const std::vector<double> still(50, 0.0), off(50, 2e-3), four(50, 4.0);
  run.box = still;
  run.centre = off;
  run.box_residual = run.given_box_residual = run.centre_residual = still;
  run.given_centre_residual = four;
  for (ModelMotion* model : {&run.as_given, &run.final_model}) {
    model->runs = 1;
    model->box = model->centre = {still, still};
  }
  const ReportSection curves = curves_section({run}, "curves"), failures = failure_section({run});
  ASSERT_EQ(curves.plots.size(), 5u);
  EXPECT_EQ(curves.plots[4].title, "Error of the centre of the grains");
  EXPECT_EQ(curves.plots[4].curves.back().y, std::vector<double>(50, 2.0));  // mm
  ASSERT_EQ(failures.strips.size(), 4u);
  EXPECT_EQ(failures.strips[2].title, "The centre of the grains by time and run: as given");
  for (const double value : failures.strips[2].rows[0].values) EXPECT_EQ(value, 4);
  for (const std::size_t strip : {0, 1, 3})
    for (const double value : failures.strips[strip].rows[0].values) EXPECT_EQ(value, 0);

  run.centre.assign(50, std::nan(""));
  EXPECT_EQ(curves_section({run}, "curves").plots.size(), 3u);
  EXPECT_EQ(failure_section({run}).strips.size(), 2u);
}

// An empty box has no p-value and no length left out; nothing is said of what there is not.
TEST(Report, OfADiagnosisAnswersFirstAndSaysNoMoreThanThereIs) {
  Diagnosis d;
  d.verdict = Verdict::missing;
  d.sentence = "Missing in the model: something.";
  d.missing = {"clamp_dry_friction"};
  d.hypotheses = d.answers = {{{"clamp_dry_friction"}, 0, 0.6}, {{"blade_viscous_damping"}, 0, 0.37}};
  d.judgement.reason = "holds: the box is left 1 times noise and spread";
  d.parameters = {{"clamp_dry_friction.force", 8e-3, 7.9e-3, 8.1e-3, "N", ""}};
  d.camera = {{"camera_origin.origin of a", "m", 1e-3, 2e-4, 1e-4}};
  d.left = {{"box", 1e-4, 1e-4, std::nan(""), 0.1, ""}};
  LadderStep step;
  step.error_box = 1e-4, step.floor_box = 1e-4;
  step.p_value = step.scatter = step.held_out_error_box = std::nan("");
  d.ladder = {step, step};
  const Report report = report_of(d, Measurement{}, shakedown::Setup{}, {});
  ASSERT_EQ(report.opening.size(), 4u);
  EXPECT_EQ(report.opening[0].bars[0].lines[0].tone, Tone::unsure);
  EXPECT_EQ(report.opening[1].intervals[0].unit, "mN");
  EXPECT_DOUBLE_EQ(report.opening[1].intervals[0].value, 8);
  EXPECT_EQ(report.opening[2].tables[0].rows[0][2], "0.100");  // per cent of the swing
  EXPECT_EQ(report.opening[3].intervals[0].name, "origin of the recorded positions of a");
  const std::string html = report_html(report);
  const std::string body = html.substr(html.find("<main>"), html.find("<script type") - html.find("<main>"));
  for (const char* nothing : {"nan", "inf ", "no number", "p = –"})
    EXPECT_EQ(body.find(nothing), std::string::npos) << nothing;
  EXPECT_LT(body.find("What is missing"), body.find("How the error fell"));
}

// Each line of an energy plot is a share of one whole.
TEST(Report, EnergiesAddUp) {
  const ReportPlot plot = energy_plot("", {0, 1}, {10, 4}, {std::vector<double>{0, 1}, {0, 2}, {0, 0}});
  ASSERT_EQ(plot.curves.size(), 4u);  // nothing was lost at side walls
  EXPECT_EQ(plot.curves.back().name, "taken by effects");
  EXPECT_EQ(plot.curves.back().y, (std::vector<double>{0, 3}));
  EXPECT_EQ(energy_plot("", {0, 1}, {10, 7}, {std::vector<double>{0, 1}, {0, 2}, {0, 0}}).curves.size(), 3u);
}

TEST(Report, NumbersOfAnySizeArePacked) {
  for (const double size : {5e-324, 1e308}) {
    const PackedNumbers numbers = packed({size, -size, 0.0, size});
    ASSERT_EQ(numbers.steps.size(), 4u);
    for (const std::optional<std::int64_t>& step : numbers.steps) EXPECT_LE(std::abs(*step), 0x1p62);
  }
  ReportReplay replay;
  replay.box.time = {0, 1e300, 1e300};
  replay.box.x = replay.box.y = replay.box.z = {1e300, -1e300, 0};
  EXPECT_LT(packed(replay).bytes.size(), 200u);
}

TEST(PackedNumbers, KeepFourDigitsOfTheLargestAndTheGaps) {
  const std::vector<double> values{104.123, std::nan(""), -99.5, 0.01, 0};
  const PackedNumbers numbers = packed(values);
  const double quantum = numbers.quantum;
  EXPECT_LE(quantum, 104.123 / 40000);
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(!numbers.steps[i].has_value(), std::isnan(values[i]));
    if (std::isnan(values[i])) continue;
    sum += static_cast<double>(*numbers.steps[i]);
    WITHIN((sum * quantum - values[i]) / quantum, 0, 0.5001, 0.5);
  }
}

TEST(PackedNumbers, GzipIsGzip) {
  const std::string text = "the same, the same, the same";
  EXPECT_EQ(inflated(gzip(text)), text);
  EXPECT_EQ(base64("Man"), "TWFu");
  EXPECT_EQ(base64("Ma"), "TWE=");
  EXPECT_EQ(base64("M"), "TQ==");
}

TEST(Report, ThePaperIsShownWithItsFiguresAndGrains) {
  Paper paper;
  shakedown::Setup setup;
  setup.run.duration = 1;
  paper.runs.hard = {damper_runs(*engine_named("hard"), setup, {2, 1})};
  paper.statements = {
      {"a", "A < B", "1", "A is below B", {exact("A", 0.5, "mm")}, Judgement::fails, "A plain remark."}};
  const std::vector<double> time{0, 1, 2};
  paper.charts = {{"comp1_L40",
                   "Box",
                   {{"t, s", "x_box, mm", {{"one", time, {1, 2, 3}}, {"line", {0, 2}, {1, 3}, true}}}}},
                  {"optimalLSweep",
                   "Sweep",
                   {{"L, mm",
                     "time, s",
                     {{"95 %", time, {3, 2, 1}}, {"censored", {1.5}, {60}, false, true}},
                     {{1.2, "L_opt"}}}}}};
  paper.runs.puzzle.models = {{"one", {"L065"}, {1e-3}, {2e-3}}};
  const Report report = report_of(paper);
  EXPECT_EQ(report.replays.size(), 1u);
  ASSERT_EQ(report.sections.front().plots.size(), 1u);
  // a line between its ends
  EXPECT_EQ(report.sections.front().plots[0].curves[1].y, (std::vector<double>{1, 2, 3}));
  const ReportPlot& sweep = report.sections.back().plots.front();
  ASSERT_EQ(sweep.x.size(), 4u);
  EXPECT_TRUE(std::isnan(sweep.curves[1].y[1]));
  EXPECT_EQ(sweep.curves[1].y[2], 60);
  EXPECT_EQ(sweep.marks.size(), 1u);
  EXPECT_NE(report_html(report).find("A &lt; B"), std::string::npos);
}
