// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "output_file.hpp"
#include "packed_json.hpp"
#include "packed_numbers.hpp"
#include "packed_replay.hpp"
#include "page_figures.hpp"
#include "page_files.hpp"
#include "report.hpp"

namespace shakedown {

namespace {

constexpr std::array<const char*, 7> role_names{"measured",  "model", "as_given", "band_low",
                                                "band_high", "other", "points"};

using Json = nlohmann::ordered_json;

/// Returns the sources that the page's policy allows: its scripts by their digests, so that nothing that a
/// report holds can run.
std::string script_sources() {
  std::string sources;
  for (const std::string_view digest : {plot_script_sha256, replay_script_sha256, model_script_sha256,
                                        knobs_script_sha256, figures_script_sha256, page_script_sha256}) {
    std::string bytes;
    for (std::size_t i = 0; i < digest.size(); i += 2)
      bytes += static_cast<char>(std::stoi(std::string(digest.substr(i, 2)), nullptr, 16));
    sources += (sources.empty() ? "'sha256-" : " 'sha256-") + base64(bytes) + "'";
  }
  return sources;
}

Json plot_json(const ReportPlot& plot) {
  Json curves = Json::array(), marks = Json::array();
  for (const ReportCurve& curve : plot.curves)
    curves.push_back({{"n", curve.name},
                      {"r", role_names[static_cast<std::size_t>(curve.role)]},
                      {"y", packed_json(curve.y)}});
  for (const ReportPlot::Mark& mark : plot.marks) marks.push_back(Json::array({mark.x, mark.label}));
  return {{"group", plot.group},
          {"time", plot.over_time},
          {"log", plot.logarithmic_y},
          {"level", std::isfinite(plot.level) ? Json(plot.level) : Json(nullptr)},
          {"xl", plot.x_label},
          {"yl", plot.y_label},
          {"x", packed_json(plot.x)},
          {"curves", curves},
          {"marks", marks}};
}

/// Splits a text into its first sentence and what follows it.
std::pair<std::string, std::string> first_sentence(const std::string& text) {
  for (std::size_t i = text.find(". "); i != std::string::npos; i = text.find(". ", i + 1))
    if (i + 2 < text.size() && std::isupper(static_cast<unsigned char>(text[i + 2])))
      return {text.substr(0, i + 1), text.substr(i + 2)};
  return {text, ""};
}

double top_speed(const ReportReplay& replay) {
  double top = 0;
  const ReportReplay::Track& box = replay.box;
  for (std::size_t i = 1; i < box.time.size(); ++i)
    if (box.time[i] > box.time[i - 1])
      top = std::max(top, std::abs(box.x[i] - box.x[i - 1]) / (box.time[i] - box.time[i - 1]));
  return top > 0 ? top : 1;
}

/// Returns how far from the middle anything gets, m.
double reach(const ReportReplay& replay) {
  double far = 0;
  for (const double x : replay.box.x) far = std::max(far, std::abs(x));
  for (const double x : replay.measured_x_box)
    if (std::isfinite(x)) far = std::max(far, std::abs(x));
  return far + replay.length / 2 + 0.1 * replay.length;
}

Json replay_json(const ReportReplay& replay, const PackedReplay& units) {
  Json points = Json::array();
  for (const ReportReplay::Track& track : replay.grains) points.push_back(track.time.size());
  points.push_back(replay.box.time.size());
  return {
      {"group", replay.group},
      {"length", replay.length},
      {"width", replay.width},
      {"height", replay.height},
      {"duration", replay.duration},
      {"from", replay.exact_from},
      {"tq", units.time_unit},
      {"xq", units.length_unit},
      {"reach", reach(replay)},
      {"top_speed", top_speed(replay)},
      {"radius", replay.radius},
      {"points", points},
      {"measured", {{"t", packed_json(replay.measured_time)}, {"x", packed_json(replay.measured_x_box)}}}};
}

/// Writes the page and numbers its plots as they come, so that page and data agree.
class Page {
 public:
  explicit Page(const Report& report) : report_(report) {}

  std::string body() {
    std::string text = header();
    for (const ReportSection& one : report_.opening) text += section(one, "answer");
    text += tools() + knobs() + stage();
    for (std::size_t s = 1; s < report_.sections.size(); ++s) text += section(report_.sections[s], "");
    return text + reproduce();
  }
  std::string data() const {
    Json replays = Json::array();
    for (const ReportReplay& replay : report_.replays) replays.push_back(replay_json(replay, packed(replay)));
    return Json{{"plots", plots_}, {"replays", replays}}.dump();
  }

