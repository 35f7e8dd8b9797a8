// SPDX-License-Identifier: MIT
#pragma once

namespace shakedown {

// The files of folders page and vendor, embedded by embed.cmake.
extern const char* const plot_script;
extern const char* const plot_style;
extern const char* const plot_licence;
extern const char* const page_script;
extern const char* const replay_script;
extern const char* const page_style;

}  // namespace shakedown
