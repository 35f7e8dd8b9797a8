// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>

#include "contact_curve.hpp"

namespace shakedown {

std::string curve_json(const ContactCurve& curve) {
  using Json = nlohmann::ordered_json;
  const auto of = [&](const ContactBand& band) {
    Json low = Json::array(), high = Json::array();
    for (std::size_t i = 0; i < curve.speed.size(); ++i)
      low.push_back(curve.low(band, i)), high.push_back(curve.high(band, i));
    return Json{{std::string(curve.law->coefficient), band.value}, {"low", low}, {"high", high}};
  };
  std::string speed(curve.law->speed);
  std::replace(speed.begin(), speed.end(), ' ', '_');
  return Json{{speed + "_m_per_s", curve.speed}, {"grains", of(curve.grains)}, {"walls", of(curve.walls)}}
      .dump();
}

}  // namespace shakedown
