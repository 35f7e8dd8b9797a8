// SPDX-License-Identifier: MIT
// Lists what a blind suite hides, each with one number that says how strong it is: every effect of the list,
// by its record's search, and forces that no list has.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "effect_strength.hpp"
#include "known_effects.hpp"
#include "trial.hpp"

namespace shakedown {

/// Describes one thing to hide. Strengths count in typical ones; strength 2 of a length is half of it.
struct Hideable {
  std::string
      id;  ///< the effect's name, of several ways with the way ("constant_acceleration.z"); "force:..."
  const EffectRecord* effect = nullptr;
  SearchedStrength strength{};     ///< within the bounds of the parameter; of a force unused
  double strongest = 0;            ///< in typical ones: where it stops making sense
  std::string_view formula{};      ///< of a force in no list; its constant c is the strength
  std::string_view constants{};    ///< its other constants, as TOML
  double typical_constant = 0;     ///< c at strength 1, SI
  std::string_view unit{};         ///< of c
  bool of_the_dictionary = false;  ///< the form of a force is one that a diagnosis offers
  bool takes_table = false;        ///< its constants a0, a1 ... are a table drawn at random
};

/// Returns every effect that a diagnosis looks for, in the order of the list, each strength of its own.
const std::vector<Hideable>& hideable_effects();
/// Returns forces that no list has: some of a form that a diagnosis offers (its dictionary of formulas), some
/// of none.
const std::vector<Hideable>& hideable_forces();
/// Returns the effect or force of this id; null where there is none.
const Hideable* find_hideable(std::string_view id);

/// Holds what is drawn beside a strength: frequency (Hz) and phase (rad) of what oscillates, heights of a
/// force that is a table.
struct DrawnTone {
  double frequency = 2.3, phase = 0.7;
  std::array<double, 7> table{0.6, -0.8, 0.3, 0.9, -0.5, 0.7, -0.4};  ///< in units of its strength
};

/// Returns overrides that put it into this setup, so many typical strengths strong.
std::vector<Override> at_strength(const Hideable& hideable, double strength, const Setup& setup = {},
                                  const DrawnTone& tone = {});

/// Returns the setup with overrides on top.
Setup changed(const Setup& setup, const std::vector<Override>& overrides, KnownEffects known);

}  // namespace shakedown
