// SPDX-License-Identifier: MIT
#include "camera_features.hpp"

#include <algorithm>
#include <cmath>

#include "camera.hpp"
#include "nuisance.hpp"
#include "parameter_knobs.hpp"
#include "setup_file.hpp"

namespace shakedown {

std::vector<MeasuredFeatures> features_with_camera(const Measurement& measurement,
                                                   std::span<const EffectRecord* const> known) {
  std::vector<MeasuredFeatures> list = features_of(measurement);
  const std::vector<CameraNuisance> nuisances = camera_nuisances(measurement, known);
  for (std::size_t r = 0; r < list.size(); ++r) {
    const Measurement::Run& run = measurement.runs[r];
    const Recording recording{run.recorded.time, run.audit.x_box, run.audit.x_com};
    for (const CameraParameter& parameter : camera_parameters()) {
      if (parameter.inverse_square) continue;
      Recording change = derivative(recording, parameter);
      for (std::vector<double>* x : {&change.x_box, &change.x_com})
        for (double& at : *x)
          if (!std::isfinite(at)) at = 0;  // beside a gap, where no bin looks
      list[r].by_camera[std::string(parameter.path)] =
          features_on_frames(list[r].plan, recording.time, change.x_box, change.x_com);
    }
    for (const CameraNuisance& nuisance : nuisances) {
      if (!nuisance.each_run || !(nuisance.deviation_of[r] > 0)) continue;
      list[r].own.conservativeResize(list[r].values.size(), list[r].own.cols() + 1);
      list[r].own.rightCols(1) = nuisance.deviation_of[r] * list[r].by_camera.at(nuisance.key);
    }
  }
  return list;
}

std::vector<Knob> camera_knobs(const Setup& setup, const Measurement& measurement,
                               std::span<const EffectRecord* const> known) {
  std::vector<Knob> knobs;
  for (const CameraNuisance& nuisance : camera_nuisances(measurement, known)) {
    if (nuisance.each_run || find_camera_parameter(nuisance.key) == nullptr) continue;
    knobs.push_back(exact_knob(nuisance.key, get_number(setup, nuisance.key, known), nuisance.deviation()));
  }
  return knobs;
}

}  // namespace shakedown
