// SPDX-License-Identifier: MIT
// Finds what simpler methods would name from the same measurements, which a diagnosis has to beat.
#pragma once
#include <string>

#include "emulator.hpp"

namespace shakedown {

/// Effect ids; empty: nothing named.
struct NaiveAnswers {
  std::string least_error;  ///< whose refit leaves the smallest rms error of the box
  std::string white_noise;  ///< whose refit has the smallest of Akaike's criterion, the camera's white noise
                            ///< taken for all there is
  std::string one_seed;  ///< least_error against one simulation of each model instead of an ensemble's mean
};

/// Refits the parameters to the experiment, then every known effect beside them, linearly. Throws InputError
/// when the setup does not fit the experiment, Interrupted.
NaiveAnswers naive_answers(const Setup& setup, const Measurement& measurement, const Workshop& workshop);

}  // namespace shakedown
