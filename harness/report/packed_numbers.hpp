// SPDX-License-Identifier: MIT
// Packs numbers into as few bytes as a page needs.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shakedown {

/// Numbers in units of a quantum, as differences from one to the next. The quantum is a power of ten below
/// the largest divided by `parts`: as a rule far below what a screen shows.
struct PackedNumbers {
  double quantum = 1;
  std::vector<std::optional<std::int64_t>>
      steps;  ///< nothing for a gap (NaN), over which the next one goes on
};
constexpr double parts_of_a_screen = 40000;
/// Packs values; NaN becomes a gap.
PackedNumbers packed(const std::vector<double>& values, double parts = parts_of_a_screen);

/// Returns the value in whole units, 0 for NaN; held to +-2^61, so that the difference of any two fits 64
/// bits.
std::int64_t whole_steps(double value, double unit);

/// Return a gzip stream of the bytes, and bytes as base64 text (RFC 4648).
std::string gzip(std::string_view bytes);
std::string base64(std::string_view bytes);

}  // namespace shakedown
