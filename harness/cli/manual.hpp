// SPDX-License-Identifier: MIT
// Makes manual pages and completions from the command line itself.
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace shakedown {

/// Returns the page of a program (`command` is the program) or of one of its commands, in the language of
/// man(7). `program`: the name of the file that is run.
std::string manual_page(const std::string& program, const CLI::App& parser, const CLI::App& command);

/// Return the completion of the program's words for bash and for zsh.
std::string bash_completion(const std::string& program, const CLI::App& parser);
std::string zsh_completion(const std::string& program, const CLI::App& parser);

/// Writes man1/PROGRAM.1, man1/PROGRAM-COMMAND.1 of every command, bash/PROGRAM and zsh/_PROGRAM into the
/// folder. Throws FileError.
void write_manual(const std::filesystem::path& folder, const std::string& program, const CLI::App& parser);

}  // namespace shakedown
