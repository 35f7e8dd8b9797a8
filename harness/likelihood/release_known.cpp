// SPDX-License-Identifier: MIT
#include "release_known.hpp"

#include <algorithm>
#include <cmath>

#include "camera.hpp"
#include "experiment.hpp"
#include "nuisance.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "toml_string.hpp"

namespace shakedown {

namespace {

constexpr double usual_error = 5e-4;  // m; a stop or a thread holds a box to half a millimetre
constexpr std::string_view key = "release.displacement";

/// Returns the standard deviation, m, by which scale, lens and tilt of the camera may have moved the first
/// position.
double error_of_camera(const Measurement& measurement, KnownEffects known, double displacement) {
  double square = 0;
  for (const CameraNuisance& nuisance : camera_nuisances(measurement, known)) {
    const std::optional<CameraParameter> parameter = find_camera_parameter(known, nuisance.key);
    if (!parameter || nuisance.each_run || parameter->inverse_square) continue;
    // The box is at rest, as when it is let go.
    const Recording still{{-1, 0, 1}, {displacement, displacement, displacement}, {0, 0, 0}};
    square += std::pow(nuisance.deviation() * derivative(still, *parameter).x_box[1], 2);
  }
  return std::sqrt(square);
}

}  // namespace

Measurement with_measured_release(Measurement measurement, KnownEffects known) {
  for (Measurement::Run& run : measurement.runs) {
    if (run.setup.grains.count == 0) continue;
    const ReleaseFound& seen = run.audit.release;
    const double given = run.setup.release.displacement;
    if (starts_anywhere(run.recorded, run.setup)) continue;
    const KnownValue* said = find_known(run.recorded.known, key);
    if (said == nullptr) said = find_known(measurement.known, key);
    const double before = said != nullptr ? said->error : usual_error;
    run.recorded.release_error = before;
    if (!std::isfinite(seen.displacement) || !std::isfinite(seen.displacement_error)) continue;
    const double by_camera = std::hypot(seen.displacement_error, error_of_camera(measurement, known, given));
    // A release far from what the user says is another mistake, not a hand's.
    constexpr double hand = 4;
    if (!(before > 0) || std::abs(seen.displacement - given) > hand * std::hypot(before, by_camera)) continue;
    const double weight = before * before / (before * before + by_camera * by_camera);
    const double value = given + weight * (seen.displacement - given);
    run.recorded.release_error = std::sqrt(weight) * by_camera;
    if (!run.recorded.grains_measured_at) run.recorded.grains_measured_at = given;
    std::erase_if(run.recorded.overrides, [](const Override& one) { return one.key == key; });
    run.recorded.overrides.push_back({std::string(key), toml_string(write_quantity(value, "m")), "measured"});
    set_number(run.setup, key, value, known);
  }
  return measurement;
}

}  // namespace shakedown
