// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace shakedown {

/// Returns the smallest number of insertions, deletions, replacements and swaps of neighbours that turn one
/// word into the other.
int edit_distance(std::string_view a, std::string_view b);

/// Returns the candidate nearest to a misspelt word, or "" when none is near.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// Returns "did you mean 'a' or 'b'? ", or "" when nothing is like the word. It names a candidate that a slip
/// of two letters makes of the word, else up to three that have all its parts (what stands between
/// underscores, misspelt or not), else the nearest.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

/// Joins words: "a, b, c".
std::string listed(std::span<const std::string_view> words);

}  // namespace shakedown
