// SPDX-License-Identifier: MIT
#include "camera.hpp"

#include <cmath>

namespace shakedown {

Recording recorded_by(const Camera& camera, const Trajectory& trajectory) {
  Recording seen;
  const std::size_t count = trajectory.time.size();
  seen.time.reserve(count);
  seen.x_box.reserve(count);
  seen.x_com.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double time = trajectory.time[i], box = trajectory.x_box[i];
    double grains = (1 - camera.centre_bias) * (trajectory.x_com[i] - box);
    if (camera.arc_length > 0) grains *= std::cos(1.5 * box / camera.arc_length);
    seen.time.push_back(time + camera.time_offset);
    seen.x_box.push_back((1 + camera.scale) * box + camera.drift * time);
    seen.x_com.push_back((1 + camera.scale) * (box + grains) + camera.drift * time);
  }
  return seen;
}

}  // namespace shakedown
