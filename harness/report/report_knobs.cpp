// SPDX-License-Identifier: MIT
#include "report_knobs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "packed_json.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Rounds a number to nine digits, which a quadratic form of some dozens of terms needs.
Json nine_digits(double value) {
  return std::isfinite(value) ? Json(std::stod(fmt::format("{:.9g}", value))) : Json(0);
}

Json json_of(const ReportKnobs::Number& n) {
  return {{"key", n.key},         {"label", n.label},
          {"effect", n.effect},   {"role", n.role},
          {"unit", n.unit},       {"factor", n.factor},
          {"inverse", n.inverse}, {"given", n.given},
          {"best", n.best},       {"absent", finite(n.absent)},
          {"from", n.from},       {"to", n.to},
          {"low", n.low},         {"high", n.high}};
}

Json json_of(const ReportKnobs::Term& term) {
  Json weights = Json::array();
  for (std::size_t i = 0; i < term.numbers.size(); ++i)
    weights.push_back(Json::array({static_cast<int>(term.numbers[i]), term.weights[i]}));
  return {{"weights", weights}, {"power", term.power}};
}

/// Times are packed to 1e-8 of the longest, as a box passes a micrometre in a microsecond or two.
constexpr double parts_of_time = 1e8;

Json json_of(const ReportKnobs::Curve& curve) {
  Json columns = Json::array();
  for (const std::vector<double>& column : curve.columns) columns.push_back(packed_json(column));
  return {{"name", curve.name},
          {"time", packed_json(curve.time, parts_of_time)},
          {"measured", packed_json(curve.measured)},
          {"spread", packed_json(curve.spread)},
          {"best", packed_json(curve.best)},
          {"given", packed_json(curve.given)},
          {"columns", columns}};
}

Json json_of(const ReportKnobs::Run& run) {
  Json curves = Json::array(), square = Json::array();
  for (const ReportKnobs::Curve& curve : run.curves) curves.push_back(json_of(curve));
  for (const std::vector<double>& row : run.square) {
    Json numbers = Json::array();
    for (const double value : row) numbers.push_back(nine_digits(value));
    square.push_back(numbers);
  }
  return {{"name", run.name},          {"curves", curves},
          {"square", square},          {"start", run.start},
          {"place", run.place},        {"speed", run.speed},
          {"origin", run.origin},      {"displacement", run.displacement},
          {"amplitude", run.amplitude}};
}

}  // namespace

std::string knobs_json(const ReportKnobs& knobs) {
  Json numbers = Json::array(), terms = Json::array(), runs = Json::array(), effects = Json::array(),
       values = Json::object();
  for (const ReportKnobs::Number& number : knobs.numbers) numbers.push_back(json_of(number));
  for (const ReportKnobs::Term& term : knobs.terms) terms.push_back(json_of(term));
  for (const ReportKnobs::Run& run : knobs.runs) runs.push_back(json_of(run));
  for (const ReportKnobs::Value& value : knobs.values) values[value.key] = finite(value.value);
  for (const ReportKnobs::Effect& effect : knobs.effects)
    effects.push_back({{"name", effect.name}, {"toml", effect.toml}});
  return Json{{"kind", knobs.kind}, {"numbers", numbers}, {"terms", terms},
              {"runs", runs},       {"values", values},   {"effects", effects}}
      .dump();
}

}  // namespace shakedown
