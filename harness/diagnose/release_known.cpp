// SPDX-License-Identifier: MIT
#include "release_known.hpp"

#include <algorithm>
#include <cmath>

#include "nuisance.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "toml_string.hpp"

namespace shakedown {

namespace {

constexpr double usual_error = 5e-4;  // m; a stop or a thread holds a box to half a millimetre
constexpr std::string_view key = "release.displacement";

/// m, by which the camera's scale may have moved the first position.
double error_of_scale(const Measurement& measurement, std::span<const EffectRecord* const> known,
                      double displacement) {
  for (const CameraNuisance& nuisance : camera_nuisances(measurement, known))
    if (nuisance.known_as == "camera.scale") return nuisance.deviation() * std::abs(displacement);
  return 0;
}

}  // namespace

Measurement with_measured_release(Measurement measurement, std::span<const EffectRecord* const> known) {
  for (Measurement::Run& run : measurement.runs) {
    if (run.setup.grains.count == 0) continue;
    const ReleaseFound& seen = run.audit.release;
    const double given = run.setup.release.displacement;
    if (!std::isfinite(seen.displacement) || !std::isfinite(seen.displacement_error)) continue;
    const KnownValue* said = find_known(run.recorded.known, key);
    if (said == nullptr) said = find_known(measurement.known, key);
    const double before = said != nullptr ? said->error : usual_error,
                 by_camera = std::hypot(seen.displacement_error, error_of_scale(measurement, known, given));
    // Far from what the user says it is another mistake, not a hand's.
    constexpr double hand = 4;
    if (!(before > 0) || std::abs(seen.displacement - given) > hand * std::hypot(before, by_camera)) continue;
    const double weight = before * before / (before * before + by_camera * by_camera);
    const double value = given + weight * (seen.displacement - given);
    std::erase_if(run.recorded.overrides, [](const Override& one) { return one.key == key; });
    run.recorded.overrides.push_back({std::string(key), toml_string(write_quantity(value, "m")), "measured"});
    set_number(run.setup, key, value, known);
  }
  return measurement;
}

}  // namespace shakedown
