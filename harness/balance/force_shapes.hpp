// SPDX-License-Identifier: MIT
// Lists forces that no effect of the library describes, as families of formulas for user_force. A new family
// is one entry of the list.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace shakedown {

/// Says what a shape g depends on, and the force made of it.
enum class ShapeOf {
  position,        ///< F = s g(x)
  damping_at_x,    ///< F = -s v g(x)
  velocity,        ///< F = s g(v)
  damping_at_t,    ///< F = -s v g(t)
  stiffness_at_t,  ///< F = -s x g(t)
  time,            ///< F = s g(t)
  friction_at_x,   ///< F = -s sign(v) g(x)
};

/// Holds the scales of the motion from which searches start.
struct MotionScales {
  double position = 0;        ///< m, largest |x|
  double velocity = 0;        ///< m/s, largest |v|
  double duration = 0;        ///< s
  double velocity_noise = 0;  ///< m/s; what happens below it nobody sees
};

constexpr int most_shape_parameters = 2;
using ShapeValues = std::array<double, most_shape_parameters>;

/// Describes a number that shapes a family.
struct ShapeParameter {
  std::string name, unit;
  std::vector<double> start;  ///< values from which the search starts, in units of `scale_of`
  ShapeOf scale_of =
      ShapeOf::position;  ///< position, velocity or time; a pure number where the unit is empty
};

/// Describes a family of formulas.
struct ForceShape {
  std::string sentence;
  std::string formula;  ///< as user_force writes it
  ShapeOf of = ShapeOf::position;
  std::string strength, strength_unit;
  std::vector<ShapeParameter> parameters;
  double (*value)(double argument, const ShapeValues& shape) = nullptr;  ///< g
};

/// Returns all families of formulas that are tried, in the order of the table.
const std::vector<ForceShape>& force_shapes();

}  // namespace shakedown
