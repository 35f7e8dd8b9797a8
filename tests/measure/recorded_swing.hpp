// SPDX-License-Identifier: MIT
// A box with dry friction on its spring, known in closed form, as cameras record it.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "experiment.hpp"
#include "random.hpp"

namespace shakedown {

constexpr double swing_frequency = 1.23;  // Hz

/// m; released at 107.5 mm at t = 0, 2.1 mm less each half period, until it sticks.
inline double swing(double t) {
  constexpr double half = 0.5 / swing_frequency, slip = 1.05e-3, release = 0.1075;
  if (t <= 0) return release;
  const int n = static_cast<int>(t / half);
  if (release - 2 * n * slip <= slip) return 0;
  const double side = n % 2 == 0 ? 1 : -1;
  return side * slip + side * (release - 2 * n * slip - slip) * std::cos(std::numbers::pi * (t / half - n));
}

struct Recorder {
  double rate = 500, duration = 20;  ///< Hz, s
  double white = 2e-4, colour = 0;   ///< m, correlation of neighbouring frames
  double step = 0;                   ///< m, of rounding
  double wander = 0, memory = 1;     ///< m, s
  double jitter = 0;                 ///< s, of the moment of each frame
  bool jitter_known = false;         ///< the table's clock has it
  double lead_in = 0;                ///< s, that the box is held
  double stops_after = 1e9;          ///< s after the release
};

struct RecordedSwing {
  MeasuredRun run;
  double noise = 0;  ///< m, rms of recorded less true positions while it moves, without the wander
};

inline RecordedSwing recorded_swing(const Recorder& how, std::uint64_t seed = 1) {
  Random random(seed, 0, Stream::camera);
  RecordedSwing result;
  result.run.name = "swing";
  double error = how.white * random.normal(), slow = how.wander * random.normal(), squares = 0, moving = 0;
  for (int i = 0; i < static_cast<int>(how.duration * how.rate); ++i) {
    const double written = i / how.rate, t = written + how.jitter * random.normal();
    const auto position = [&](double at) { return swing(std::min(at - how.lead_in, how.stops_after)); };
    error = how.colour * error + std::sqrt(1 - how.colour * how.colour) * how.white * random.normal();
    const double kept = std::exp(-1 / (how.rate * how.memory));
    slow = kept * slow + std::sqrt(1 - kept * kept) * how.wander * random.normal();
    double x = position(t) + error;
    if (how.step > 0) x = std::round(x / how.step) * how.step;
    result.run.time.push_back(how.jitter_known ? t : written);
    result.run.x_box.push_back(x + slow);
    if (t < how.lead_in || t > how.lead_in + how.stops_after) continue;
    squares += std::pow(x - position(result.run.time.back()), 2), ++moving;
  }
  result.run.frame_rate = how.rate;
  result.noise = std::sqrt(squares / moving);
  return result;
}

}  // namespace shakedown
