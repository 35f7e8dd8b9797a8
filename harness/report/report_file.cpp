// SPDX-License-Identifier: MIT
// A report as JSON and back. One list of fields for each struct serves both directions.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "errors.hpp"
#include "kept_files.hpp"
#include "report.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;
constexpr int report_schema_version = 1;

template <class F>
void fields(F& f, ReportCurve& c) {
  f("name", c.name), f("role", c.role), f("y", c.y);
}
template <class F>
void fields(F& f, ReportPlot::Mark& m) {
  f("x", m.x), f("label", m.label);
}
template <class F>
void fields(F& f, ReportPlot& p) {
  f("title", p.title), f("caption", p.caption), f("x_label", p.x_label), f("y_label", p.y_label),
      f("group", p.group), f("over_time", p.over_time);
  f("level", p.level), f("logarithmic_y", p.logarithmic_y), f("x", p.x), f("curves", p.curves),
      f("marks", p.marks);
}
template <class F>
void fields(F& f, ReportTable& t) {
  f("title", t.title), f("caption", t.caption), f("columns", t.columns), f("rows", t.rows),
      f("folded", t.folded);
}
template <class F>
void fields(F& f, ReportBars::Line& l) {
  f("label", l.label), f("note", l.note), f("values", l.values), f("errors", l.errors), f("tone", l.tone);
}
template <class F>
void fields(F& f, ReportBars& b) {
  f("title", b.title), f("caption", b.caption), f("unit", b.unit), f("names", b.names), f("lines", b.lines),
      f("floor", b.floor), f("floor_name", b.floor_name);
}
template <class F>
void fields(F& f, ReportStrip::Row& r) {
  f("name", r.name), f("group", r.group), f("values", r.values);
}
template <class F>
void fields(F& f, ReportStrip& s) {
  f("title", s.title), f("caption", s.caption), f("x_label", s.x_label), f("value_name", s.value_name),
      f("edges", s.edges), f("rows", s.rows), f("top", s.top);
}
template <class F>
void fields(F& f, ReportInterval& i) {
  f("name", i.name), f("unit", i.unit), f("word", i.word), f("value", i.value), f("low", i.low),
      f("high", i.high), f("given", i.given), f("known_low", i.known_low), f("known_high", i.known_high);
}
template <class F>
void fields(F& f, ReportSection& s) {
  f("title", s.title), f("paragraphs", s.paragraphs), f("plots", s.plots), f("strips", s.strips),
      f("bars", s.bars), f("intervals", s.intervals);
  f("tables", s.tables), f("list", s.list), f("folded", s.folded);
}
template <class F>
void fields(F& f, ReportFact& x) {
  f("label", x.label), f("value", x.value), f("note", x.note), f("tone", x.tone);
}
template <class F>
void fields(F& f, ReportReplay::Track& t) {
  f("time", t.time), f("x", t.x), f("y", t.y), f("z", t.z), f("contact", t.contact);
}
template <class F>
void fields(F& f, ReportReplay& r) {
  f("group", r.group), f("title", r.title), f("caption", r.caption), f("length", r.length),
      f("width", r.width), f("height", r.height);
  f("duration", r.duration), f("tolerance", r.tolerance), f("exact_from", r.exact_from),
      f("exact_to", r.exact_to), f("radius", r.radius);
  f("grains", r.grains), f("box", r.box), f("measured_time", r.measured_time),
      f("measured_x_box", r.measured_x_box);
}
template <class F>
void fields(F& f, ReportKnobs::Number& n) {
  f("key", n.key), f("label", n.label), f("effect", n.effect), f("role", n.role), f("unit", n.unit);
  f("factor", n.factor), f("inverse", n.inverse), f("given", n.given), f("best", n.best);
  f("absent", n.absent), f("from", n.from), f("to", n.to), f("low", n.low), f("high", n.high);
}
template <class F>
void fields(F& f, ReportKnobs::Term& t) {
  f("numbers", t.numbers), f("weights", t.weights), f("power", t.power);
}
template <class F>
void fields(F& f, ReportKnobs::Curve& c) {
  f("name", c.name), f("time", c.time), f("measured", c.measured), f("spread", c.spread);
  f("best", c.best), f("given", c.given), f("columns", c.columns);
}
template <class F>
void fields(F& f, ReportKnobs::Run& r) {
  f("name", r.name), f("curves", r.curves), f("square", r.square), f("start", r.start);
  f("place", r.place), f("speed", r.speed), f("origin", r.origin), f("displacement", r.displacement);
  f("amplitude", r.amplitude);
}
template <class F>
void fields(F& f, ReportKnobs::Value& v) {
  f("key", v.key), f("value", v.value);
}
template <class F>
void fields(F& f, ReportKnobs::Effect& e) {
  f("name", e.name), f("toml", e.toml);
}
template <class F>
void fields(F& f, ReportKnobs& k) {
  f("kind", k.kind), f("note", k.note), f("numbers", k.numbers), f("terms", k.terms), f("runs", k.runs);
  f("values", k.values), f("effects", k.effects);
}
template <class F>
void fields(F& f, Report& r) {
  f("kind", r.kind), f("title", r.title), f("subtitle", r.subtitle), f("verdict", r.verdict),
      f("sentence", r.sentence), f("tone", r.tone);
  f("opening", r.opening), f("knobs", r.knobs);
  f("facts", r.facts), f("replays", r.replays), f("sections", r.sections), f("command", r.command),
      f("setup", r.setup), f("program", r.program);
  f("health", r.health), f("citations", r.citations);
}

