// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "packing.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

std::string text_of(const SourcePlace& place) {
  if (place.file.empty()) return "";
  return " at " + place.file + (place.line > 0 ? ":" + std::to_string(place.line) : "");
}

std::string in_mm(double metres) { return write_quantity(std::round(metres * 1e9) / 1e9, "mm"); }

struct Findings {
  const Setup& setup;
  std::vector<Violation> found;
  std::set<std::string, std::less<>>
      bad;  ///< keys that already have a violation: nothing is concluded from them

  void add(std::string_view key, std::string problem, std::string remedy) {
    found.push_back(
        {place_of(setup, std::string(key)), std::string(key), std::move(problem), std::move(remedy)});
    bad.emplace(key);
  }
  bool sound(std::initializer_list<std::string_view> keys) const {
    return std::none_of(keys.begin(), keys.end(), [&](std::string_view key) { return bad.contains(key); });
  }
};

void check_bounds(Findings& findings) {
  for (const SetupKey& key : setup_keys())
    for (const double value : numbers_of(key, findings.setup)) {
      if (!findings.sound({key.path})) break;
      const std::string problem = out_of_bounds(value, key.low, key.high, key.low_excluded, key.unit);
      if (problem.empty()) continue;
      std::string sentence(key.sentence);
      findings.add(key.path, problem,
                   "correct the value; the key means: " + sentence.substr(0, sentence.find_last_of('.')));
      break;
    }
}

void check_parameter(const EffectChoice& choice, const Parameter& parameter, Findings& findings) {
  const std::string key = std::string(choice.record->name) + "." + std::string(parameter.name);
  if (!findings.sound({key})) return;
  const ParameterValue& value = choice.values.find(parameter.name)->second;
  std::vector<double> numbers;
  if (const auto* number = std::get_if<double>(&value)) numbers = {*number};
  if (const auto* vector = std::get_if<Vec3>(&value)) numbers.assign(vector->begin(), vector->end());
  if (const auto* constants = std::get_if<std::map<std::string, double>>(&value))
    for (const auto& [name, number] : *constants) numbers.push_back(number);
  for (const double number : numbers) {
    const std::string problem = out_of_bounds(number, parameter.low, parameter.high, false, parameter.unit);
    if (problem.empty()) continue;
    return findings.add(key, problem,
                        "`shakedown effects " + std::string(choice.record->name) + "` shows the bounds");
  }
}

void check_effect(const EffectChoice& choice, Findings& findings) {
  bool sound = true;
  for (const Parameter& parameter : choice.record->parameters) {
    check_parameter(choice, parameter, findings);
    sound = sound && findings.sound({std::string(choice.record->name) + "." + std::string(parameter.name)});
  }
  if (!sound || choice.record->check == nullptr) return;
  for (ParameterProblem& wrong : choice.record->check(choice))
    findings.add(std::string(choice.record->name) + "." + std::string(wrong.parameter),
                 std::move(wrong.problem), std::move(wrong.remedy));
}

/// Tells whether an effect acts on the box alone, by its record or, for a force of the user's, by its
/// parameter `on`.
bool acts_on_the_box_alone(const EffectChoice& choice) {
  const auto on = choice.values.find("on");
  const auto* what = on == choice.values.end() ? nullptr : std::get_if<std::string>(&on->second);
  return choice.record->acts_on == ActsOn::box || (what != nullptr && *what == "box");
}

void check_domain(Findings& findings) {
  const Setup& setup = findings.setup;
  if (setup.domain == Domain::damper || !findings.sound({"domain.kind"})) return;
  for (const EffectChoice& choice : setup.effects)
    if (acts_on_the_box_alone(choice) && !is_neutral(choice))
      findings.found.push_back({choice.place, std::string(choice.record->name),
                                "does nothing in this domain (" + std::string(name_of(setup.domain)) +
                                    ": there is no box that moves)",
                                "leave it out, or take domain.kind = \"damper\""});
  if (setup.domain != Domain::periodic || !findings.sound({"grains.count", "grains.diameter"})) return;
  if (setup.grains.count == 0)
    return findings.add("grains.count", "is 0 (a periodic cell without grains holds nothing)",
                        "take one grain or more");
  const double least = least_period_in_diameters * setup.grains.diameter;
  const auto check = [&](std::string_view key, double extent) {
    if (findings.sound({key}) && !(extent > least))
      findings.add(key,
                   "is " + in_mm(extent) + ", a period of three grains (" + in_mm(setup.grains.diameter) +
                       " each) or less (a grain would meet another and its image at once)",
                   "make the cell larger or the grains smaller");
  };
  check("box.length", setup.box.length);
  check("box.width", std::min(setup.box.width[0], setup.box.width[1]));
}

