// SPDX-License-Identifier: MIT
#include "paper_values.hpp"

#include <algorithm>
#include <array>

#include "setup_keys.hpp"

namespace shakedown {

namespace {

struct PhysicalKey {
  std::string_view path;
  bool of_grains;  ///< without grains it changes nothing
  bool of_spring;  ///< only the damper has one
};
constexpr std::array<PhysicalKey, 10> physical_keys{{{"box.mass", false, true},
                                                     {"box.length", true, false},
                                                     {"box.width", true, false},
                                                     {"spring.frequency", false, true},
                                                     {"grains.count", false, false},
                                                     {"grains.diameter", true, false},
                                                     {"grains.mass", true, false},
                                                     {"restitution.grain_grain", true, false},
                                                     {"restitution.grain_wall", true, false},
                                                     {"release.displacement", false, true}}};

bool matters(const PhysicalKey& key, const Setup& setup) {
  if (key.of_spring && setup.domain != Domain::damper) return false;
  if (key.path == "restitution.grain_wall" && setup.domain == Domain::periodic) return false;
  return !key.of_grains || setup.grains.count > 0;
}

std::vector<const SetupKey*> keys_left_out(const Setup& setup, std::span<const std::string_view> elsewhere) {
  std::vector<const SetupKey*> keys;
  for (const PhysicalKey& key : physical_keys)
    if (matters(key, setup) && !setup.places.contains(std::string(key.path)) &&
        std::find(elsewhere.begin(), elsewhere.end(), key.path) == elsewhere.end())
      keys.push_back(find_setup_key(key.path));
  return keys;
}

/// Returns the value as people read it: without the quotation marks of TOML.
std::string value_of(const SetupKey& key, const Setup& setup) {
  std::string text = toml_of(key, setup);
  std::erase(text, '"');
  return text;
}

}  // namespace

std::vector<std::string> taken_from_paper(const Setup& setup, std::span<const std::string_view> elsewhere) {
  std::vector<std::string> taken;
  for (const SetupKey* key : keys_left_out(setup, elsewhere))
    taken.push_back(std::string(key->path) + " = " + value_of(*key, setup));
  return taken;
}

void refuse_paper_values(const Setup& setup, const std::string& file,
                         std::span<const std::string_view> elsewhere) {
  std::vector<Violation> found;
  for (const SetupKey* key : keys_left_out(setup, elsewhere))
    found.push_back({{file, 0, 0},
                     std::string(key->path),
                     "is left out (it would have the paper's value, " + value_of(*key, setup) + ")",
                     "write " + std::string(key->name()) + " = " + toml_of(*key, setup) + " below [" +
                         std::string(key->section()) + "], with your damper's value, or leave out --strict"});
  if (!found.empty()) throw InputError(std::move(found));
}

std::string line_of_paper_values(const std::vector<std::string>& taken) {
  std::string line;
  for (const std::string& value : taken) line += (line.empty() ? "taken from the paper: " : ", ") + value;
  return line.empty() ? line : line + "\n";
}

}  // namespace shakedown
