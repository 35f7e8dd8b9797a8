// SPDX-License-Identifier: MIT
#include "sweep_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "initial_state.hpp"
#include "known_effects.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "steady_forcing.hpp"

namespace shakedown {

namespace {

constexpr std::size_t most_reported = 8;

/// Reports effects that the setup does not have and that need another parameter to be varied.
std::vector<Violation> effects_that_need_more(const Setup& base, const std::vector<SweepAxis>& axes,
                                              KnownEffects known) {
  std::vector<Violation> found;
  for (const SweepAxis& axis : axes) {
    const std::string name(effect_of(axis.key));
    if (find_choice(base, name)) continue;
    if (const EffectRecord* record = known.find(name))
      for (const Parameter& parameter : record->parameters) {
        const std::string needed = name + "." + std::string(parameter.name);
        const bool varied = std::any_of(
            axes.begin(), axes.end(), [&](const SweepAxis& other) { return other.key.starts_with(needed); });
        if (parameter.required && !varied)
          found.push_back(
              {{"--vary", 0, 0},
               axis.key,
               fmt::format("is of an effect that the setup does not have, and {} must be given too", needed),
               "add the effect to the setup, or --set it"});
      }
  }
  return found;
}

std::string shown(const std::vector<SweepAxis>& axes, const std::vector<double>& values) {
  std::string text;
  for (std::size_t a = 0; a < axes.size(); ++a)
    text += (a > 0 ? ", " : "") + axes[a].key + " = " + write_quantity(values[a], axes[a].unit);
  return text;
}

std::vector<Violation> violations_at(const SweepPlan& plan, SweepPoint& point, const Engine& engine,
                                     KnownEffects known) {
  try {
    for (std::size_t a = 0; a < plan.axes.size(); ++a)
      set_number(point.setup, plan.axes[a].key, point.values[a], known);
    std::vector<Violation> found = violations_of(point.setup);
    if (!found.empty()) return found;
    refuse_what_is_not_modelled(engine, point.setup);
    point.setup = long_enough_for_forcing(point.setup);
    (void)initial_state(point.setup);
    point.digest = digest(point.setup);
    return {};
  } catch (const InputError& error) {
    return error.violations;
  }
}

void add_points(SweepPlan& plan, const Engine& engine, KnownEffects known) {
  std::vector<std::vector<double>> grid{{}};
  for (const SweepAxis& axis : plan.axes) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& values : grid)
      for (const double value : axis.values) {
        longer.push_back(values);
        longer.back().push_back(value);
      }
    grid = std::move(longer);
  }
  std::vector<Violation> found;
  std::size_t bad = 0;
  for (std::vector<double>& values : grid) {
    SweepPoint point{std::move(values), plan.base, ""};
    std::vector<Violation> here = violations_at(plan, point, engine, known);
    if (here.empty()) {
      plan.points.push_back(std::move(point));
      continue;
    }
    if (++bad > most_reported) continue;
    for (Violation& violation : here) {
      if (violation.place.file.empty()) violation.place.file = "--vary";
      violation.problem += " [at " + shown(plan.axes, point.values) + "]";
    }
    found.insert(found.end(), here.begin(), here.end());
  }
  if (bad > most_reported)
    found.push_back({{"--vary", 0, 0},
                     "",
                     fmt::format("{} more points are no possible setups", bad - most_reported),
                     "narrow the range"});
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace

SweepPlan plan_sweep(const Setup& base, std::vector<SweepAxis> axes, int runs, const Engine& engine,
                     KnownEffects known) {
  EXPECT(!axes.empty() && runs >= 1);
  if (std::vector<Violation> found = effects_that_need_more(base, axes, known); !found.empty())
    throw InputError(std::move(found));
  SweepPlan plan{base, std::move(axes), {}, runs, {}};
  add_points(plan, engine, known);
  if (std::any_of(plan.points.begin(), plan.points.end(),
                  [](const SweepPoint& point) { return steady_forcing_of(point.setup).has_value(); }))
    plan.notes.push_back(
        fmt::format("steady forcing: each run lasts {} cycles of it instead of run.duration; steady numbers "
                    "are means of the last {}",
                    forcing_cycles, steady_cycles));
  return plan;
}

SweepIdentity identity_of(const SweepPlan& plan, const Engine& engine) {
  return {std::string(engine.name()), digest(plan.base), write_setup(plan.base), plan.axes};
}

}  // namespace shakedown