/// Reports two effects that replace the same part of the model, the same effect twice, and an effect beside
/// the key that it stands for.
void check_claims(Findings& findings) {
  const std::vector<EffectChoice>& effects = findings.setup.effects;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const EffectRecord& record = *effects[i].record;
    const std::string name(record.name), claims(record.claims);
    if (findings.setup.places.contains(claims))
      findings.found.push_back(
          {effects[i].place, name,
           "sets what " + claims + text_of(place_of(findings.setup, claims)) + " sets too",
           "keep one of the two"});
    // One message each: with the first that it repeats, or else the first whose part it replaces.
    const auto before = effects.begin() + static_cast<std::ptrdiff_t>(i);
    const auto same = std::find_if(effects.begin(), before,
                                   [&](const EffectChoice& other) { return other.record == &record; });
    const auto rival = std::find_if(effects.begin(), before, [&](const EffectChoice& other) {
      return !claims.empty() && other.record->claims == claims;
    });
    if (same != before)
      findings.found.push_back(
          {effects[i].place, name, "is named twice (first" + text_of(same->place) + ")", "keep one of them"});
    else if (rival != before)
      findings.found.push_back({effects[i].place, name,
                                "replaces the " + claims + ", and so does " +
                                    std::string(rival->record->name) + text_of(rival->place),
                                "keep one of the two"});
  }
}

void check_room_of_one_grain(Findings& findings) {
  const Setup& setup = findings.setup;
  if (setup.grains.count == 0 || !findings.sound({"grains.diameter", "grains.count"})) return;
  const auto check = [&](std::string_view key, double room) {
    if (findings.sound({key}) && room < setup.grains.diameter)
      findings.add(key, "is " + in_mm(room) + ", shorter than a grain (" + in_mm(setup.grains.diameter) + ")",
                   "make the box larger or the grains smaller");
  };
  check("box.length", setup.box.length);
  check("box.width", std::min(setup.box.width[0], setup.box.width[1]));
}

/// Returns what effects on the grains make of sizes and packing.
Physics of_the_grains(const Setup& setup) {
  Physics physics;
  physics.packing = setup.release.packing;
  for (const EffectChoice& choice : setup.effects)
    if (choice.record->acts_on == ActsOn::grains) choice.record->apply(choice, 0, physics);
  return physics;
}

/// Tells whether a packing can be tried here: lattices answer at once; packings that relax random places, or
/// unequal grains, answer when a run makes its initial state.
bool packing_answers_at_once(const Setup& setup, const Physics& grains) {
  if (setup.grains.count > 100000 || !setup.release.initial_grains.empty()) return false;
  if (grains.relative_diameter_deviation != 0) return false;
  return setup.domain != Domain::damper || grains.packing == Packing::fcc ||
         grains.packing == Packing::square;
}

void check_room_of_all_grains(Findings& findings) {
  const Setup& setup = findings.setup;
  if (!findings.sound({"box.length", "box.width", "grains.diameter", "grains.count"})) return;
  const double grains = setup.grains.count * std::numbers::pi / 6 * std::pow(setup.grains.diameter, 3);
  const double fraction = grains / (setup.box.length * setup.box.width[0] * setup.box.width[1]);
  if (fraction > std::numbers::pi / std::sqrt(18.0))
    return findings.add("grains.count",
                        std::to_string(setup.grains.count) + " grains do not fit (they would fill " +
                            write_number(std::round(1000 * fraction) / 10) +
                            " % of the box, the densest packing of spheres fills 74 %)",
                        "take fewer or smaller grains, or a larger box");
  const Physics physics = of_the_grains(setup);
  if (!packing_answers_at_once(setup, physics)) return;
  try {
    const std::vector<double> radius(static_cast<std::size_t>(setup.grains.count), setup.grains.diameter / 2);
    packed_centres(setup, physics.packing, radius, 0);
  } catch (const InputError& error) {
    findings.found.insert(findings.found.end(), error.violations.begin(), error.violations.end());
  }
}

/// Reports a grain much heavier than its box: a slip of a unit (kg for g).
void check_masses(Findings& findings) {
  const Setup& setup = findings.setup;
  if (setup.domain != Domain::damper || setup.grains.count == 0 ||
      !findings.sound({"box.mass", "grains.mass"}))
    return;
  if (setup.grains.mass > 100 * setup.box.mass)
    findings.add("grains.mass",
                 "is " + write_quantity(setup.grains.mass, "g") + ", more than 100 times the box (" +
                     write_quantity(setup.box.mass, "g") + ")",
                 "check the units of both masses");
}

/// Reports more than 5e7 samples: series are kept in memory, and so many of seven numbers are 3 GB.
void check_samples(Findings& findings) {
  const Setup::Run& run = findings.setup.run;
  if (findings.sound({"run.duration", "run.sample_rate"}) && run.duration * run.sample_rate > 5e7)
    findings.add(
        "run.sample_rate",
        "gives " + write_number(std::round(run.duration * run.sample_rate)) + " samples (5e7 are the most)",
        "take a shorter run.duration or a lower run.sample_rate");
}

}  // namespace

std::vector<Violation> violations_of(const Setup& setup,
                                     const std::set<std::string, std::less<>>& known_bad) {
  Findings findings{setup, {}, known_bad};
  check_bounds(findings);
  for (const EffectChoice& choice : setup.effects) check_effect(choice, findings);
  check_claims(findings);
  check_domain(findings);
  check_room_of_one_grain(findings);
  check_room_of_all_grains(findings);
  check_masses(findings);
  check_samples(findings);
  return std::move(findings.found);
}

}  // namespace shakedown
