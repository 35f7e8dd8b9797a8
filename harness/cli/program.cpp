// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <new>
#include <sstream>
#include <system_error>

#include "arguments.hpp"
#include "command.hpp"
#include "errors.hpp"
#include "interruption.hpp"
#include "kept_files.hpp"
#include "manual.hpp"
#include "named_files.hpp"
#include "provenance.hpp"
#include "text.hpp"

namespace shakedown {
namespace {

/// Prints a message for people and returns the exit code, which a full or closed standard error does not
/// change.
int told(const std::string& message, ExitCode code) {
  std::fputs((printable(message) + "\n").c_str(), stderr);
  return code;
}

std::string not_written() {
  return "standard output: cannot be written (the disk is full, or its reader is gone); make room, or name a "
         "file with --out or --json";
}

std::string unusable(const std::filesystem::filesystem_error& error) {
  return fmt::format("{}: cannot be used ({}); check the path and its permissions", error.path1().string(),
                     error.code().message());
}

int run_named(const std::vector<Command>& commands) {
  for (const Command& command : commands)
    if (command.parser->parsed()) {
      check_named_files(*command.parser);
      return command.run();
    }
  EXPECT(false && "one command is required");
  return exit_bug;
}

/// Does the work and returns the exit code; prints errors.
int guarded(const std::function<int()>& work) {
  try {
    const int code = work();
    // What was printed is written now; a full disk is heard only here.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw FileError(not_written());
    return code;
  } catch (const InputError& error) {
    return told(error.what(), exit_bad_input);
  } catch (const PhysicsError& error) {
    return told("the engine cannot keep its promise: " + std::string(error.what()), exit_promise_broken);
  } catch (const FileError& error) {
    return told(error.what(), exit_bad_file);
  } catch (const Interrupted& error) {
    return told("interrupted: " + std::string(error.what()), exit_interrupted);
  } catch (const std::filesystem::filesystem_error& error) {
    return told(unusable(error), exit_bad_file);
  } catch (const std::system_error&) {
    if (std::ferror(stdout) != 0) return told(not_written(), exit_bad_file);
    return told("standard error: cannot be written; the results are incomplete", exit_bad_file);
  } catch (const std::bad_alloc&) {
    return told("there is not enough memory for this; take fewer grains, samples or threads", exit_bad_input);
  } catch (const std::exception& error) {
    return told("this is a bug of the program, please report it: " + std::string(error.what()), exit_bug);
  }
}

/// Returns the parser's own message, for people.
std::string message_of(CLI::App& program, const CLI::ParseError& error) {
  const std::vector<std::string> left = program.remaining();
  if (program.get_subcommands().empty() && !left.empty())
    return fmt::format("there is no command or option '{}'\nRun with --help for more information.",
                       left.front());
  std::ostringstream out, message;
  program.exit(error, out, message);
  std::string text = message.str();
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

/// Tells whether the words are `--write-manual DIR`, which is for packages and no option that a help shows.
bool asks_for_manual(int count, char** words) {
  return count == 3 && std::string_view(words[1]) == "--write-manual";
}

int written_manual(const CLI::App& program, char** words) {
  write_manual(words[2], std::filesystem::path(words[0]).filename().string(), program);
  return exit_done;
}

}  // namespace

int run_program(const char* name, const char* description, std::vector<Command> (*add)(CLI::App&), int count,
                char** words) {
  CLI::App program(description, name);
  program.set_version_flag("--version", version_line());
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done, 1 the data reject the model, 2 usage or setup, 3 an engine broke its promise, 4 "
      "file,\n"
      "70 a bug of the program, 130 interrupted with results kept.");
  begin_keeping_files();
  const std::vector<Command> commands = add(program);
  if (asks_for_manual(count, words)) return guarded([&] { return written_manual(program, words); });
  try {
    program.parse(parser_words(count, words));
  } catch (const InputError& error) {
    return told(error.what(), exit_bad_input);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // help or version
    return told(message_of(program, error), exit_bad_input);
  }
  return guarded([&] { return run_named(commands); });
}

}  // namespace shakedown
