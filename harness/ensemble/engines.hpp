// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine.hpp"

namespace shakedown {

/// Returns the names of the engines in this program, the default ("hard") first.
std::vector<std::string> engine_names();

/// Makes one of them, or any program: "command:./my_code". Throws InputError for a name that is neither.
std::unique_ptr<Engine> engine_named(std::string_view name);

}  // namespace shakedown
