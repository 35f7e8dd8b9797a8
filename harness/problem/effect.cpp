// SPDX-License-Identifier: MIT
#include "effect.hpp"

#include <cmath>

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
const Vec3& EffectChoice::vector(std::string_view parameter) const {
  return value_of<Vec3>(*this, parameter);
}
const std::string& EffectChoice::text(std::string_view parameter) const {
  return value_of<std::string>(*this, parameter);
}
const std::map<std::string, double>& EffectChoice::constants(std::string_view parameter) const {
  return value_of<std::map<std::string, double>>(*this, parameter);
}

const Parameter* EffectRecord::find(std::string_view parameter) const {
  for (const Parameter& candidate : parameters)
    if (candidate.name == parameter) return &candidate;
  return nullptr;
}

Capability EffectRecord::capability(std::string_view engine) const {
  for (const std::string_view who : {engine, every_engine})
    for (const EngineCapability& one : engines)
      if (one.engine == who) return one.capability;
  return {Fidelity::not_modelled, "this engine has no such law; use --engine hard or soft"};
}

bool EffectRecord::takes_formula() const {
  for (const Parameter& parameter : parameters)
    if (parameter.kind == ParameterKind::constants) return true;
  return false;
}

EffectChoice with_defaults(const EffectRecord& record) {
  EffectChoice choice{&record, {}, {}};
  for (const Parameter& parameter : record.parameters)
    choice.values.emplace(parameter.name, parameter.default_value);
  return choice;
}

bool is_neutral(const EffectChoice& choice) {
  bool has_neutral = false;
  for (const Parameter& parameter : choice.record->parameters) {
    const ParameterValue& value = choice.values.find(parameter.name)->second;
    if (parameter.kind == ParameterKind::choice && value != parameter.default_value) return false;
    if (std::isnan(parameter.neutral)) continue;
    has_neutral = true;
    const bool there = parameter.kind == ParameterKind::vector
                           ? (std::get<Vec3>(value).array() == parameter.neutral).all()
                           : std::get<double>(value) == parameter.neutral;
    if (!there) return false;
  }
  return has_neutral;
}

}  // namespace shakedown