struct ToJson {
  Json object = Json::object();
  template <class T>
  void operator()(const char* name, T& value) {
    object[name] = of(value);
  }

  template <class T>
  static Json of(std::vector<T>& values) {
    Json array = Json::array();
    for (T& value : values) array.push_back(of(value));
    return array;
  }
  template <class T>
  static Json of(T& value) {
    if constexpr (std::is_same_v<T, double>)
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    else if constexpr (std::is_enum_v<T> || std::is_same_v<T, std::uint8_t>)
      return static_cast<int>(value);
    else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>)
      return value;
    else {
      ToJson inner;
      fields(inner, value);
      return std::move(inner.object);
    }
  }
};

struct FromJson {
  const Json& object;
  template <class T>
  void operator()(const char* name, T& value) {
    if (const auto found = object.find(name); found != object.end()) read(*found, value);
  }

  static void read(const Json& from, double& to) { to = from.is_null() ? std::nan("") : from.get<double>(); }
  static void read(const Json& from, bool& to) { to = from.get<bool>(); }
  static void read(const Json& from, std::uint8_t& to) { to = from.get<std::uint8_t>(); }
  static void read(const Json& from, std::string& to) { to = from.get<std::string>(); }
  template <class T>
  static void read(const Json& from, std::vector<T>& to) {
    to.clear();
    for (const Json& one : from) read(one, to.emplace_back());
  }
  template <class T>
  static void read(const Json& from, T& to) {
    if constexpr (std::is_enum_v<T>) {
      to = static_cast<T>(from.get<int>());
    } else {
      FromJson inner{from};
      fields(inner, to);
    }
  }
};

bool is_whole(const ReportReplay::Track& track) {
  const std::size_t n = track.time.size();
  return track.x.size() == n && track.y.size() == n && track.z.size() == n &&
         (track.contact.empty() || track.contact.size() == n);
}

bool is_whole(const ReportReplay& replay) {
  return is_whole(replay.box) && replay.measured_time.size() == replay.measured_x_box.size() &&
         replay.radius.size() == replay.grains.size() &&
         std::all_of(replay.grains.begin(), replay.grains.end(),
                     [](const ReportReplay::Track& track) { return is_whole(track); });
}

bool is_known(Tone tone) { return tone >= Tone::plain && tone <= Tone::unsure; }

bool is_whole(const ReportSection& section) {
  bool whole = true;
  for (const ReportPlot& plot : section.plots)
    for (const ReportCurve& curve : plot.curves)
      whole = whole && curve.y.size() == plot.x.size() && curve.role >= CurveRole::measured &&
              curve.role <= CurveRole::points;
  for (const ReportStrip& strip : section.strips)
    for (const ReportStrip::Row& row : strip.rows)
      whole = whole && row.values.size() + 1 == strip.edges.size();
  for (const ReportBars& bars : section.bars)
    for (const ReportBars::Line& line : bars.lines) whole = whole && is_known(line.tone);
  return whole;
}

/// Tells whether what belongs together is equally long, as the page takes for granted.
bool is_whole(const Report& report) {
  return is_known(report.tone) &&
         std::all_of(report.facts.begin(), report.facts.end(),
                     [](const ReportFact& fact) { return is_known(fact.tone); }) &&
         std::all_of(report.sections.begin(), report.sections.end(),
                     [](const ReportSection& section) { return is_whole(section); }) &&
         std::all_of(report.replays.begin(), report.replays.end(),
                     [](const ReportReplay& replay) { return is_whole(replay); });
}

}  // namespace

std::string report_json(const Report& report) {
  Report copy = report;
  ToJson json;
  json.object["schema_version"] = report_schema_version;
  fields(json, copy);
  return json.object.dump() + "\n";
}

Report read_report(std::filesystem::path file) {
  if (std::filesystem::is_directory(file)) file /= report_file_name;
  keep_unchanged(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw FileError(file.string() +
                    ": there is no such report; commands with --out DIR leave one in their folder");
  std::ostringstream contents;
  contents << stream.rdbuf();
  try {
    const Json json = Json::parse(contents.str());
    if (json.at("schema_version") != report_schema_version)
      throw FileError(file.string() +
                      ": was written by another version of the program; run its command again");
    Report report;
    FromJson reader{json};
    fields(reader, report);
    if (!is_whole(report))
      throw FileError(
          file.string() +
          ": is damaged (curves without a number for each moment, or words that do not exist); run "
          "its command again");
    return report;
  } catch (const nlohmann::json::exception& error) {
    throw FileError(file.string() + ": is not a report (" + error.what() + "); run its command again");
  }
}

}  // namespace shakedown
