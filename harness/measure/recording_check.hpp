// SPDX-License-Identifier: MIT
// Says what looks wrong in recordings before any model is asked: units off by powers of ten, origin, side,
// swapped columns, lengths, releases.
#pragma once
#include <string>
#include <vector>

#include "experiment.hpp"

namespace shakedown {

struct RecordingCheck {
  std::vector<Violation> impossible;  ///< no comparison makes sense before these are put right
  std::vector<std::string> notes;     ///< sentences for people, with the line to write where it is known
};

/// Checks the recordings. `setups` are those of the runs, in their order.
RecordingCheck check_recordings(const Experiment& experiment, const std::vector<Setup>& setups);

/// Returns the notes of reading and of the check. Throws InputError for what is impossible.
std::vector<std::string> notes_before_modelling(const Experiment& experiment,
                                                const std::vector<Setup>& setups);

}  // namespace shakedown
