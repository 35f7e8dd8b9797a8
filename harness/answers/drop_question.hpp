// SPDX-License-Identifier: MIT
// Reads what is asked of recordings of a bouncing ball, as people write it.
#pragma once
#include <string>
#include <vector>

#include "bounce_answer.hpp"
#include "report.hpp"

namespace shakedown {

/// Holds the question. Texts are quantities with their unit ("2.7 g"); empty: not said.
struct DropQuestion {
  std::vector<std::string> files;    ///< tables, tracks or sounds
  std::string as;                    ///< "intervals", "instants", "track" or "sound"; empty: guessed
  std::vector<std::string> columns;  ///< headers of columns with times; empty: guessed
  std::string unit, rate;            ///< of the times: "ms"; "240 Hz" where they are counts
  std::string mass, diameter;        ///< of the ball, for the drag of the air
  std::string height;                ///< of the fall onto the first impact: "2.5 m" or "2.5 m +- 5 mm"
  std::string timing;                ///< standard deviation of an instant
  std::string gravity, reference;    ///< m/s^2; speed at which the restitution of a law is told
};

/// Reads the files and weighs the laws. Throws InputError for a text that is no such quantity and for a file
/// that holds no drops, FileError.
BounceReading answer_of(const DropQuestion& question);

/// Returns the answer as JSON text (harness/bounce/README.md).
std::string drops_json(const BounceReading& reading);

}  // namespace shakedown
