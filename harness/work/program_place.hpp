// SPDX-License-Identifier: MIT
// Where the running program stands, and the one beside it that was compiled for this machine's processor.
// Packages hold programs for any x86-64 of the last fifteen years and the same ones for processors with AVX2
// (x86-64-v3), by which the hard engine takes three quarters of the time (harness/packaging/README.md);
// numbers are the same to the byte.
#pragma once
#include <filesystem>
#include <string_view>

namespace shakedown {

/// The name of the folder with programs for processors with AVX2, FMA, BMI and what else the level has.
constexpr std::string_view faster_level = "x86-64-v3";

/// Returns the folder of the programs: that of the running one, or the `bin` of a prefix whose
/// `libexec/shakedown/x86-64-v3` holds it. Empty where the system does not tell.
std::filesystem::path program_folder();
/// Returns the same for the program in this file.
std::filesystem::path program_folder(const std::filesystem::path& program);

/// Tells whether this processor and its system have all of x86-64-v3.
bool has_faster_level();

/// Returns `<prefix>/libexec/shakedown/x86-64-v3/NAME` of a program in `<prefix>/bin`; empty where there is
/// none.
std::filesystem::path faster_program(const std::filesystem::path& program);

/// Lets a faster program take the place of this one with the same words, where this one was compiled for less
/// than x86-64-v3, the processor has that, and a faster one is installed. Does nothing otherwise, or where
/// SHAKEDOWN_PORTABLE is set in the environment. To be called before anything else.
void become_faster_program(char** words);

}  // namespace shakedown
