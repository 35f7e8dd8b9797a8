// SPDX-License-Identifier: MIT
// What a blind suite hides, each with one number that says how strong it is.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "trial.hpp"

namespace shakedown {

/// One way of being wrong. strength 1 is a typical one; the overrides at a strength come from at_strength().
struct Hideable {
  std::string_view id{};      ///< "grain_friction", "constant_acceleration.z", "force:eddy"
  std::string_view effect{};  ///< the effect in the setup
  std::string_view family{};  ///< effects of one family look alike; naming the family is half the answer
  std::string_view key{};     ///< key that holds the strength; several joined by "&"
  double typical = 0;         ///< value of the key at strength 1, SI; of `away_from` values the change
  std::string_view unit{};
  enum class As {
    proportional,
    inverse,
    away
  } as = As::proportional;  ///< key = typical s, typical / s, away_from - typical s
  double away_from = 0;
  double strongest = 0;          ///< strength at the bounds of what makes sense
  std::string_view formula{};    ///< of a force in no list; its constant c is the strength
  std::string_view constants{};  ///< its other constants, as TOML
  bool camera = false;
};

/// Physical effects, then camera artefacts.
const std::vector<Hideable>& hideable_effects();
/// Forces that no list has.
const std::vector<Hideable>& hideable_forces();
const Hideable* find_hideable(std::string_view id);

/// The family of an effect's name ("drag", "contact" ...); of effects without look-alikes the name itself.
std::string_view family_of(std::string_view effect);

/// Overrides that put it into a setup. A periodic one gets this frequency and phase.
std::vector<Override> at_strength(const Hideable& hideable, double strength, double frequency = 2.3,
                                  double phase = 0.7);

/// The setup with overrides on top.
Setup changed(const Setup& setup, const std::vector<Override>& overrides,
              std::span<const EffectRecord* const> known);

}  // namespace shakedown
