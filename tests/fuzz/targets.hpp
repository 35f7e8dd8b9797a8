// SPDX-License-Identifier: MIT
// What reads other people's bytes, each as one call.
#pragma once
#include <span>
#include <string_view>

namespace shakedown {

struct FuzzTarget {
  std::string_view name;  ///< of its folder in corpus/
  /// Reads the bytes as a command would. Refusals are fine; any other exception goes through, and what was
  /// taken must read back as itself (EXPECT).
  void (*read)(std::string_view bytes);
};

std::span<const FuzzTarget> fuzz_targets();

/// nullptr: there is none of that name.
const FuzzTarget* find_fuzz_target(std::string_view name);

}  // namespace shakedown