 private:
  std::string header() const {
    std::string text = "<header><p class=\"kicker\"><b>shakedown " + escaped(report_.kind) + "</b><span>" +
                       escaped(report_.title) + "</span></p>";
    if (!report_.verdict.empty())
      text += fmt::format("<p class=\"ui\"><span class=\"verdict {}\">{}</span></p>", css_class(report_.tone),
                          escaped(report_.verdict));
    const auto [first, rest] = first_sentence(report_.sentence.empty() ? report_.title : report_.sentence);
    text += (first.size() > 70 ? "<h1 class=\"long\">" : "<h1>") + escaped(first) + "</h1>";
    if (!rest.empty()) text += "<p class=\"lead\">" + escaped(rest) + "</p>";
    if (!report_.subtitle.empty()) text += "<p class=\"subtitle\">" + escaped(report_.subtitle) + "</p>";
    text += "</header>";
    if (report_.facts.empty()) return text;
    text += "<dl class=\"facts\">";
    for (const ReportFact& fact : report_.facts)
      text +=
          fmt::format("<div class=\"fact\"><dt>{}</dt><dd>{}<small{}>{}</small></dd></div>",
                      escaped(fact.label), escaped(fact.value),
                      fact.tone == Tone::plain ? "" : fmt::format(" class=\"mark {}\"", css_class(fact.tone)),
                      escaped(fact.note));
    return text + "</dl>";
  }

  std::vector<std::string> groups() const {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (const ReportReplay& replay : report_.replays) add(replay.group);
    for (const ReportSection& section : report_.sections)
      for (const ReportPlot& plot : section.plots) add(plot.group);
    return names;
  }

  std::string tools() const {
    const std::vector<std::string> names = groups();
    std::string text =
        fmt::format("<nav class=\"tools{}\" aria-label=\"View\">", names.size() > 1 ? "" : " bare");
    if (!names.empty()) {
      text += fmt::format("<div class=\"tabs{}\" role=\"tablist\" aria-label=\"Run\">",
                          names.size() > 1 ? "" : " hidden");
      for (std::size_t i = 0; i < names.size(); ++i)
        text += fmt::format(
            "<button role=\"tab\" data-tab=\"{0}\" aria-selected=\"{1}\" tabindex=\"{2}\">{0}</button>",
            escaped(names[i]), i == 0, i == 0 ? 0 : -1);
      text += "</div>";
    }
    return text +
           "<span class=\"spring\"></span><button id=\"theme\" type=\"button\">Light or dark</button></nav>";
  }

  std::string knobs() const {
    if (report_.knobs.kind.empty()) return "";
    return "<section><h2>Turn the numbers</h2><p>" + escaped(report_.knobs.note) +
           "</p><div data-knobs></div></section>";
  }

  /// Returns the replay and, beside it, the first section.
  std::string stage() {
    if (report_.sections.empty() && report_.replays.empty()) return "";
    const std::string plots = report_.sections.empty() ? "" : section(report_.sections[0], "stage-text");
    if (report_.replays.empty()) return plots;
    std::string text = "<div class=\"stage\">" + plots + "<div class=\"replay\">";
    for (std::size_t i = 0; i < report_.replays.size(); ++i) text += replay(report_.replays[i], i);
    return text + "</div></div>";
  }

  static std::string replay(const ReportReplay& replay, std::size_t number) {
    return fmt::format(
        "<section data-group=\"{0}\"><h2>{1}</h2><figure data-replay=\"{2}\"><canvas tabindex=\"0\" "
        "role=\"img\" aria-label=\"Grains in their box; "
        "arrow keys turn the view, space plays\"></canvas><div class=\"controls\"><button type=\"button\" "
        "data-play aria-pressed=\"false\">Play</button>"
        "<input type=\"range\" min=\"0\" max=\"1\" step=\"any\" value=\"0\" aria-label=\"Time\"><output>0 "
        "s</output></div><div class=\"controls\">"
        "<label>Clock <select data-pace><option value=\"1\">as it was</option><option value=\"0.1\">10 times "
        "slower</option><option value=\"0.01\">100 "
        "times slower</option><option value=\"0.001\">1000 times "
        "slower</option></select></label><label>Colour <select data-colour><option "
        "value=\"speed\">speed</option><option value=\"class\">last "
        "collision</option></select></label><label>View <select data-view><option value=\"all\">the whole "
        "way</option><option value=\"box\">with the "
        "box</option></select></label></div><div class=\"scale of-speed\">0 "
        "<span class=\"speed\"></span> {3} m/s and more</div><div class=\"scale of-class hidden\"><b "
        "style=\"background:var(--c0)\"></b> between grains "
        "<b style=\"background:var(--c1)\"></b> end wall <b style=\"background:var(--c2)\"></b> side wall <b "
        "style=\"background:var(--c3)\"></b> none "
        "yet</div><figcaption>{4}</figcaption></figure></section>",
        escaped(replay.group), escaped(replay.title), number, for_people(top_speed(replay)),
        escaped(replay.caption));
  }

