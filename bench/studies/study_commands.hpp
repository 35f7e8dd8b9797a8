// SPDX-License-Identifier: MIT
#pragma once
#include "command.hpp"

namespace shakedown {

/// Each adds its words and options to the program and returns what runs it.
Command add_paper_command(CLI::App& program);
Command add_blind_suite_command(CLI::App& program);
Command add_ring_down_command(CLI::App& program);
Command add_signal_command(CLI::App& program);

}  // namespace shakedown
