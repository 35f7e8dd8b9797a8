// SPDX-License-Identifier: MIT
// Finds files that the programs need beside them: in the source tree, or where the programs are installed.
#pragma once
#include <filesystem>
#include <string_view>

namespace shakedown {

/// Returns the file to read: `share/shakedown/NAME` beside an installed program's folder, else `in_tree`.
std::filesystem::path data_file(std::string_view name, const std::filesystem::path& in_tree);

/// Returns the file to write to: of an installed program in the user's own folder ($XDG_STATE_HOME/shakedown,
/// else ~/.local/state/shakedown), for the installed one belongs to all users; else `in_tree`. Nothing is
/// made.
std::filesystem::path state_file(std::string_view name, const std::filesystem::path& in_tree);

}  // namespace shakedown