  std::string plot(const ReportPlot& plot) {
    const std::size_t number = count_++;
    plots_.push_back(plot_json(plot));
    std::string name = plot.title + (plot.group.empty() ? "" : " " + plot.group);
    for (char& letter : name)
      if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
    std::string text = fmt::format(
        "<figure data-group=\"{}\"><div class=\"figure-head\"><h3>{}</h3><button type=\"button\" "
        "data-csv=\"{}\" data-name=\"{}.csv\">"
        "CSV</button></div><ul class=\"legend\">",
        escaped(plot.group), escaped(plot.title), number, name);
    for (std::size_t k = 0, others = 0; k < plot.curves.size(); ++k) {
      const ReportCurve& curve = plot.curves[k];
      if (curve.role == CurveRole::band_low) continue;
      const bool band = curve.role == CurveRole::band_high;
      text += fmt::format("<li><i class=\"{}\"></i>{}{}</li>",
                          band                             ? "band"
                          : curve.role == CurveRole::other ? fmt::format("other{}", others++ % 4)
                                                           : role_names[static_cast<std::size_t>(curve.role)],
                          escaped(curve.name),
                          band ? "" : fmt::format(" <output data-curve=\"{}\"></output>", k));
    }
    return text + fmt::format("</ul><div class=\"plot\" data-plot=\"{}\"></div>", number) +
           (plot.caption.empty() ? "" : "<figcaption>" + escaped(plot.caption) + "</figcaption>") +
           numbers_html(plot) + "</figure>";
  }

  std::string section(const ReportSection& section, const char* css) {
    std::string text = fmt::format("<section{}>", *css ? fmt::format(" class=\"{}\"", css) : "");
    text += (section.folded ? "<details class=\"fold\"><summary><h2>" : "<h2>") + escaped(section.title) +
            (section.folded ? "</h2></summary>" : "</h2>");
    for (const std::string& paragraph : section.paragraphs) text += "<p>" + escaped(paragraph) + "</p>";
    if (!section.list.empty()) {
      text += "<ul>";
      for (const std::string& item : section.list) text += "<li>" + escaped(item) + "</li>";
      text += "</ul>";
    }
    for (const ReportPlot& one : section.plots) text += plot(one);
    for (const ReportStrip& strip : section.strips) text += strip_html(strip);
    if (section.bars.size() > 1) text += "<div class=\"pair\">";
    for (const ReportBars& bars : section.bars) text += bars_html(bars);
    if (section.bars.size() > 1) text += "</div>";
    text += intervals_html(section.intervals);
    for (const ReportTable& table : section.tables) text += table_html(table);
    return text + (section.folded ? "</details></section>" : "</section>");
  }

  std::string reproduce() const {
    std::string text = "<section><h2>How to make this again</h2>";
    if (!report_.command.empty()) text += "<pre>" + escaped(report_.command) + "</pre>";
    if (!report_.setup.empty())
      text += "<details class=\"plain\"><summary>Setup as used</summary><pre>" + escaped(report_.setup) +
              "</pre></details>";
    const auto list = [&](const char* title, const std::vector<std::string>& items) {
      if (items.empty()) return;
      text += std::string("<h3>") + title + "</h3><ul>";
      for (const std::string& item : items) text += "<li>" + escaped(item) + "</li>";
      text += "</ul>";
    };
    list("How well the engine kept its promises", report_.health);
    list("Sources of the effects used", report_.citations);
    return text + "</section><footer><p>" + escaped(report_.program) +
           ". This page holds everything it shows and asks no network. Plots by uPlot 1.6.32 (MIT licence, "
           "Leon Sorokin).</p></footer>";
  }

  const Report& report_;
  Json plots_ = Json::array();
  std::size_t count_ = 0;
};

}  // namespace

std::string report_html(const Report& report) {
  Page page(report);
  const std::string body = page.body(), data = page.data();
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
      "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "script-src {0}; style-src 'unsafe-inline'; img-src data:; connect-src 'none'; form-action "
      "'none'; base-uri 'none'\"><meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\"><link rel=\"icon\" "
      "href=\"data:,\"><title>{1}</title>\n<style>{2}</style>\n"
      "<style>{3}</style></head>\n<body><main>{4}</main>\n<noscript><main><p>Without scripts there are no "
      "plots; every plot's numbers stand in the table "
      "below it.</p></main></noscript>\n<script type=\"text/plain\" id=\"data\">{5}</script>\n",
      script_sources(), escaped(report.title), plot_style, page_style, body, base64(gzip(data)));
  for (std::size_t i = 0; i < report.replays.size(); ++i)
    html += fmt::format("<script type=\"text/plain\" id=\"replay-{}\">{}</script>\n", i,
                        base64(gzip(packed(report.replays[i]).bytes)));
  if (!report.knobs.kind.empty())
    html += fmt::format("<script type=\"text/plain\" id=\"knobs\">{}</script>\n",
                        base64(gzip(knobs_json(report.knobs))));
  for (const char* script :
       {plot_script, replay_script, model_script, knobs_script, figures_script, page_script})
    html += fmt::format("<script>{}</script>\n", script);
  return html + "</body></html>\n";
}

void write_report(const std::filesystem::path& file, const Report& report) {
  write_file(file, report_html(report));
}

}  // namespace shakedown
