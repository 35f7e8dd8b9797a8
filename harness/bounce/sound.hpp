// SPDX-License-Identifier: MIT
// Finds in the sound of a ball that bounces where impacts begin, and which of the sounds are a drop.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "drop_reading.hpp"

namespace shakedown {

struct Sound {
  double rate = 0;                          ///< Hz
  std::vector<std::vector<float>> channel;  ///< one and the same length
};

/// Reads WAV, FLAC, OGG and what else libsndfile knows. Throws FileError.
Sound read_sound(const std::string& file);
/// Tells by its first bytes whether a file is a sound.
bool is_sound(const std::string& file);

struct Onset {
  double time = 0;      ///< s
  double strength = 0;  ///< dB over the noise about it
};

/// Returns sudden sounds in order of time: the level of steps of the signal over 1 ms rises by 6 dB within 10
/// ms and stands 8 dB over the noise. Each is placed after the meeting of two different variances (N. Maeda,
/// Zisin 38, 365 (1985)) where it reaches 0.3 of its own peak.
std::vector<Onset> onsets_of(const Sound& sound);

/// Finds the onsets that are impacts of one ball: intervals fall by a ratio from 0.3 to 1 that changes by
/// some per cent, one impact may be missing between two, and each is some dB quieter. Returns the indices of
/// the chain that is most unlikely by chance; empty below four, and where it is no likelier than chance makes
/// one among all that were tried (of the first drop of a file, which somebody says is in it, e^-2 of that).
std::vector<std::size_t> chain_of(const std::vector<Onset>& onsets, bool first = true);

/// Returns all drops of a recording.
ReadDrops drops_of_sound(const Sound& sound, const std::string& file, const DropReading& reading);

}  // namespace shakedown
