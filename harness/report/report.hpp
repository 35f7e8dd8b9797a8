// SPDX-License-Identifier: MIT
// A report as plain data: what is said, in which order, with the numbers behind every picture. A command
// fills it in; write_report() makes one HTML file of it that needs nothing else: no network, no server, no
// other file.
#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "report_knobs.hpp"

namespace shakedown {

/// How a sentence, a fact or a bar is meant; shown by a word and a mark, not by colour alone.
enum class Tone { plain, good, bad, unsure };

/// How a curve is drawn. A band is a pair: band_low followed by band_high.
enum class CurveRole { measured, model, as_given, band_low, band_high, other, points };

struct ReportCurve {
  std::string name;  ///< "measured"
  CurveRole role = CurveRole::other;
  std::vector<double> y;  ///< in the plot's unit; NaN: a gap
};

struct ReportPlot {
  std::string title, caption;
  std::string x_label, y_label;  ///< with the unit: "time, s"
  /// Plots of one section with different groups (a box length, a run) are shown one group at a time; all
  /// sections switch together.
  std::string group;
  bool over_time =
      false;  ///< x is the time of a run, s: the cursor is shared with the other plots and with the replay
  double level = std::numeric_limits<double>::quiet_NaN();  ///< draws +-level as a tolerance (for residuals
                                                            ///< in units of their spread)
  bool logarithmic_y = false;
  std::vector<double> x;
  std::vector<ReportCurve> curves;
  /// Upright dashed lines with a word.
  struct Mark {
    double x = 0;
    std::string label;
  };
  std::vector<Mark> marks;
};

struct ReportTable {
  std::string title, caption;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  bool folded = false;  ///< opened by a click
};

/// Horizontal bars with several values a line, e.g. training and held-out error of each step of a ladder.
struct ReportBars {
  std::string title, caption, unit;
  std::vector<std::string> names;  ///< of the values of a line
  struct Line {
    std::string label, note;
    std::vector<double> values;    ///< NaN: none
    std::vector<double> errors{};  ///< standard errors; may be empty
    Tone tone = Tone::plain;       ///< unsure: striped, not told from the others that are
  };
  std::vector<Line> lines;
  double floor = std::numeric_limits<double>::quiet_NaN();  ///< drawn as a line, e.g. the noise floor
  std::string floor_name;
};

/// Where something fails: a row a run, a column a time.
struct ReportStrip {
  std::string title, caption, x_label;
  std::string value_name;     ///< "units of the expected spread"
  std::vector<double> edges;  ///< of the columns, ascending, one more than values
  struct Row {
    std::string name;
    std::string group;           ///< a click shows this group at that time
    std::vector<double> values;  ///< NaN: nothing there
  };
  std::vector<Row> rows;
  double top = 5;  ///< value of the strongest colour
};

/// A number with its interval.
struct ReportInterval {
  std::string name, unit, word;  ///< word: a value that is no number (a packing)
  double value = 0, low = std::numeric_limits<double>::quiet_NaN(),
         high = std::numeric_limits<double>::quiet_NaN();
  double given = std::numeric_limits<double>::quiet_NaN();  ///< what the setup said before
  /// What was known before anything was measured; NaN: nothing was.
  double known_low = std::numeric_limits<double>::quiet_NaN(),
         known_high = std::numeric_limits<double>::quiet_NaN();
};

struct ReportSection {
  std::string title;
  std::vector<std::string> paragraphs;
  std::vector<ReportPlot> plots;
  std::vector<ReportStrip> strips;
  std::vector<ReportBars> bars;
  std::vector<ReportInterval> intervals;
  std::vector<ReportTable> tables;
  std::vector<std::string> list;
  bool folded = false;  ///< opened by a click
};

struct ReportFact {
  std::string label, value, note;
  Tone tone = Tone::plain;
};

/// The motion of grains and box, as points between which everything flies straight.
struct ReportReplay {
  std::string group, title, caption;
  double length = 0, width = 0, height = 0;  ///< m, inner box along x, y, z
  double duration = 0;                       ///< s
  double tolerance = 0;                      ///< m, how far a drawn grain is from the simulated one at most
  double exact_from = 0, exact_to = 0;       ///< s, interval in which every impact is kept
  std::vector<double> radius;                ///< m, one a grain
  struct Track {
    std::vector<double> time, x, y, z;  ///< s, m (lab)
    std::vector<std::uint8_t>
        contact;  ///< class of the impact there: 0 grain-grain, 1 end wall, 2 side wall, 3 none
  };
  std::vector<Track> grains;
  Track box;                                          ///< centre of the box
  std::vector<double> measured_time, measured_x_box;  ///< s, m; may be empty
};

struct Report {
  std::string kind;  ///< "diagnose", "compare", "run" ...
  std::string title, subtitle;
  std::string verdict;   ///< one word or two: "missing effect"
  std::string sentence;  ///< the verdict in a sentence
  Tone tone = Tone::plain;
  std::vector<ReportFact> facts;       ///< a few key numbers
  std::vector<ReportSection> opening;  ///< what is answered, before anything is shown
  ReportKnobs knobs;
  std::vector<ReportReplay> replays;
  std::vector<ReportSection> sections;
  std::string command;                 ///< that makes it again
  std::string setup;                   ///< as used, TOML
  std::string program;                 ///< version line
  std::vector<std::string> health;     ///< how well the engines kept their promises, a line each
  std::vector<std::string> citations;  ///< of the effects used
};

/// Returns the page. Everything in it comes from the report; texts are escaped.
std::string report_html(const Report& report);

/// Writes the page. Throws FileError.
void write_report(const std::filesystem::path& file, const Report& report);

/// Commands keep the report as JSON text in folders of results, in a file of this name. report_json() writes
/// the text and read_report() reads the file; it throws FileError.
constexpr const char* report_file_name = "report.json";
std::string report_json(const Report& report);
Report read_report(std::filesystem::path file);

}  // namespace shakedown
