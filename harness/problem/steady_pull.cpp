// SPDX-License-Identifier: MIT
#include "steady_pull.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "physics.hpp"
#include "printed_text.hpp"

namespace shakedown {

namespace {

/// Shaking over a pull along the motion below which layers rest on a wall for so long that the engines part:
/// films of soft contacts under it leave the right model of hard spheres 1.61, 1.31 and more times the misfit
/// of its own runs from 5.7 (0.15 g) on, 0.90 to 1.24 times at 7.6 (0.1 g).
constexpr double engines_part = 7;

}  // namespace

double SteadyPull::strength() const { return std::hypot(along, across); }

double SteadyPull::ratio() const {
  return strength() > 0 ? shaking / strength() : std::numeric_limits<double>::infinity();
}

SteadyPull steady_pull(const Setup& setup) {
  const Physics physics = physics_of(setup);
  const Vec3 pull = physics.grains.constant.sum();
  SteadyPull result{.along = pull.x(), .across = std::hypot(pull.y(), pull.z())};
  if (!(physics.stiffness > 0)) return result;
  const double of_grains = static_cast<double>(setup.grains.count) * setup.grains.mass * pull.x();
  result.rest = (physics.box.constant.sum() + of_grains) / physics.stiffness;
  const double w = 2 * std::numbers::pi * setup.spring.frequency;
  result.shaking = w * w * std::abs(setup.release.displacement - result.rest);
  return result;
}

std::string words_of_pull(const SteadyPull& pull) {
  if (!(pull.strength() > 0) || !(pull.shaking > 0)) return "";
  return text_of("%.3g (%.3g m/s^2 against %.3g m/s^2)", pull.ratio(), pull.shaking, pull.strength());
}

std::string note_on_pull(const SteadyPull& pull) {
  if (!(pull.strength() > 0) || !(pull.shaking > 0)) return "";
  std::string note = "shaking over the setup's steady pull: " + words_of_pull(pull);
  if (pull.shaking < engines_part * std::abs(pull.along))
    note +=
        "; under so much of it along the motion layers rest on a wall for most of each swing, and hard "
        "spheres, whose impacts come one after the other, lose energy there otherwise than contacts that "
        "last. A model may be rejected for that alone: `shakedown crosscheck --engines hard,soft` tells by "
        "how much the two part";
  return note;
}

}  // namespace shakedown
