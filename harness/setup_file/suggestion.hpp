// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace shakedown {

/// Smallest number of insertions, deletions, replacements and swaps of neighbours that turn one word into the
/// other.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to a misspelt word, or "" when none is near.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// "did you mean 'a' or 'b'? ", or "" when nothing is like the word: a candidate that a slip of two letters
/// makes of it, else up to three that have all its parts (what stands between underscores, misspelt or not),
/// else the nearest.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

/// "a, b, c"
std::string listed(std::span<const std::string_view> words);

}  // namespace shakedown
