// SPDX-License-Identifier: MIT
// Files that the program wrote itself and that may have been damaged since.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace shakedown {

/// Hands the file's text to `read`. Where that is no JSON, or not the JSON that `read` looks for, throws
/// InputError: the file "is not `what`", the reason, `remedy`. Throws FileError.
void read_json_file(const std::filesystem::path& file, std::string_view what, std::string_view remedy,
                    const std::function<void(const std::string& text)>& read);

}  // namespace shakedown
