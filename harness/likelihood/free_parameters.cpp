// SPDX-License-Identifier: MIT
#include "free_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "key_unit.hpp"
#include "known_effects.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

/// Bounds of restitutions. Elastic grains never come to rest; and pressed layers of very inelastic ones make
/// endless impacts (0.1: 30 times the events of 0.75), so a fit goes there only when it starts near.
constexpr double least_restitution = 0.05, usual_restitution = 0.3, most_restitution = 0.995;

Knob knob_of_setup_key(const SetupKey& key, double start) {
  const std::string path(key.path);
  if (key.section() == "restitution")
    return {
        path, start, 0.15, std::clamp(start - 0.2, least_restitution, usual_restitution), most_restitution,
        true};
  if (path == "spring.frequency") return {path, start, 0.03 * start, start / 2, start * 2, true};
  const double reach = start != 0 ? std::abs(start) : 1;
  return {path,
          start,
          0.1 * reach,
          std::max(key.low, start - 2 * reach / 3),
          std::min(key.high, start + 2 * reach),
          true};
}

/// Tells whether a key moves nothing that a fit simulates: keys of the beam formula, of other engines, of how
/// the exact engine works, and the speed of grains without a spring.
bool moves_nothing(const SetupKey& key) {
  return key.section() == "blade" || key.section() == "soft" || key.section() == "bullet" ||
         key.section() == "hard" || key.path == "release.grain_speed";
}

Knob knob_of(const std::string& keys, const Setup& setup, KnownEffects known) {
  const std::string first = joined_keys(keys).front();
  const double start = get_number(setup, first, known);
  if (const SetupKey* key = find_setup_key(first)) {
    if (key->path == "grains.count" || key->section() == "run")
      throw InputError({{{"--free", 0, 0},
                         first,
                         "cannot be fitted (it is no property of the damper that varies smoothly)",
                         "sweep it instead"}});
    if (moves_nothing(*key))
      throw InputError(
          {{{"--free", 0, 0},
            first,
            "cannot be fitted (the engine of the fit does not move otherwise, or only as exactly, "
            "whatever it is)",
            "free what the damper is: masses, lengths, restitutions, frequency, effects"}});
    Knob knob = knob_of_setup_key(*key, start);
    knob.key = keys;
    return knob;
  }
  const Parameter& parameter = *known.find_parameter(first);
  const double width = parameter.typical > 0 ? parameter.typical : std::max(0.1 * std::abs(start), 1e-6);
  return {keys,
          start,
          width,
          std::max(parameter.low, start - 20 * width),
          std::min(parameter.high, start + 20 * width),
          true};
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  std::stringstream stream{std::string(text)};
  for (std::string part; std::getline(stream, part, ',');) {
    std::erase(part, ' ');
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

std::vector<Knob> free_parameters(std::string_view text, const Setup& setup, KnownEffects known) {
  std::vector<Knob> knobs;
  std::vector<Violation> found;
  for (const std::string& keys : split(text)) {
    try {
      const std::vector<std::string> joined = joined_keys(keys);
      for (const std::string& key : joined) {
        (void)get_number(setup, key, known);
        if (unit_of_key(key, known) != unit_of_key(joined.front(), known))
          throw InputError({{{"--free", 0, 0},
                             keys,
                             "joins keys of different units (one value cannot be both)",
                             "fit them apart: separate them by a comma"}});
      }
      for (const Knob& other : knobs)
        if (other.key == keys) throw InputError({{{"--free", 0, 0}, keys, "is named twice", "name it once"}});
      knobs.push_back(knob_of(keys, setup, known));
    } catch (const InputError& error) {
      for (Violation violation : error.violations) {
        violation.place.file = "--free";
        found.push_back(violation);
      }
    }
  }
  if (knobs.empty() && found.empty())
    found.push_back({{"--free", 0, 0},
                     "",
                     "names nothing to fit",
                     "e.g. --free restitution.grain_grain,restitution.grain_wall"});
  if (!found.empty()) throw InputError(std::move(found));
  return knobs;
}

}  // namespace shakedown
