// SPDX-License-Identifier: MIT
// What every report ends with.
#pragma once
#include "report.hpp"
#include "setup.hpp"

namespace shakedown {

/// The effects of a setup with their sources.
std::vector<std::string> citations_of(const Setup& setup);

/// The command that is running, as one would type it.
std::string this_command();

/// Fills in command, setup, program and citations.
void say_how_to_reproduce(Report& report, const Setup& setup);

}  // namespace shakedown
