// SPDX-License-Identifier: MIT
// Setup files as text in memory, and small effects for them.
#pragma once
#include <string>
#include <vector>

#include "physics.hpp"
#include "setup_file.hpp"

namespace shakedown {

inline const EffectRecord drag{.name = "test_drag",
                               .acts_on = ActsOn::all,
                               .sentence = "A drag for these tests.",
                               .parameters = {{.name = "strength",
                                               .unit = "N s/m",
                                               .low = 0,
                                               .high = 10,
                                               .neutral = 0,
                                               .typical = 0.1,
                                               .sentence = "Strength."}},
                               .claims = "drag",
                               .apply = [](const EffectChoice& choice, int index, Physics& physics) {
                                 physics.box.viscous.add(choice.number("strength"), index);
                               }};
inline const EffectRecord rival{.name = "test_rival",
                                .parameters = {{.name = "on",
                                                .kind = ParameterKind::choice,
                                                .default_value = std::string("box"),
                                                .choices = {"box", "grains"}}},
                                .claims = "drag",
                                .apply = [](const EffectChoice&, int, Physics&) {}};
inline const EffectRecord arrangement{
    .name = "test_packing", .claims = "release.packing", .apply = [](const EffectChoice&, int, Physics&) {}};
inline const EffectRecord wind{
    .name = "test_wind",
    .parameters = {{.name = "velocity",
                    .kind = ParameterKind::vector,
                    .unit = "m/s",
                    .default_value = Vec3(0, 0, 0),
                    .low = -5,
                    .high = 5,
                    .neutral = 0},
                   {.name = "formula", .kind = ParameterKind::text, .default_value = std::string("x")},
                   {.name = "constants",
                    .kind = ParameterKind::constants,
                    .default_value = std::map<std::string, double>{}}},
    .apply = [](const EffectChoice&, int, Physics&) {}};
inline const std::vector<const EffectRecord*> known{&drag, &rival, &arrangement, &wind};

inline Setup parsed(std::string_view text, std::vector<Override> overrides = {}) {
  return parse_setup(text, "s.toml", known, overrides);
}

/// Every message, a line each; "" when the setup is taken.
inline std::string complaint(std::string_view text, std::vector<Override> overrides = {}) {
  try {
    parsed(text, std::move(overrides));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace shakedown
