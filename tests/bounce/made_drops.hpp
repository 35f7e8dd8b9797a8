// SPDX-License-Identifier: MIT
// Drops of a ball that is known: a law, scatter, a clock with noise.
#pragma once
#include <vector>

#include "drop_residuals.hpp"
#include "drops.hpp"
#include "random.hpp"

namespace shakedown {

struct MadeBall {
  LawKind law = LawKind::constant;
  std::vector<double> parameters{0.85};
  double reference = 2;
  double timing = 0;        ///< s, of an instant
  double scatter = 0;       ///< of e, of each impact
  double drop_scatter = 0;  ///< of e, of each drop
  Flight flight{9.81};
};

/// One drop: the ball lands with `speed` and flies `flights` times.
inline Drop made_drop(const MadeBall& ball, double speed, int flights, Random& random) {
  Drop drop;
  const double of_drop = ball.drop_scatter * random.normal();
  double before = ball.timing * random.normal();
  for (int i = 0; i < flights; ++i) {
    const double e = restitution(ball.law, ball.parameters, speed, ball.reference) + of_drop +
                     ball.scatter * random.normal();
    const double takeoff = std::min(0.9999, e) * speed, after = ball.timing * random.normal();
    drop.interval.push_back(ball.flight.duration(takeoff) + after - before);
    drop.impact.push_back(i + 1);
    speed = ball.flight.landing(takeoff);
    before = after;
  }
  return drop;
}

inline std::vector<Drop> made_drops(const MadeBall& ball, const std::vector<double>& speeds, int flights,
                                    Random& random) {
  std::vector<Drop> drops;
  for (const double speed : speeds) drops.push_back(made_drop(ball, speed, flights, random));
  return drops;
}

}  // namespace shakedown
