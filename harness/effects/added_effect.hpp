// SPDX-License-Identifier: MIT
// Adds an effect to a setup file and leaves everything else in it as its user wrote it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "setup_file.hpp"

namespace shakedown {

struct AmendedSetup {
  std::string text;  ///< of the new setup file
  Setup setup;       ///< what it reads back to
  bool as_written =
      true;  ///< false: the file could not just be added to and was written anew, without its comments
};

/// Returns `text` (read from `file`) with the effect at its end; `values` are "parameter=value" (none: its
/// typical strength, as in `shakedown effects NAME`). Paths in the new text count from `folder`. Throws
/// InputError for an effect that does not exist or is in the setup already, for parameters that do not fit,
/// and for an effect that would do nothing.
AmendedSetup with_effect_added(const std::string& text, const std::filesystem::path& file,
                               const std::string& effect, const std::vector<std::string>& values,
                               const std::filesystem::path& folder);

}  // namespace shakedown
