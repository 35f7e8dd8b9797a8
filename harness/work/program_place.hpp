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

/// The folder of the programs: of a prefix whose `libexec/shakedown/x86-64-v3` holds the running one, its
/// `bin`. Empty where the system does not tell.
std::filesystem::path program_folder();
/// The same of the program in this file.
std::filesystem::path program_folder(const std::filesystem::path& program);

/// Whether this processor and its system have all of x86-64-v3.
bool has_faster_level();

/// `<prefix>/libexec/shakedown/x86-64-v3/NAME` of a program in `<prefix>/bin`; empty where there is none.
std::filesystem::path faster_program(const std::filesystem::path& program);

/// To be called before anything else: where this program was compiled for less than x86-64-v3, the processor
/// has that, and a faster program is installed, that one takes its place with the same words. Does nothing
/// otherwise, or where SHAKEDOWN_PORTABLE is set in the environment.
void become_faster_program(char** words);

}  // namespace shakedown
