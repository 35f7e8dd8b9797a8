// SPDX-License-Identifier: MIT
// Legal setups that nobody would write.
#pragma once
#include <cstdint>
#include <string>

namespace shakedown {

/// The text of a setup file: the paper's damper for three seconds with one to four keys anywhere in their
/// range and up to two effects whose parameters are. Ranges of more than a decade are drawn by the logarithm;
/// what has no bound, twelve decades about what is usual. The same number gives the same setup.
std::string drawn_setup(std::uint64_t number);

}  // namespace shakedown
