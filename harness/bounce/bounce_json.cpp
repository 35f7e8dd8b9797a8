// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bounce_answer.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Estimate& estimate) {
  return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}};
}

Json laws_json(const BounceAnswer& answer) {
  Json laws = Json::array();
  for (std::size_t i = 0; i < answer.laws.size(); ++i) {
    const LawFit& law = answer.laws[i];
    const LawTest& test = answer.tests[i];
    Json parameters = Json::object();
    for (std::size_t k = 0; k < law.values.size(); ++k)
      parameters[std::string(law.parameters[k].name)] = json_of(law.values[k]);
    laws.push_back({{"law", std::string(law_of(law.model.law).name)},
                    {"air", law.model.air == AirModel::none   ? "none"
                            : law.model.air == AirModel::ball ? "sphere"
                                                              : "free"},
                    {"probability", law.probability},
                    {"probability_without_scatter", law.probability_still},
                    {"log_evidence", law.posterior.log_evidence},
                    {"formula", std::string(law_of(law.model.law).formula)},
                    {"parameters", parameters},
                    {"chi2", test.chi2},
                    {"degrees", test.degrees},
                    {"chi2_per_degree_by_timing", test.chi2_by_timing},
                    {"bends", test.bends},
                    {"bends_gain", test.gain},
                    {"p_value", test.p_value}});
  }
  return laws;
}

Json impacts_json(const BounceReading& reading) {
  Json impacts = Json::array();
  for (const ImpactRow& row : reading.answer.best().at.rows) {
    const Drop& drop = reading.read.drops[row.drop];
    impacts.push_back({{"file", drop.file},
                       {"drop", drop.name},
                       {"impact", row.impact},
                       {"speed_m_per_s", row.speed},
                       {"restitution", row.restitution}});
  }
  return impacts;
}

Json outliers_json(const BounceReading& reading) {
  Json list = Json::array();
  for (const Outlier& outlier : reading.answer.outliers) {
    const Drop& drop = reading.read.drops[outlier.drop];
    list.push_back({{"file", drop.file},
                    {"drop", drop.name},
                    {"impact", outlier.impact},
                    {"reason", outlier.reason},
                    {"sigmas", outlier.sigmas}});
  }
  return list;
}

Json drops_json(const BounceReading& reading) {
  Json list = Json::array();
  for (const Drop& drop : reading.read.drops)
    list.push_back({{"file", drop.file},
                    {"drop", drop.name},
                    {"intervals_s", drop.interval},
                    {"first_impact", drop.impact.empty() ? 1 : drop.impact.front()},
                    {"height_m", drop.height},
                    {"stated_height_m", drop.stated_height}});
  return list;
}

}  // namespace

Json bounce_json(const BounceReading& reading) {
  const BounceAnswer& answer = reading.answer;
  const LawFit& best = answer.best();
  Json curve = Json::array();
  for (const double speed : speeds_told(answer))
    curve.push_back({{"speed_m_per_s", speed},
                     {"restitution", json_of(best.restitution_at(speed))},
                     {"averaged", json_of(answer.averaged_at(speed))},
                     {"ratio_as_timed", json_of(reading.as_timed.restitution_at(speed))}});
  return {{"schema_version", 1},
          {"sentence", sentence_of(reading)},
          {"law", best.name()},
          {"probability", best.probability},
          {"holds", answer.holds()},
          {"p_value", answer.test.p_value},
          {"reference_speed_m_per_s", answer.reference},
          {"slowest_m_per_s", answer.slowest},
          {"fastest_m_per_s", answer.fastest},
          {"restitution_at_reference", json_of(best.restitution_at(answer.reference))},
          {"averaged_at_reference", json_of(answer.averaged_at(answer.reference))},
          {"restitution", curve},
          {"laws", laws_json(answer)},
          {"scatter", json_of(best.posterior.spread(&SpreadNode::scatter))},
          {"scatter_probability", answer.scatter_odds},
          {"drop_scatter", json_of(best.posterior.spread(&SpreadNode::drop_scatter))},
          {"drop_scatter_probability", answer.drop_scatter_odds},
          {"timing_s", json_of(best.posterior.spread(&SpreadNode::timing))},
          {"setup", effect_lines(reading)},
          {"outliers", outliers_json(reading)},
          {"impacts", impacts_json(reading)},
          {"drops", drops_json(reading)},
          {"notes", reading.read.notes}};
}

}  // namespace shakedown
