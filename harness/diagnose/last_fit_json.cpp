// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "last_fit.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

/// Returns lengths in mm, rounded to a ten-thousandth, which is enough for a picture.
Json json_in_mm(const std::vector<double>& metres) {
  Json list = Json::array();
  for (const double value : metres)
    list.push_back(std::isfinite(value) ? Json(std::round(value * 1e7) / 1e4) : Json(nullptr));
  return list;
}

}  // namespace

Json curves_json(const LastFit& fit) {
  constexpr std::size_t most = 2000;
  Json list = Json::array();
  for (const FittedCurve& curve : curves_of(fit, most)) {
    std::vector<double> residual = curve.measured;
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] -= curve.model[i];
    Json time = Json::array();
    for (const double t : curve.time) time.push_back(std::round(t * 1e6) / 1e6);
    list.push_back({{"run", curve.run},
                    {"observable", curve.observable},
                    {"time_s", time},
                    {"measured_mm", json_in_mm(curve.measured)},
                    {"model_mm", json_in_mm(curve.model)},
                    {"as_given_mm", json_in_mm(curve.as_given)},
                    {"residual_mm", json_in_mm(residual)},
                    {"spread_mm", json_in_mm(curve.spread)}});
  }
  return list;
}

}  // namespace shakedown
