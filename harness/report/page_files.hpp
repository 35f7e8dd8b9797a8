// SPDX-License-Identifier: MIT
#pragma once

namespace shakedown {

// The files of folders page and vendor, embedded by embed.cmake.
extern const char* const plot_script;
extern const char* const plot_style;
extern const char* const plot_licence;
extern const char* const page_script;
extern const char* const replay_script;
extern const char* const model_script;
extern const char* const knobs_script;
extern const char* const figures_script;
extern const char* const page_style;

// SHA-256 of the scripts, hexadecimal.
extern const char* const plot_script_sha256;
extern const char* const page_script_sha256;
extern const char* const replay_script_sha256;
extern const char* const model_script_sha256;
extern const char* const knobs_script_sha256;
extern const char* const figures_script_sha256;

}  // namespace shakedown
