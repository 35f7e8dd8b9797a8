// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "restitution_curve.hpp"

namespace shakedown {

std::string curve_json(const RestitutionCurve& curve) {
  using Json = nlohmann::ordered_json;
  const auto of = [&](const RestitutionBand& band) {
    Json low = Json::array(), high = Json::array();
    for (std::size_t i = 0; i < curve.speed.size(); ++i)
      low.push_back(band.low(i)), high.push_back(band.high(i));
    return Json{{"restitution", band.restitution}, {"low", low}, {"high", high}};
  };
  return Json{
      {"closing_speed_m_per_s", curve.speed}, {"grains", of(curve.grains)}, {"walls", of(curve.walls)}}
      .dump();
}

}  // namespace shakedown
