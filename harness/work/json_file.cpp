// SPDX-License-Identifier: MIT
#include "json_file.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "toml_document.hpp"

namespace shakedown {

void read_json_file(const std::filesystem::path& file, std::string_view what, std::string_view remedy,
                    const std::function<void(const std::string& text)>& read) {
  const std::string text = read_text_file(file);
  try {
    read(text);
  } catch (const nlohmann::json::exception& problem) {
    throw InputError({{{file.string(), 0, 0},
                       "",
                       fmt::format("is not {} ({})", what, problem.what()),
                       std::string(remedy)}});
  }
}

}  // namespace shakedown
