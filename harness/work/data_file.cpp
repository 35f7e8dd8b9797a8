// SPDX-License-Identifier: MIT
#include "data_file.hpp"

#include <cstdlib>
#include <system_error>

#include "program_place.hpp"

namespace shakedown {

namespace {

/// Returns `share/shakedown` of the prefix in which this program stands; empty where there is none.
std::filesystem::path installed_data() {
  std::error_code unreadable;
  const std::filesystem::path folder = program_folder().parent_path() / "share/shakedown";
  return std::filesystem::is_directory(folder, unreadable) ? folder : std::filesystem::path();
}

std::filesystem::path folder_in(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

}  // namespace

std::filesystem::path data_file(std::string_view name, const std::filesystem::path& in_tree) {
  const std::filesystem::path file = installed_data() / name;
  std::error_code unreadable;
  return std::filesystem::exists(file, unreadable) ? file : in_tree;
}

std::filesystem::path state_file(std::string_view name, const std::filesystem::path& in_tree) {
  if (installed_data().empty()) return in_tree;
  if (const std::filesystem::path state = folder_in("XDG_STATE_HOME"); state.is_absolute())
    return state / "shakedown" / name;
  if (const std::filesystem::path home = folder_in("HOME"); !home.empty())
    return home / ".local/state/shakedown" / name;
  return name;
}

}  // namespace shakedown
