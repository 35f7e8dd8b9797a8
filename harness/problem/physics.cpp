// SPDX-License-Identifier: MIT
#include "physics.hpp"

#include <cmath>
#include <numbers>

namespace shakedown {

namespace {
template <class T>
const T& value_of(const EffectChoice& choice, std::string_view parameter) {
  const auto found = choice.values.find(parameter);
  EXPECT(found != choice.values.end() && std::holds_alternative<T>(found->second));
  return std::get<T>(found->second);
}
}  // namespace

double EffectChoice::number(std::string_view parameter) const { return value_of<double>(*this, parameter); }
const Vec3& EffectChoice::vector(std::string_view parameter) const { return value_of<Vec3>(*this, parameter); }
const std::string& EffectChoice::text(std::string_view parameter) const {
  return value_of<std::string>(*this, parameter);
}
const std::map<std::string, double>& EffectChoice::constants(std::string_view parameter) const {
  return value_of<std::map<std::string, double>>(*this, parameter);
}

Physics physics_of(const Setup& setup) {
  Physics physics;
  const double angular_frequency = 2 * std::numbers::pi * setup.spring.frequency;
  physics.box_mass = setup.box.mass;
  physics.stiffness =
      setup.domain == Domain::damper ? setup.box.mass * angular_frequency * angular_frequency : 0.0;
  physics.packing = setup.release.packing;
  const double wall = setup.restitution.grain_wall;
  physics.contact.restitution = {setup.restitution.grain_grain, wall, wall};
  for (std::size_t i = 0; i < setup.effects.size(); ++i)
    setup.effects[i].record->apply(setup.effects[i], static_cast<int>(i), physics);
  return physics;
}

}  // namespace shakedown
