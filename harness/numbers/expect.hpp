// SPDX-License-Identifier: MIT
#pragma once

namespace shakedown {

/// Says on standard error which assertion failed and ends the program with exit code 70.
[[noreturn]] void report_bug(const char* condition, const char* file, int line);

}  // namespace shakedown

/// An assertion that stays on in every build: a failure is a bug of this project, not of its user.
#define EXPECT(condition) ((condition) ? void(0) : ::shakedown::report_bug(#condition, __FILE__, __LINE__))
