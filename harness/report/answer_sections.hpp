// SPDX-License-Identifier: MIT
// Shows what a diagnosis answers, before anything else: the same numbers as in its JSON and on the terminal.
#pragma once
#include "diagnosis.hpp"
#include "report.hpp"

namespace shakedown {

/// How people read a number of the setup.
struct ReadUnit {
  std::string unit;
  double factor = 1;  ///< one of it in SI
};
/// Returns how people read a key of the setup or of an effect.
ReadUnit read_unit(const std::string& key);

/// Returns "dry friction of the clamp" for clamp_dry_friction.force, "restitution of two grains"; the key
/// where there are no words.
std::string words_of_key(const std::string& name);

/// Makes the sections: probabilities, strengths, what is left, camera and weights. `given`: the setup as the
/// user had it.
std::vector<ReportSection> answer_of(const Diagnosis& diagnosis, const Setup& given);

}  // namespace shakedown
